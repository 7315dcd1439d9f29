/// Reading the log: read-only connections, safe from many threads, never in the way of the writer.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "db/cell_summary.hpp"
#include "db/query.hpp"
#include "db/records.hpp"

namespace vigil {

/// Some signals over a range of ticks.
struct SampleWindow {
  struct Series {
    int signal = 0;
    std::vector<double> v;       ///< raw: the values, NaN where missing
    std::vector<double> lo, hi;  ///< otherwise the extremes of each bucket, NaN where it holds no number
  };
  bool raw = true;
  std::int64_t first = 0, last = -1;  ///< ticks the log has of the run at all
  std::vector<std::int64_t>
      k;                  ///< raw: the ticks; otherwise the first tick of each bucket, which ends before the next one's
  std::vector<double> t;  ///< s, of each k
  std::int64_t bucket = 1;     ///< ticks a bucket spans; 1 when raw
  std::vector<Series> series;  ///< in the order asked for
  std::vector<GapRow> gaps;    ///< in the range
};

struct RunPage {
  std::vector<RunRow> items;
  std::optional<std::string> next;  ///< cursor
};

struct MarkPage {
  struct Item {
    std::int64_t serial = 0;  ///< rises in the order of writing
    Mark mark;
  };
  std::vector<Item> items;
  std::optional<std::string> next;
};

struct MarkFilter {
  std::optional<std::int64_t> from, to;  ///< ticks, both included
  std::vector<MarkType> types;           ///< empty: all
  std::vector<std::string> lanes;        ///< empty: all
  std::string cursor;
  int limit = 1000;
};

struct LogCounts {
  std::int64_t runs = 0;
  std::vector<std::pair<std::string, std::int64_t>> by_state;
  std::int64_t blocks = 0;  ///< sealed pieces of 512 rows
  std::int64_t bytes = 0;   ///< file and write-ahead log
};

/// What the numbers of a cell's trials are called; cells that have the same share them.
struct ColumnsRow {
  std::int64_t cell = 0;
  std::shared_ptr<const Json> columns;
};

struct SummaryRow {
  std::int64_t cell = 0;
  CellSummary summary;
};

class LogReader {
 public:
  /// Throws LogError (unusable) where the file is not a log of this version; the writer must have made it.
  explicit LogReader(const std::string& path);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  std::optional<RunRow> run(RunId id) const;
  /// `sort`: a field (id created started ended scenario family state seed metrics.<name> <lane>.<name>), `-` before it
  /// for falling; empty: newest first. Throws QueryError on a bad sort, cursor or limit (1 to 1000).
  RunPage list(const Query& query, std::string_view sort, int limit, std::string_view cursor) const;
  std::int64_t count(const Query& query) const;

  std::vector<Signal> signals(RunId run) const;  ///< whole catalogue; logged or not
  std::vector<int> logged_signals(RunId run) const;
  /// Ticks from..to, both included. At most about `points` buckets (raw where the range has no more rows than that);
  /// extremes are exact for every bucket at every zoom. Signals that are not logged come back as NaN.
  SampleWindow samples(RunId run, const std::vector<int>& signals, std::int64_t from, std::int64_t to,
                       int points) const;
  /// Every row of the range in order; `values` lives only for the call; false from it ends the reading. No lock is held
  /// while `row` runs, however slow it is.
  using RowCallback = std::function<bool(std::int64_t k, double t, std::span<const double> values)>;
  void rows(RunId run, const std::vector<int>& signals, std::int64_t from, std::int64_t to,
            const RowCallback& row) const;
  std::vector<GapRow> gaps(RunId run) const;
  MarkPage marks(RunId run, const MarkFilter& filter) const;
  std::vector<Command> commands(RunId run) const;
  std::vector<MetricValue> metrics(RunId run) const;
  std::vector<FaultCount> faults(RunId run) const;

  std::vector<ScenarioRow> scenarios() const;
  std::optional<ScenarioRow> scenario(const std::string& id) const;
  std::vector<TraceRow> traces() const;
  std::optional<TraceRow> trace(std::int64_t id) const;
  std::optional<std::string> trace_csv(std::int64_t id) const;
  std::vector<CampaignRow> campaigns() const;  ///< newest first
  std::optional<CampaignRow> campaign(std::int64_t id) const;
  /// In order of their index.
  std::vector<TrialRow> trials(std::int64_t campaign, TrialRange range = {}) const;
  /// Without results and accumulators: what each cell is.
  std::vector<CampaignCellRow> campaign_cells(std::int64_t campaign) const;
  /// Whole.
  std::optional<CampaignCellRow> campaign_cell(std::int64_t campaign, std::int64_t cell) const;
  /// A cell together with its trials of `range`, as one commit left them.
  std::optional<CampaignPart> campaign_part(std::int64_t campaign, std::int64_t cell, TrialRange range) const;
  /// Of the cells that are whole, from `first` on, in order.
  std::vector<SummaryRow> campaign_summaries(std::int64_t campaign, std::int64_t first = 0) const;
  /// Of the cells that have a trial, from `first` to `last`, in order.
  std::vector<ColumnsRow> campaign_columns(std::int64_t campaign, std::int64_t first, std::int64_t last) const;
  /// The numbers of trials in order of their index; the bytes are valid during the call.
  void each_trial(std::int64_t campaign, TrialRange range,
                  const std::function<void(std::int64_t index, std::string_view numbers)>& call) const;
  std::optional<DesignRow> design(const std::string& key) const;
  std::optional<std::string> design_problem(const std::string& key) const;  ///< the text that was stored with it
  Json setting(const std::string& key) const;                               ///< null: not set
  LogCounts counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vigil
