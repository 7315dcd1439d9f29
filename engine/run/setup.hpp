/// What the files that set a run up share.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "engine/core/registry.hpp"
#include "engine/run/course.hpp"

namespace vigil {

/// The registered entry of a document's type. Throws InputError at `pointer`.
template <class Make>
const Entry<Make>& entry_of(const std::string& type, const std::string& pointer) {
  const auto* entry = Registry<Make>::find(type);
  if (entry == nullptr) throw InputError(pointer, fmt::format("there is no \"{}\" here", type));
  return *entry;
}

/// "actuator.<node>.w1.injected", "disturbance.<node>.d1", "fault.<node>.f1" by the plant's ports, "" for known inputs.
/// Where time goes in ticks and a controller drives the plant, it stands at the first node and the plant's inputs are
/// that node's actuators: "actuator.<node>.<input>.injected". Else empty.
std::vector<std::string> drive_names(const World& world, const std::vector<std::string>& nodes);

}  // namespace vigil
