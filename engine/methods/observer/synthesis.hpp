/// Gains from a linear matrix inequality. Seed 002, Theorem 1, eq. (17); specification (observer), sections 5 and 6.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/linalg/sdp.hpp"
#include "engine/methods/observer/augment.hpp"

namespace vigil::observer {

enum class Structure {
  proposed,  ///< the innovation drives every row
  classical  ///< none in theta': P = diag(P_xi, P_theta), W's theta rows zero; specification, section 8.3
};

/// Bounds and prices that make the problem well posed.
struct SynthesisOptions {
  double pmin = 1e-2;  ///< pmin I <= P <= pmax I; no upper bound where there is none
  std::optional<double> pmax = 1e4;
  double cnu = 1e-5;           ///< price of mu^2 nu, L'PL <= nu I
  double cd = 1;               ///< price of gamma_d^2
  double cw = 100;             ///< price of gamma_w^2
  std::optional<double> rmax;  ///< local poles have real parts above -rmax, 1/s
  double eps = 1e-3;           ///< Sigma <= -eps I
  Structure structure = Structure::proposed;
  bool free_kappa = false;  ///< kappa a variable, whatever the network says
};
SynthesisOptions ref();      ///< moderate gains
SynthesisOptions fast();     ///< reproduces the figures
SynthesisOptions matched();  ///< of the unknown-input observer, specification, section 8.2

/// Where the unknowns of a subsystem are in y; -1 for none.
struct Unknowns {
  int P = -1;  ///< lower triangle by columns (of both diagonal blocks, where classical)
  int W = -1;  ///< by columns (of the rows of xi, where classical)
  int gd2 = -1, gw2 = -1, nu = -1, kappa = -1;
};

/// A problem with what is needed to read its answer.
struct Synthesis {
  SdpProblem problem;
  ErrorSystem system;
  std::vector<Unknowns> unknowns;
  SynthesisOptions options;
  Gains given;  ///< certification: L is fixed and W = P L; empty otherwise
};

/// Theorem 1. Throws std::length_error above kMaxVariables.
Synthesis theorem_1(const ErrorSystem& system, const SynthesisOptions& options);
inline constexpr int kMaxVariables = 1000;

/// Bounds on P of a certification; nothing: P > 0 alone.
struct CertificationOptions {
  std::optional<double> pmin, pmax;
  double eps = 0;
};
/// Theorem 1 with L given: the least sum of gamma^2. Specification, section 8.1.
Synthesis certification(const ErrorSystem& system, const Gains& gains, const CertificationOptions& options);

/// What every block of the problem says, in its order: "Sigma", "P of 1 above pmin", … by the subsystems' numbers.
std::vector<std::string> block_names(const Synthesis& synthesis);

/// An answer in the theorem's own letters.
struct Design {
  Gains L;
  std::vector<Eigen::MatrixXd> P;
  std::vector<double> gamma_d, gamma_w;  ///< 0 where a subsystem has none
  std::vector<double> kappa;             ///< as given or found; 0 where r = 0
  double objective = 0;
};
/// L = P^-1 W by Cholesky, or as given. Nothing where y has another length, is not finite or some P is not definite.
std::optional<Design> read_design(const Synthesis& synthesis, const Eigen::VectorXd& y);

}  // namespace vigil::observer
