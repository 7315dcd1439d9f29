/// Runge and Kutta's classical fourth order with a fixed step. Specification (observer), section 7.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace vigil::observer {

/// Steps in a tick of dt seconds so that h |lambda| <= 2 for the fastest pole (1/s); stability ends at 2.7. At least 1.
inline int steps_per_tick(double dt, double fastest) {
  return std::max(1, static_cast<int>(std::ceil(dt * fastest / 2)));
}

/// Buffers are made once; stepping allocates nothing. The state is a column of any length.
class Rk4 {
 public:
  explicit Rk4(Eigen::Index size) : k_(size, 4), at_(size) {}

  /// From t to t + h, in place. derivative(time, branch, state, out): the slope at `time` with every signal's piece
  /// that is in force at `branch`, the step's midpoint, so that no step mixes two pieces.
  template <class Derivative>
  void step(Eigen::VectorXd& state, double t, double h, Derivative&& derivative) {
    const double branch = t + h / 2;
    derivative(t, branch, state, k_.col(0));
    at_ = state + h / 2 * k_.col(0);
    derivative(branch, branch, at_, k_.col(1));
    at_ = state + h / 2 * k_.col(1);
    derivative(branch, branch, at_, k_.col(2));
    at_ = state + h * k_.col(2);
    derivative(t + h, branch, at_, k_.col(3));
    state += h / 6 * (k_.col(0) + 2 * (k_.col(1) + k_.col(2)) + k_.col(3));
  }

 private:
  Eigen::MatrixXd k_;
  Eigen::VectorXd at_;
};

}  // namespace vigil::observer
