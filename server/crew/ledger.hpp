/// What of a campaign is handed out, what has come back, what comes next. Knows no broker and no clock.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/crew/job.hpp"

namespace vigil {

class TrialLedger {
 public:
  static constexpr double kJobSeconds = 0.25;          ///< that a job should take, so that handing out costs little
  static constexpr std::int64_t kJobsAhead = 24;       ///< of the merge, for each thread that works
  static constexpr std::int64_t kJobsAheadHeavy = 4;   ///< the same where much waits to be merged
  static constexpr std::size_t kHeavy = 64ULL << 20U;  ///< bytes

  /// Trials first .. trials - 1 are to be made; runs: of each point.
  TrialLedger(std::int64_t first, std::int64_t trials, std::int64_t runs)
      : trials_(trials), runs_(runs), merged_(first), next_(first) {}

  /// The next job to publish for `threads` threads; empty: enough is under way. Ranges grow until they take
  /// kJobSeconds, and shrink again towards the end, so that all end together. Where they are long enough they end with
  /// a block of trials (kTrialBlock).
  std::optional<TrialJob> next(int threads);
  /// Each trial counts once, whoever made it and however often; a job counts as a whole or not at all. Throws
  /// std::runtime_error with the reason where the job ended with an error.
  void put(JobResult result);
  /// The next trial's bytes in order; empty: not there yet.
  std::optional<std::pair<std::int64_t, std::string>> take();

  /// Everything that is under way is published again.
  void again();
  /// The broker has handed the job out as often as it does. Of several trials each is tried alone; true where it was
  /// one, and is given up: the caller puts what stands for its result.
  bool exhausted(const TrialJob& job);
  bool done() const { return merged_ == trials_; }
  /// Published, without a result yet.
  std::size_t under_way() const { return under_way_.size(); }
  std::int64_t merged() const { return merged_; }

 private:
  std::int64_t size(int threads) const;
  bool missing(std::int64_t index) const { return index >= merged_ && !results_.contains(index); }
  bool missing(const TrialJob& job) const;  ///< any of it
  /// Whether exactly these trials are under way. A worker may still bring a job of the same campaign's last process: it
  /// overlaps ours, and what it covers in part would be missing for ever.
  bool asked(const TrialJob& job) const;
  TrialJob publish(TrialJob job);

  std::int64_t trials_, runs_, merged_, next_;
  double seconds_ = 0;  ///< of one trial, lately; 0: not known
  std::size_t bytes_ = 0;
  std::map<std::int64_t, std::string> results_;
  std::map<std::int64_t, TrialJob> under_way_;  ///< by first trial
  std::vector<TrialJob> again_;                 ///< to be published before anything new
};

}  // namespace vigil
