#include "engine/methods/privacy/landmark_robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vigil::privacy {
namespace {

constexpr double kLeastSquare = 1e-12;  // m^2

/// To (-pi, pi].
double wrapped(double angle) {
  const double rest = std::remainder(angle, 2 * std::numbers::pi);
  return rest <= -std::numbers::pi ? std::numbers::pi : rest;
}

}  // namespace

Eigen::Vector3d LandmarkRobot::move(const Eigen::Vector3d& x) const {
  return {x[0] + step * speed * std::cos(x[2]), x[1] + step * speed * std::sin(x[2]), x[2] + step * turn};
}

Eigen::Matrix3d LandmarkRobot::move_jacobian(const Eigen::Vector3d& x) const {
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  A(0, 2) = -step * speed * std::sin(x[2]);
  A(1, 2) = step * speed * std::cos(x[2]);
  return A;
}

Eigen::VectorXd LandmarkRobot::observe(std::size_t sensor, const Eigen::Vector3d& x) const {
  Eigen::VectorXd y(2 * static_cast<Eigen::Index>(landmarks[sensor].size()));
  Eigen::Index row = 0;
  for (const Eigen::Vector2d& landmark : landmarks[sensor]) {
    const Eigen::Vector2d way = landmark - x.head<2>();
    y[row++] = way.norm();
    y[row++] = wrapped(x[2] - std::atan2(way[1], way[0]));
  }
  return y;
}

Eigen::MatrixXd LandmarkRobot::observe_jacobian(std::size_t sensor, const Eigen::Vector3d& x) const {
  Eigen::MatrixXd C(2 * static_cast<Eigen::Index>(landmarks[sensor].size()), 3);
  Eigen::Index row = 0;
  for (const Eigen::Vector2d& landmark : landmarks[sensor]) {
    const Eigen::Vector2d way = landmark - x.head<2>();
    const double square = std::max(way.squaredNorm(), kLeastSquare), range = std::sqrt(square);
    C.row(row++) << -way[0] / range, -way[1] / range, 0;
    C.row(row++) << -way[1] / square, way[0] / square, 1;
  }
  return C;
}

Eigen::VectorXd LandmarkRobot::innovation(std::size_t sensor, const Eigen::VectorXd& y,
                                          const Eigen::Vector3d& x) const {
  Eigen::VectorXd rest = y - observe(sensor, x);
  for (Eigen::Index row = 1; row < rest.size(); row += 2) rest[row] = wrapped(rest[row]);
  return rest;
}

LandmarkNoise landmark_noise() {
  return {.Q = Eigen::Vector3d(0.01, 0.01, 1e-4).asDiagonal(),
          .P0 = Eigen::Vector3d(0.01, 0.01, 1e-4).asDiagonal(),
          .R = {Eigen::Vector4d(0.09, 9e-4, 0.09, 9e-4).asDiagonal(),
                Eigen::Vector4d(0.16, 1.6e-3, 0.16, 1.6e-3).asDiagonal()}};
}

LocalStep linearised(const LandmarkRobot& robot, std::size_t sensor, const Eigen::Vector3d& before,
                     const Eigen::MatrixXd& R) {
  return {robot.move_jacobian(before), robot.observe_jacobian(sensor, robot.move(before)), R};
}

}  // namespace vigil::privacy
