/// What drives the plant: the input of a tick from the tick and an estimate.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/params.hpp"
#include "engine/core/registry.hpp"
#include "engine/world/plant.hpp"

namespace vigil {

/// Immutable and shared.
class Controller {
 public:
  virtual ~Controller() = default;
  /// u (inputs): what acts from tick k to k+1. estimate: states, or null while there is none.
  virtual void input(std::int64_t k, const double* estimate, Eigen::Ref<Eigen::VectorXd> u) const = 0;
  /// Constants for the page and for tests: gains, poles.
  virtual Json design() const { return Json::object(); }
  /// Sentences about it that whoever starts a run must know.
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// x+ = A x + B u, read off a plant that is linear.
LinearModel linear_model(const Plant& plant);

/// Throws InputError (pointers relative to the params) where there is no such controller for the plant.
using ControllerMake = std::shared_ptr<const Controller> (*)(const Params& params, const Plant& plant);

}  // namespace vigil
