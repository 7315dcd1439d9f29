/// The fault made a state, and the errors' dynamics. Seed 002, eqs (2)-(6), (16); specification (observer), sections 2
/// and 4.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "engine/world/interconnected/network.hpp"

namespace vigil::observer {

/// xi1 = [x; f]: xi1' = A2 xi1 + B2 u + D2 w + F2 Phi + J2 y + Dd2 d - alpha sum_j H2_ij xi1_j + E2 y', eq. (6).
struct Augmented {
  Eigen::MatrixXd A2, B2, D2, F2, Dd2;  ///< n + g rows
  Eigen::MatrixXd J2, E2;               ///< (n + g) x p
  Eigen::MatrixXd C1;                   ///< [C G], p x (n + g)
  Eigen::MatrixXd C1_clean;             ///< [C 0], p x (n + g): y - G f
  Eigen::MatrixXd N;                    ///< varsigma D2', q x (n + g)
};
/// Of a checked subsystem. By the closed-form left inverse K2^+, which is not Moore and Penrose's where p > g.
Augmented augment(const Subsystem& subsystem);
/// K2^+ = [I 0; -G^+ C  G^+ E^-1], (n + g) x (n + p).
Eigen::MatrixXd left_inverse(const Subsystem& subsystem);
/// K2^+ [H 0; 0 0], (n_to + g_to) x (n_from + g_from).
Eigen::MatrixXd augmented_coupling(const Network& network, const Coupling& coupling);

/// One subsystem's part of the errors' dynamics: e' = (Abar - gain L Cbar) e + Fbar ephi + Kbar d + Wbar w' - coupling.
struct ErrorPart {
  Eigen::MatrixXd Abar;  ///< N_i x N_i
  Eigen::MatrixXd Cbar;  ///< p x N_i
  Eigen::MatrixXd Fbar;  ///< N_i x r
  Eigen::MatrixXd Kbar;  ///< N_i x dd
  Eigen::MatrixXd Wbar;  ///< N_i x q
  Eigen::MatrixXd Mbar;  ///< n x N_i, the error of x
  double tau = 0;
  std::optional<double> kappa;  ///< nothing: a variable
  double mu = 1;
  double decay = 0;  ///< Abar + decay I stands for Abar in the inequality: at least this rate of decay, 1/s
  int integral = 0;  ///< the last rows of e, of theta: what the classical structure leaves without innovation
};
/// e_to' has -K e_from; K: N_to x N_from, alpha and Nbar included.
struct ErrorCoupling {
  int to = 0;
  int from = 0;
  Eigen::MatrixXd K;
};
/// What the inequality, the certificate and the poles need to know of any observer here.
struct ErrorSystem {
  std::vector<ErrorPart> parts;
  std::vector<ErrorCoupling> couplings;
};
/// L_i: N_i x p_i, for every subsystem.
using Gains = std::vector<Eigen::MatrixXd>;

/// Eq. (16): e = [xi1 - xi1hat; theta - thetahat].
ErrorSystem error_system(const Network& network);

/// The whole network's: blocks Abar_i - mu_i L_i Cbar_i, and -K off them.
Eigen::MatrixXd global_error_matrix(const ErrorSystem& system, const Gains& gains);
/// Its eigenvalues, the slowest first.
std::vector<std::complex<double>> poles(const Eigen::MatrixXd& matrix);

}  // namespace vigil::observer
