/// What a design is accepted on: computed from the gains themselves, whatever a solver said.
/// Specification (observer), section 6, consequence (a), and section 11.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/methods/observer/synthesis.hpp"

namespace vigil::observer {

struct Certificate {
  double lambda_max_sigma = 0;              ///< at most -eps/2 (below 0 where eps is 0)
  double lambda_min_p = 0;                  ///< above 0, least over subsystems
  std::vector<double> margins;              ///< smallest eigenvalue of every block of the problem, in its order
  double max_real_pole = 0;                 ///< below 0, of the whole network's errors, 1/s
  double fastest_pole = 0;                  ///< largest modulus, 1/s: sets the step of integration
  std::vector<std::complex<double>> poles;  ///< the slowest first
  std::vector<double> norm_l;               ///< spectral norm of every subsystem's L
  bool holds = false;
  std::string reason;  ///< why not, in a sentence; empty where it holds
};

/// Sigma of (17) from P, L (W = P L) and the gammas, without eps; its order is that of the problem's first block.
Eigen::MatrixXd sigma(const ErrorSystem& system, const Design& design);
Certificate certify(const Synthesis& synthesis, const Design& design, const Eigen::VectorXd& y);
/// Poles and norms alone, for gains without a design; `holds` is false.
Certificate poles_only(const ErrorSystem& system, const Gains& gains);

Json to_json(const Certificate& certificate);
/// {"L":[[[…]]],"P":…,"gamma_d":…,"gamma_w":…,"kappa":…,"objective":…}, every double exactly.
Json to_json(const Design& design);
/// Throws InputError below `pointer`.
Design read_design(const Json& document, const std::string& pointer);

}  // namespace vigil::observer
