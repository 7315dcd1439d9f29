/// The one check of hand-written Jacobians: central differences.
#pragma once

#include <Eigen/Core>

namespace vigil {

/// d f / d x at x by central differences of step h; `difference` takes f's values apart (angles are wrapped there).
/// f: VectorXd -> VectorXd; the error is of order h^2 f''' + 1e-16/h.
template <class Function, class Difference>
Eigen::MatrixXd central_differences(const Function& f, const Eigen::VectorXd& x, const Difference& difference,
                                    double h = 1e-5) {
  Eigen::MatrixXd jacobian(f(x).size(), x.size());
  for (Eigen::Index c = 0; c < x.size(); ++c) {
    Eigen::VectorXd above = x, below = x;
    above[c] += h;
    below[c] -= h;
    jacobian.col(c) = difference(f(above), f(below)) / (above[c] - below[c]);
  }
  return jacobian;
}

}  // namespace vigil
