/// Linear minimum-variance fusion of estimates whose errors are correlated. Seed 004, Lemma 2.1, (2-12), (2-13);
/// specification (privacy), section 1.4.
#pragma once

#include <Eigen/Core>

namespace vigil::privacy {

struct Fusion {
  Eigen::MatrixXd W;     ///< n x (n L), W e = I
  Eigen::MatrixXd P;     ///< W P W', n x n
  bool by_rule = false;  ///< the stacked covariance was (nearly) singular: Rao's unified least squares was used
};

/// The weights of least variance for the stacked covariance P, (n L) x (n L), positive semidefinite, of estimates of n
/// states. Where P's smallest eigenvalue is 1e-10 of its largest or less the fused covariance is still the least one,
/// but W is only one of many.
Fusion fuse(const Eigen::MatrixXd& P, int n);

/// The symmetric pseudo-inverse; eigenvalues of 1e-10 of the largest or less count as zero.
Eigen::MatrixXd symmetric_pseudo_inverse(const Eigen::MatrixXd& matrix);

}  // namespace vigil::privacy
