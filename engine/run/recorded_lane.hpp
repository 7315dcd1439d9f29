/// A lane computed elsewhere: estimates that a trace brings in columns lane.<name>.<node>.estimate.<component>, scored
/// among ours.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/methods/method.hpp"
#include "engine/run/trace.hpp"

namespace vigil {

struct RecordedLane {
  std::string lane;
  std::unique_ptr<Method> method;
};

/// Every lane of the trace that the scenario does not have and that has all of the plant's state components at a node.
std::vector<RecordedLane> find_recorded_lanes(const std::shared_ptr<const Trace>& trace, const Json& lanes,
                                              const Plant& plant);

}  // namespace vigil
