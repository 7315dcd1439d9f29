/// Continuous time, a lane: plant and observers integrated together over a tick. Specification (observer), section 7.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/methods/continuous_method.hpp"
#include "engine/run/course.hpp"
#include "engine/world/interconnected/rk4.hpp"

namespace vigil {

/// Steps are as long as the fastest pole of both allows. Buffers of its own; stepping allocates nothing.
class LaneFlow {
 public:
  LaneFlow() = default;
  LaneFlow(const World& world, const ContinuousMethod& method);

  /// Tick 0: what the observers say before any time has passed.
  void begin(const Readings& heard, const Eigen::VectorXd& input, ContinuousMethod& method);
  /// The observers go from tick k - 1 to k along the plant, which starts from course.past. What they hear differs from
  /// the true outputs by noise, injections and playback: that difference, as it is at tick k, is held over the tick; a
  /// reading that is missing holds its last value. False where the observers' state is no longer finite.
  bool follow(const World& world, std::int64_t k, bool attacked, const Course& course, const Readings& heard,
              ContinuousMethod& method);
  /// The same without a plant, on a trace: readings run linearly from those of the last tick to these.
  bool follow_trace(std::int64_t k, const Readings& heard, const Eigen::VectorXd& input, ContinuousMethod& method);

  double step() const { return dt_ / steps_; }  ///< s

 private:
  void hear(const Readings& heard);

  double dt_ = 1;
  int steps_ = 1;
  observer::Rk4 both_{0}, alone_{0};
  Eigen::VectorXd state_, v_, u_, y_;
  Eigen::VectorXd now_, last_;  ///< readings of this tick and of the one before, missing ones held
  Eigen::VectorXd shift_;       ///< what is heard minus the true output; NaN: held at now_
};

}  // namespace vigil
