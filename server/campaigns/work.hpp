/// The trials of one campaign, made by its crew, merged in order, committed in batches: what is committed is always the
/// first so many trials together with what was merged of exactly these.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <mutex>

#include "db/reader.hpp"
#include "db/writer.hpp"
#include "server/campaigns/request.hpp"
#include "server/crew/crew.hpp"

namespace vigil {

class CampaignWork {
 public:
  using Each = std::function<void(std::int64_t done, const TrialResult& trial)>;

  /// plan: with every cell's designs, and the trace. samples: every trial is kept as a run, too. The
  /// log outlives the work. Throws std::runtime_error where what was committed is damaged.
  CampaignWork(LogWriter& log, const LogReader& reader, std::int64_t id, CampaignPlan plan, bool samples);

  std::int64_t done() const { return plan_.first; }  ///< trials that were committed before
  /// Runs what is not committed; true where all of it is then. `each` is called on the calling thread, in trial order.
  /// Ends early when `stop` becomes true. Throws LogError (disk) where the log cannot take it, and what the crew
  /// throws.
  bool run(Crew& crew, const std::atomic<bool>& stop, const Each& each);

 private:
  using Clock = std::chrono::steady_clock;
  TrialResult make_trial(std::int64_t index, const std::atomic<bool>& stop);
  TrialResult kept_trial(const CampaignPoint& point, std::int64_t index, const std::atomic<bool>& stop);
  void take(std::int64_t index, const TrialResult& trial);
  TrialRow row_of(std::int64_t index, const TrialResult& trial);
  void close_cell(std::int64_t cell);
  void commit();
  void settle();

  LogWriter& log_;
  const std::int64_t id_;
  const bool samples_;
  CampaignPlan plan_;
  CampaignCell cell_;
  TrialColumns columns_;
  CampaignBatch batch_;
  std::future<void> committing_;
  Clock::time_point committed_{};
  std::mutex mutex_;
  std::map<std::int64_t, RunId> runs_;  ///< that keep samples, by trial, until their row is made
};

/// Cell `cell` as the log has it: its result, or what can be said so far; null where it has no trial yet.
Json cell_result(const LogReader& reader, std::int64_t campaign, std::int64_t cell, std::int64_t runs);
/// A trial with its metrics and faults out of its row.
TrialResult trial_of(const TrialRow& row, const TrialColumns& columns);

}  // namespace vigil
