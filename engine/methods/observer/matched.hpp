/// The matched unknown-input observer that the proposed one is compared with. Specification (observer), section 8.2.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/methods/observer/augment.hpp"

namespace vigil::observer {

/// rank(C D) = rank(D): an area without it cannot have this observer.
bool matching_condition(const Subsystem& subsystem);

/// T = I - D (CD)^+ C and (CD)^+, which is zero where the condition is violated: the fallback of the demonstration.
struct Matching {
  bool holds = false;
  Eigen::MatrixXd inverse;     ///< (CD)^+, q x p
  Eigen::MatrixXd projection;  ///< T, n x n
};
Matching matching(const Subsystem& subsystem);

/// e = x - xhat, e' = (T A - L C) e - alpha T sum_j H_ij e_j; a decay rate of 1/s is asked for. Faults, disturbances
/// and the nonlinearity are not part of it.
ErrorSystem matched_error_system(const Network& network);

inline constexpr double kDerivativeTime = 0.01;  ///< s, of the filtered derivative of y

}  // namespace vigil::observer
