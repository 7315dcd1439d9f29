/// Discrete Riccati equations and the tests that say whether one has an answer. Specification (replay), section 2.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace vigil {

/// The largest modulus of A's eigenvalues; A: n x n. Infinity where A is not finite.
double spectral_radius(const Eigen::MatrixXd& A);

/// Every mode of A (n x n) that does not decay can be moved through B (n x m): Hautus' test at each eigenvalue of
/// modulus 1 or more, the modulus to 1e-8, the rank to 1e-10 of the size of A, whatever the inputs' units. False where
/// A or B is not finite.
bool stabilisable(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// Every mode of A (n x n) that does not decay is seen through C (p x n): the dual of stabilisable.
bool detectable(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C);

/// The stabilising S (n x n, symmetric) of S = A'SA - A'SB (B'SB + R)^-1 B'SA + Q. A: n x n, B: n x m, Q: n x n
/// positive semidefinite, R: m x m positive definite. Structured doubling (Chu, Fan, Lin and Wang, 2004), finished by
/// Newton's iteration (Hewer, 1971). Nothing where (A, B) is not stabilisable, no solution stabilises (a mode of
/// modulus 1 that Q does not weigh), sizes do not fit, or an input is not finite or not definite.
std::optional<Eigen::MatrixXd> solve_dare(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                                          const Eigen::MatrixXd& R);

/// The feedback u = L x of least cost, L = -(B'SB + R)^-1 B'SA; m x n.
Eigen::MatrixXd lqr_gain(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& R,
                         const Eigen::MatrixXd& S);

}  // namespace vigil
