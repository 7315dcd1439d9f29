/// DSDP 5.8 behind the engine's interface: a dual-scaling method whose iterates stay feasible, so that a stop short
/// still leaves something to certify. Specification (observer), section 6.
#pragma once

#include "engine/linalg/sdp.hpp"

namespace vigil {

/// Solves in the calling thread, one problem at a time in a process: the library keeps state of its own. The limit is
/// looked at once an iteration, which cannot be cut short; errors inside the library go to standard error.
class DsdpSolver : public SdpSolver {
 public:
  std::string_view name() const override { return "DSDP"; }
  SdpSolution solve(const SdpProblem& problem, double limit) override;
};

}  // namespace vigil
