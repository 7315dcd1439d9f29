/// Ellipsoids {x : x' E^-1 x <= 1} given by their shape matrices E, positive semidefinite. Specification (replay),
/// sections 4.3 to 4.5.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

namespace vigil {

/// The ellipsoid of least trace among (1 + q) E1 + (1 + 1/q) E2, q > 0: all of them contain the Minkowski sum. With s =
/// sqrt(trace): (s1 + s2)(E1/s1 + E2/s2). An operand of trace zero is the point 0: the sum is the other one. E1, E2:
/// n x n. No allocation where the operands are bounded.
template <class First, class Second>
typename First::PlainObject minimum_trace_sum(const Eigen::MatrixBase<First>& E1, const Eigen::MatrixBase<Second>& E2) {
  const double s1 = std::sqrt(std::max(0.0, E1.trace())), s2 = std::sqrt(std::max(0.0, E2.trace()));
  if (s1 == 0) return E2;
  if (s2 == 0) return E1;
  return E1 / s1 * (s1 + s2) + E2 / s2 * (s1 + s2);
}

/// The same of many: (sum s_i) sum E_i / s_i over the operands whose trace is not zero. At least one operand, all of
/// one size; zero where all are.
Eigen::MatrixXd minimum_trace_sum(std::span<const Eigen::MatrixXd> operands);

}  // namespace vigil
