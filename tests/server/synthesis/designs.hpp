/// Designs of the examples by DSDP, for the tests: each must have its certificate.
#pragma once

#include <gtest/gtest.h>

#include "engine/methods/observer/design.hpp"
#include "engine/methods/observer/matched.hpp"
#include "server/synthesis/dsdp_solver.hpp"
#include "tests/engine/methods/observer/networks.hpp"

namespace vigil::observer {

inline SynthesisOptions classical(SynthesisOptions options) {
  options.structure = Structure::classical;
  return options;
}

inline SynthesisOptions with_free_kappa(SynthesisOptions options) {
  options.free_kappa = true;
  return options;
}

/// 30 s: far more than any of them takes.
inline DesignResult certified(const ErrorSystem& system, const SynthesisOptions& options) {
  DsdpSolver solver;
  DesignResult result = synthesise(system, options, solver, 30);
  EXPECT_TRUE(result.design);
  EXPECT_TRUE(result.certificate.holds) << result.certificate.reason << " (" << result.solution.detail << ")";
  if (!result.design) result.design = Design{.L = Gains(system.parts.size())};
  return result;
}

inline DesignResult certified(const Network& network, const SynthesisOptions& options) {
  return certified(error_system(network), options);
}

inline std::vector<Score> score(const Example& example, const SynthesisOptions& options, double from, double to) {
  const Gains gains = certified(example.network, options).design->L;
  return score(NetworkSimulation::intermediate(example.network, gains), example, from, to);
}

/// Within a share of the expected value, and half a unit of the last digit that the specification prints.
inline void expect_near(double value, double expected, double share, double half_digit = 0) {
  EXPECT_NEAR(value, expected, share * expected + half_digit);
}

/// Between half and twice the expected value: what depends on a pole that the optimum leaves free.
inline void expect_factor_2(double value, double expected) {
  EXPECT_GT(value, expected / 2);
  EXPECT_LT(value, expected * 2);
}

}  // namespace vigil::observer
