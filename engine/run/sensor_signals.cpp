#include "engine/run/sensor_signals.hpp"

namespace vigil {
namespace {
constexpr int kForms = 4;
constexpr const char* kForm[kForms] = {"", ".sent", ".injected", ".source"};
}  // namespace

int declare_sensors(const std::string& prefix, const std::string& lane, const std::vector<std::string>& nodes,
                    const World& world, Catalogue& catalogue) {
  const int first = catalogue.size();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string name = prefix + "sensor." + nodes[i] + ".";
    Signal state{.name = name + "state", .kind = SignalKind::category, .lane = lane, .node = nodes[i]};
    for (int s = 0; s <= static_cast<int>(SensorState::type_r); ++s)
      state.labels.emplace_back(s, word(static_cast<SensorState>(s)));
    catalogue.add(std::move(state));
    for (const Component& c : world.sensors[i]->channels()) {
      for (int form = 0; form < kForms; ++form) {
        catalogue.add(
            {.name = name + c.name + kForm[form], .unit = form == 3 ? "" : c.unit, .lane = lane, .node = nodes[i]});
      }
    }
  }
  return first;
}

void publish_sensors(const Course& course, const SensorEffects& effects, double* at) {
  for (std::size_t i = 0; i < course.received.size(); ++i) {
    *at++ = static_cast<double>(effects.state[i]);
    for (Eigen::Index c = 0; c < course.received[i].size(); ++c, at += kForms) {
      at[0] = course.received[i][c];
      if (course.sent[i][c] != course.received[i][c]) at[1] = course.sent[i][c];
      at[2] = course.injected[i][c];
      const std::int64_t source = effects.playback[i][static_cast<std::size_t>(c)].source;
      if (source >= 0) at[3] = static_cast<double>(source);
    }
  }
}

}  // namespace vigil
