#include "engine/linalg/ellipsoid.hpp"

namespace vigil {

Eigen::MatrixXd minimum_trace_sum(std::span<const Eigen::MatrixXd> operands) {
  double roots = 0;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(operands.front().rows(), operands.front().cols());
  for (const auto& E : operands) {
    const double root = std::sqrt(std::max(0.0, E.trace()));
    if (root == 0) continue;
    roots += root;
    sum += E / root;
  }
  return roots * sum;
}

}  // namespace vigil
