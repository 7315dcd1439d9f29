/// White Gaussian noise added to what a channel carries.
#include <algorithm>

#include "engine/adversary/attack.hpp"
#include "engine/random/draws.hpp"

namespace vigil {
namespace {

constexpr std::uint32_t kSensors = 0x100000, kActuators = 0x200000;  // they draw apart from links
constexpr std::uint32_t kRoom = 64;                                  // entries of one channel at most

class Noise final : public Attack {
 public:
  Noise(const Params& params, const AttackContext& context)
      : deviation_(params.real("deviation")),
        drawn_(Eigen::VectorXd::Zero(kRoom)),
        draws_(context.seed, "adversary." + context.id + ".noise"),
        message_(context.message),
        readings_(context.readings) {
    for (const int size : context.readings) check_room(size);
    for (const int size : context.actuators) check_room(size);
    if (context.on_links) check_room(context.message);
  }

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Noise>(*this); }

  void act(std::int64_t k, std::span<const int> links, LinkEffects& effects) const override {
    for (const int link : links) {
      draw(k, static_cast<std::uint32_t>(link) * kRoom, message_);
      effects.inject(link, drawn_.head(message_));
    }
  }
  void tamper(std::int64_t k, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    for (std::size_t p = 0; p < places.size(); ++p) {
      const int size = readings_[p], first = places[p].channel < 0 ? 0 : places[p].channel;
      draw(k, kSensors + static_cast<std::uint32_t>(places[p].node) * kRoom + static_cast<std::uint32_t>(first), size);
      effects.add(places[p], drawn_.head(size), SensorState::fdi);
    }
  }
  void push(const ActuatorEffects::Push& at, double /*t*/, double /*branch*/,
            Eigen::Ref<Eigen::VectorXd> w) const override {
    const auto first =
        static_cast<std::uint32_t>(at.place.node) * kRoom + static_cast<std::uint32_t>(std::max(at.place.channel, 0));
    draw(at.k, kActuators + first, static_cast<int>(w.size()));
    w += drawn_.head(w.size());
  }

 private:
  static void check_room(int size) {
    if (size > static_cast<int>(kRoom))
      throw InputError("/", "noise acts on channels of at most " + std::to_string(kRoom) + " entries");
  }
  void draw(std::int64_t k, std::uint32_t first, int size) const {
    for (int c = 0; c < size; ++c) drawn_[c] = deviation_ * draws_.normal(k, first + static_cast<std::uint32_t>(c));
  }

  double deviation_;
  mutable Eigen::VectorXd drawn_;  ///< room for one channel's
  Draws draws_;
  int message_;
  std::vector<int> readings_;
};

const Registration<AttackMake> registration({
    "noise",
    {"Noise", "噪声注入"},
    "textbook",
    ParamTable({
        {.name = "deviation",
         .fallback = 1.0,
         .minimum = 0,
         .live = true,
         .symbol = "σ",
         .meaning = {"Standard deviation of every entry, in its unit", "各分量的标准差"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Noise>(params, context);
    },
    {.acts_on = {ChannelKind::link, ChannelKind::sensor, ChannelKind::actuator}},
});

}  // namespace
}  // namespace vigil
