/// From continuous time to ticks, exactly: the input is held from tick to tick.
#pragma once

#include <Eigen/Core>

namespace vigil {

/// x+ = A x + B u.
struct Held {
  Eigen::MatrixXd A;  ///< n x n
  Eigen::MatrixXd B;  ///< n x m
};

/// Of x' = A x + B u with u constant over dt seconds: e^(A dt) and (integral of e^(A s) ds from 0 to dt) B, read off
/// one exponential (Van Loan, 1978). A: n x n, B: n x m, m may be 0. Scaling and squaring: exact to rounding times |A|
/// dt. What overflows is not finite.
Held zero_order_hold(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double dt);

}  // namespace vigil
