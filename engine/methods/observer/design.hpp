/// From a network to gains that are certified, by whatever solver is at hand. Specification (observer), section 6.
#pragma once

#include <optional>
#include <string>

#include "engine/methods/observer/certificate.hpp"
#include "engine/methods/observer/fallback.hpp"

namespace vigil::observer {

struct DesignResult {
  std::optional<Design> design;  ///< nothing where none was found, certified or not
  Certificate certificate;       ///< accept the design only where it holds
  SdpSolution solution;          ///< the solver's own account
  std::string solver;            ///< "DSDP", "Riccati", "given"
};

/// Theorem 1, or the same for a matched_error_system. limit: seconds. Throws std::length_error above kMaxVariables.
DesignResult synthesise(const ErrorSystem& system, const SynthesisOptions& options, SdpSolver& solver, double limit);
/// The best certificate that is found for gains at hand. Nothing as `design` says that the solver gave none: poles and
/// norms of the certificate are those of the gains all the same.
DesignResult certify_given(const ErrorSystem& system, const Gains& gains, const CertificationOptions& options,
                           SdpSolver& solver, double limit);
/// Riccati gains with P in [1e-2, 1e6]. Nothing at all where an equation has no stabilising answer.
std::optional<DesignResult> fall_back(const Network& network, const RiccatiWeights& weights, SdpSolver& solver,
                                      double limit);

}  // namespace vigil::observer
