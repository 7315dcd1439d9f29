/// What drives a plant in continuous time: given signals of its nodes and, on top, whoever attacks its actuators.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "engine/adversary/attack.hpp"
#include "engine/core/json.hpp"
#include "engine/world/continuous.hpp"
#include "engine/world/interconnected/signals.hpp"

namespace vigil {

class Drive {
 public:
  Drive() = default;
  /// nodes: the document's, whose "signals" are {"<u1, d1 or f1, …>":{"type","params"}}. Throws InputError under /nodes
  /// for a channel that the plant has not.
  Drive(const ContinuousPlant& plant, const Json& nodes);

  /// v at time t, s; `branch`: the middle of the step of integration, or t for a sample. pushes: null for a plant that
  /// the adversary does not touch. No allocation.
  void read(double t, double branch, const ActuatorEffects* pushes, Eigen::Ref<Eigen::VectorXd> v) const;

 private:
  std::vector<DrivePorts> ports_;
  std::vector<observer::Signal> signals_;  ///< as many as v has entries
};

}  // namespace vigil
