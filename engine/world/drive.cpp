#include "engine/world/drive.hpp"

#include <fmt/format.h>

#include "engine/core/describe.hpp"
#include "engine/world/interconnected/waveform.hpp"

namespace vigil {
namespace {

/// The place of "f2" among the node's drives, -1: it has no such channel.
int place_of(const DrivePorts& ports, const std::string& channel) {
  const auto among = [&](char letter, int count, int first) {
    for (int entry = 0; entry < count; ++entry) {
      if (channel == letter + std::to_string(entry + 1)) return first + entry;
    }
    return -1;
  };
  return std::max(
      {among('u', ports.u, ports.first), among('d', ports.d, ports.at_d()), among('f', ports.f, ports.at_f())});
}

std::vector<std::string> channels_of(const DrivePorts& ports) {
  std::vector<std::string> names;
  const auto add = [&](char letter, int count) {
    for (int entry = 1; entry <= count; ++entry) names.push_back(letter + std::to_string(entry));
  };
  add('u', ports.u);
  add('d', ports.d);
  add('f', ports.f);
  return names;
}

}  // namespace

Drive::Drive(const ContinuousPlant& plant, const Json& nodes)
    : ports_(plant.ports()), signals_(static_cast<std::size_t>(plant.drives())) {
  std::size_t i = 0;
  for (const auto& [id, node] : nodes.items()) {
    const DrivePorts& ports = ports_.at(i++);
    const Json given = node.value("signals", Json::object());
    for (const auto& [channel, signal] : given.items()) {
      const std::string pointer = child(child("/nodes", id) + "/signals", channel);
      const int place = place_of(ports, channel);
      if (place < 0) {
        const auto names = channels_of(ports);
        throw InputError(pointer,
                         fmt::format("node \"{}\" has no signal {}; expected one of {}", id, in_quotes(channel),
                                     names.empty() ? "none" : listed(names)),
                         listed(names));
      }
      signals_[static_cast<std::size_t>(place)] = observer::read_signal(signal, pointer);
    }
  }
}

void Drive::read(double t, double branch, const ActuatorEffects* pushes, Eigen::Ref<Eigen::VectorXd> v) const {
  for (std::size_t entry = 0; entry < signals_.size(); ++entry)
    v[static_cast<Eigen::Index>(entry)] = signals_[entry].value(t, branch);
  if (pushes == nullptr) return;
  for (const ActuatorEffects::Push& push : pushes->pushes) {
    const DrivePorts& ports = ports_[static_cast<std::size_t>(push.place.node)];
    const bool whole = push.place.channel < 0;
    push.attack->push(push, t, branch, v.segment(ports.at_w() + (whole ? 0 : push.place.channel), whole ? ports.w : 1));
  }
}

}  // namespace vigil
