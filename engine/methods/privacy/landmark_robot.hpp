/// The robot that measures ranges and bearings of landmarks, (2-47)-(2-52) with the Jacobian corrected. Specification
/// (privacy), section 2.6. State: Sx and Sy in m, heading in rad and not wrapped.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {

struct LandmarkRobot {
  double speed = 1;    ///< m/s
  double turn = 0.05;  ///< rad/s
  double step = 1;     ///< s
  /// Of every sensor, in m.
  std::vector<std::vector<Eigen::Vector2d>> landmarks{{{-30, -20}, {30, -20}}, {{30, 60}, {-30, 60}}};

  Eigen::Vector3d move(const Eigen::Vector3d& x) const;
  Eigen::Matrix3d move_jacobian(const Eigen::Vector3d& x) const;
  /// (range, bearing) of every landmark of the sensor, bearings in (-pi, pi].
  Eigen::VectorXd observe(std::size_t sensor, const Eigen::Vector3d& x) const;
  /// On a landmark the squared range counts as 1e-12.
  Eigen::MatrixXd observe_jacobian(std::size_t sensor, const Eigen::Vector3d& x) const;
  /// y - h(x), its bearings wrapped to (-pi, pi].
  Eigen::VectorXd innovation(std::size_t sensor, const Eigen::VectorXd& y, const Eigen::Vector3d& x) const;
};

/// The laws of section 2.6: process noise, start and the sensors' noise.
struct LandmarkNoise {
  Eigen::MatrixXd Q, P0;
  std::vector<Eigen::MatrixXd> R;
};
LandmarkNoise landmark_noise();

/// One sensor's extended Kalman step of the state: what it linearises to from the estimate before.
LocalStep linearised(const LandmarkRobot& robot, std::size_t sensor, const Eigen::Vector3d& before,
                     const Eigen::MatrixXd& R);

}  // namespace vigil::privacy
