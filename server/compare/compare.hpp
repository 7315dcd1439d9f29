/// Runs side by side: the same for the API and the command line.
#pragma once

#include "engine/metrics/paired_tolerance.hpp"
#include "server/compare/compared_run.hpp"

namespace vigil {

inline constexpr std::size_t kMostRuns = 10;
inline constexpr std::size_t kMostSignals = 64;

struct CompareOrder {
  std::string signals;     ///< names and patterns, comma-separated; "" takes the lanes' errors, or their estimates
  bool by_attack = false;  ///< tick 0 is each run's first attack
  Tolerance tolerance;
  std::optional<std::int64_t> from, to;  ///< ticks of the comparison; empty: all that there is
  int points = 0;                        ///< buckets of the series for drawing; 0: none
};

/// {"runs","range","parameters","metrics","series","verdicts","paired"}, as docs/api.md has them. The first run is what
/// the others are measured by. Throws InputError with the query's parameter as its pointer: too few or many runs, one
/// twice, a pattern that fits nothing, too many signals, no attack to align by, too many samples.
Json compare_runs(std::vector<ComparedRun> runs, const CompareOrder& order);

}  // namespace vigil
