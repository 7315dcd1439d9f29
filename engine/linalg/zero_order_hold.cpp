#include "engine/linalg/zero_order_hold.hpp"

#include <unsupported/Eigen/MatrixFunctions>

namespace vigil {

Held zero_order_hold(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double dt) {
  const auto n = A.rows();
  // The identity in the place of B dt: a large input must not ask for more squarings than A needs.
  Eigen::MatrixXd generator = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  generator.topLeftCorner(n, n) = A * dt;
  generator.topRightCorner(n, n).setIdentity();
  const Eigen::MatrixXd exponential = generator.exp();
  return {exponential.topLeftCorner(n, n), exponential.topRightCorner(n, n) * (dt * B)};
}

}  // namespace vigil
