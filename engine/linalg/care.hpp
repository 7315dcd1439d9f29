/// The continuous-time Riccati equation and its tests. Specification (observer), section 6, the fallback.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace vigil {

/// The largest real part of A's eigenvalues; A: n x n. Infinity where A is not finite, minus infinity where n = 0.
double spectral_abscissa(const Eigen::MatrixXd& A);

/// Every mode of A (n x n) that does not decay (real part of at least -1e-8 of A's size) is seen through C (p x n):
/// Hautus' test, the rank to 1e-10 of the size of A, whatever the outputs' common unit. False where A or C is not
/// finite.
bool detectable_continuous(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C);

/// The stabilising X (n x n, symmetric) of A X + X A' - X C' R^-1 C X + Q = 0: the eigenvalues of A - X C' R^-1 C have
/// negative real parts. A: n x n, C: p x n, Q: n x n positive semidefinite, R: p x p positive definite. Sign iteration
/// of the balanced Hamiltonian, finished by Newton's iteration (Kleinman, 1968). Nothing where (A, C) is not
/// detectable, no solution stabilises, sizes do not fit, or an input is not finite or not definite.
std::optional<Eigen::MatrixXd> solve_care(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Eigen::MatrixXd& Q,
                                          const Eigen::MatrixXd& R);

}  // namespace vigil
