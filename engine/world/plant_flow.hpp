/// Continuous time, a plant alone: one tick as an integration by RK4. Specification (observer), section 7.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/world/drive.hpp"
#include "engine/world/interconnected/rk4.hpp"

namespace vigil {

/// Buffers of its own; stepping allocates nothing.
class PlantFlow {
 public:
  PlantFlow() = default;
  /// dt: s, a tick.
  PlantFlow(const ContinuousPlant& plant, double dt)
      : dt_(dt),
        steps_(observer::steps_per_tick(dt, plant.fastest())),
        rk4_(plant.states()),
        v_(Eigen::VectorXd::Zero(plant.drives())) {}

  /// x of tick k - 1 becomes that of tick k. pushes: null where the adversary does not touch it.
  void advance(const ContinuousPlant& plant, const Drive& drive, const ActuatorEffects* pushes, std::int64_t k,
               Eigen::VectorXd& x) {
    const double h = dt_ / steps_, start = static_cast<double>(k - 1) * dt_;
    for (int step = 0; step < steps_; ++step) {
      rk4_.step(x, start + step * h, h, [&](double time, double branch, const Eigen::VectorXd& at, auto dx) {
        drive.read(time, branch, pushes, v_);
        plant.slope(at, v_, dx);
      });
    }
  }

 private:
  double dt_ = 1;
  int steps_ = 1;
  observer::Rk4 rk4_{0};
  Eigen::VectorXd v_;
};

}  // namespace vigil
