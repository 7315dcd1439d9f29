/// Orthogonal projectors on null spaces: a basis is only defined up to a rotation, the projector is not. Specification
/// (privacy), section 1.5.
#pragma once

#include <Eigen/Core>

namespace vigil::privacy {

/// Singular values above 1e-10 of the largest.
int numerical_rank(const Eigen::MatrixXd& G);
/// I - G^+ G, the projector on {v : G v = 0}; G: n x N, the result N x N. White noise of variance q sent through it is
/// white noise of variance q in the null space.
Eigen::MatrixXd null_projector(const Eigen::MatrixXd& G);

}  // namespace vigil::privacy
