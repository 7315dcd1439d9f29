#include "server/synthesis/dsdp_solver.hpp"

extern "C" {  // one of its headers forgets to say so
#include <dsdp5.h>
}
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <type_traits>

namespace vigil {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kBound = 1e10;  // of |y|: at the library's own 1e7 it stops far from the optimum of large gains

// Of the potential that it follows: at the library's own value, with entries given sparsely, it stops 1.4 % above the
// optimum of the pair's `fast` design; given densely it is eight times slower.
constexpr double kPotential = 2;

constexpr double kNoEnd = 1e6;  // s

struct Destroy {
  void operator()(DSDP solver) const { DSDPDestroy(solver); }
};
using Handle = std::unique_ptr<std::remove_pointer_t<DSDP>, Destroy>;

/// DSDP keeps pointers into the entries that it is given until it is destroyed.
struct Group {
  int matrix = 0, block = 0;
  std::vector<int> places;  ///< in the packed lower triangle: row (row + 1) / 2 + column
  std::vector<double> values;
};

/// DSDP maximises b'y subject to C - sum y_k A_k >= 0: b = -c, C = -F_0, A_k = -F_k.
std::vector<Group> groups_of(const SdpProblem& problem) {
  std::vector<Group> groups;
  for (const SdpEntry& entry : problem.entries) {
    if (groups.empty() || groups.back().matrix != entry.matrix || groups.back().block != entry.block) {
      groups.push_back({.matrix = entry.matrix, .block = entry.block});
    }
    groups.back().places.push_back(entry.column * (entry.column + 1) / 2 + entry.row);
    groups.back().values.push_back(-entry.value);
  }
  return groups;
}

struct Limit {
  Clock::time_point end;
  bool passed = false;
};

int look_at_the_clock(DSDP solver, void* data) {
  auto& limit = *static_cast<Limit*>(data);
  DSDPTerminationReason reason = CONTINUE_ITERATING;
  DSDPStopReason(solver, &reason);
  if (reason != CONTINUE_ITERATING || Clock::now() < limit.end) return 0;
  limit.passed = true;
  return DSDPSetConvergenceFlag(solver, DSDP_USER_TERMINATION);
}

std::string_view words(DSDPTerminationReason reason) {
  switch (reason) {
    case DSDP_CONVERGED:
      return "converged";
    case DSDP_INFEASIBLE_START:
      return "infeasible start";
    case DSDP_SMALL_STEPS:
      return "short steps";
    case DSDP_INDEFINITE_SCHUR_MATRIX:
      return "indefinite Schur complement";
    case DSDP_MAX_IT:
      return "most iterations allowed";
    case DSDP_NUMERICAL_ERROR:
      return "numerical error";
    case DSDP_UPPERBOUND:
      return "objective beyond its bound";
    case DSDP_USER_TERMINATION:
      return "time limit";
    case CONTINUE_ITERATING:
      break;
  }
  return "not finished";
}

SdpVerdict verdict_of(DSDPTerminationReason reason, DSDPSolutionType type, bool late) {
  if (late) return SdpVerdict::timed_out;
  if (type == DSDP_INFEASIBLE) return SdpVerdict::infeasible;
  return reason == DSDP_CONVERGED ? SdpVerdict::solved : SdpVerdict::stopped;
}

/// Null where DSDP refuses or memory is short.
Handle load(const SdpProblem& problem, std::vector<Group>& groups) {
  DSDP raw = nullptr;
  if (DSDPCreate(problem.variables(), &raw) != 0) return nullptr;
  Handle solver(raw);
  SDPCone cone = nullptr;
  if (DSDPCreateSDPCone(raw, static_cast<int>(problem.blocks.size()), &cone) != 0) return nullptr;
  for (int k = 0; k < problem.variables(); ++k) {
    if (DSDPSetDualObjective(raw, k + 1, -problem.cost[static_cast<std::size_t>(k)]) != 0) return nullptr;
  }
  for (std::size_t block = 0; block < problem.blocks.size(); ++block) {
    if (SDPConeSetBlockSize(cone, static_cast<int>(block), problem.blocks[block]) != 0) return nullptr;
  }
  for (Group& group : groups) {
    const int order = problem.blocks[static_cast<std::size_t>(group.block)];
    const int count = static_cast<int>(group.places.size());
    if (SDPConeSetASparseVecMat(cone, group.block, group.matrix, order, 1, 0, group.places.data(), group.values.data(),
                                count) != 0) {
      return nullptr;
    }
  }
  if (DSDPSetYBounds(raw, -kBound, kBound) != 0 || DSDPSetPotentialParameter(raw, kPotential) != 0) return nullptr;
  return solver;
}

}  // namespace

SdpSolution DsdpSolver::solve(const SdpProblem& problem, double limit) {
  const auto begin = Clock::now();
  const std::chrono::duration<double> allowed(limit > 0 ? std::min(limit, kNoEnd) : 0);
  Limit clock{.end = begin + std::chrono::duration_cast<Clock::duration>(allowed)};
  SdpSolution solution;
  solution.detail = "DSDP does not take the problem";
  if (problem.variables() == 0 || problem.blocks.empty()) return solution;
  auto groups = groups_of(problem);
  const Handle solver = load(problem, groups);
  if (!solver || DSDPSetMonitor(solver.get(), look_at_the_clock, &clock) != 0 || DSDPSetup(solver.get()) != 0) {
    return solution;
  }
  const int code = DSDPSolve(solver.get());
  DSDPTerminationReason reason = CONTINUE_ITERATING;
  DSDPSolutionType type = DSDP_PDUNKNOWN;
  DSDPStopReason(solver.get(), &reason);
  if (code == 0 && !clock.passed) DSDPComputeX(solver.get());  // only then does it know what kind of answer it has
  DSDPGetSolutionType(solver.get(), &type);
  DSDPGetIts(solver.get(), &solution.iterations);
  solution.y.resize(problem.variables());
  const bool given = DSDPGetY(solver.get(), solution.y.data(), problem.variables()) == 0 && solution.y.allFinite();
  if (!given) solution.y.resize(0);
  solution.verdict = given ? verdict_of(reason, type, clock.passed) : SdpVerdict::failed;
  solution.detail = words(reason);
  if (code != 0) solution.detail += fmt::format(", code {}", code);
  solution.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return solution;
}

}  // namespace vigil
