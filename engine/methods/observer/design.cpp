#include "engine/methods/observer/design.hpp"

namespace vigil::observer {
namespace {

DesignResult solve(const Synthesis& synthesis, SdpSolver& solver, double limit, std::string name) {
  DesignResult result{.solution = solver.solve(synthesis.problem, limit), .solver = std::move(name)};
  result.design = read_design(synthesis, result.solution.y);
  if (result.design) {
    result.certificate = certify(synthesis, *result.design, result.solution.y);
  } else if (!synthesis.given.empty()) {
    result.certificate = poles_only(synthesis.system, synthesis.given);
    result.certificate.reason = "no certificate was found for these gains";
  } else {
    result.certificate.reason = "no gains were found";
  }
  return result;
}

}  // namespace

DesignResult synthesise(const ErrorSystem& system, const SynthesisOptions& options, SdpSolver& solver, double limit) {
  return solve(theorem_1(system, options), solver, limit, std::string(solver.name()));
}

DesignResult certify_given(const ErrorSystem& system, const Gains& gains, const CertificationOptions& options,
                           SdpSolver& solver, double limit) {
  return solve(certification(system, gains, options), solver, limit, "given");
}

std::optional<DesignResult> fall_back(const Network& network, const RiccatiWeights& weights, SdpSolver& solver,
                                      double limit) {
  const auto gains = riccati_gains(network, weights);
  if (!gains) return std::nullopt;
  const CertificationOptions bounds{.pmin = 1e-2, .pmax = 1e6};
  return solve(certification(error_system(network), *gains, bounds), solver, limit, "Riccati");
}

}  // namespace vigil::observer
