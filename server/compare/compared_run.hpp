/// A run as a comparison needs it, wherever it comes from.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "db/reader.hpp"
#include "engine/run/trace.hpp"

namespace vigil {

/// Some signals at every tick that is there, in the order asked for.
struct Columns {
  std::vector<std::int64_t> k;
  std::vector<std::vector<double>> values;  ///< one a signal, as long as k; NaN where missing
};

struct ComparedRun {
  std::string id;  ///< of the run in the log, or the file's name
  std::string scenario;
  std::optional<std::uint64_t> seed;  ///< empty: not known (a frame file)
  std::string state;
  Json title;                 ///< {"en","zh"} or null
  Json parent;                ///< {"run","k"} or null
  double dt = 0;              ///< s
  Json document;              ///< null: not known
  Json input;                 ///< "simulate", {"trace":id}, …; null: not known
  std::vector<Command> live;  ///< what it took while it ran
  std::vector<MetricValue> metrics;
  std::vector<Signal> signals;           ///< those that have samples
  std::int64_t first = 0, last = -1;     ///< ticks there are
  std::optional<std::int64_t> attacked;  ///< tick at which its first attack begins
  std::int64_t offset = 0;               ///< tick that the comparison calls 0
  bool no_samples() const { return last < first; }

  /// Ticks from..to of some signals by id.
  std::function<Columns(const std::vector<int>& signals, std::int64_t from, std::int64_t to)> columns;
  /// The same for drawing, in at most about `points` buckets; empty: only for runs of a log.
  std::function<SampleWindow(const std::vector<int>& signals, std::int64_t from, std::int64_t to, int points)> window;
};

/// `reader` outlives the result.
ComparedRun run_of_log(const LogReader& reader, const RunRow& row);
/// The frames of a run as `vigil run --frames` writes them: no document, no metrics; an attack begins with the first
/// tick at which a link's or sensor's state is not 0.
ComparedRun run_of_frames(const std::string& file, Trace frames);

}  // namespace vigil
