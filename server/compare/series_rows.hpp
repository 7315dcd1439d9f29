/// The samples of runs side by side: for drawing, and judged against the first run.
#pragma once

#include "engine/metrics/paired_tolerance.hpp"
#include "server/compare/compared_run.hpp"

namespace vigil {

/// A signal of the comparison and its id in each run, -1 where a run does not have it.
struct ComparedSignal {
  Signal signal;  ///< as the first run that has it describes it
  std::vector<int> ids;
};

/// Ticks of the comparison: a run's tick k is k - offset.
struct TickRange {
  std::int64_t from = 0, to = 0;
};

/// [{"signal","unit","kind","labels","runs":[{"run","k","v" or "lo" and "hi","bucket"} or null]}]
Json series_rows(const std::vector<ComparedRun>& runs, const std::vector<ComparedSignal>& signals, TickRange range,
                 int points);

struct Judged {
  Json verdicts =
      Json::array();            ///< [{"signal","run","against","ticks","inside","first","worst","worst_at","outside"}]
  Json paired = Json::array();  ///< [{"signal","run","against","mean","se","ci","p","n","batches","lag1"}]
};

/// Every other run against the first, at the ticks that both have.
Judged judge_runs(const std::vector<ComparedRun>& runs, const std::vector<ComparedSignal>& signals, TickRange range,
                  const Tolerance& tolerance);

}  // namespace vigil
