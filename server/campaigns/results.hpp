/// What a campaign's results are now, read from its log: whole cells as they were kept, the one that is under way
/// merged as far as its trials go.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <mutex>
#include <optional>

#include "db/reader.hpp"
#include "server/runs/campaign_runner.hpp"

namespace vigil {

/// Safe from any thread. Remembers what it merged: asking again costs only the trials that have come since.
class CampaignResults {
 public:
  /// The reader outlives it.
  explicit CampaignResults(const LogReader& reader) : reader_(reader) {}

  /// A cell's whole result (CampaignCell::result()); null before its first trial.
  Json result(const CampaignRow& campaign, std::int64_t cell);
  /// Of the cells from `first` on that have a trial, in order.
  std::vector<SummaryRow> summaries(const CampaignRow& campaign, std::int64_t first = 0);

 private:
  /// A cell whose trials are not all there yet.
  struct Part {
    std::int64_t campaign = 0, cell = 0;
    std::int64_t next = 0;  ///< index of the first trial that is not merged
    CampaignCell merged;
    std::map<std::string, std::int64_t> states;
    std::optional<CellSummary> summary;  ///< of exactly these trials
    Json result;
  };
  Part& part(std::int64_t campaign, std::int64_t cell, std::int64_t runs);
  bool catch_up(Part& part, std::int64_t runs);
  static CellSummary summary_of(const Part& part);

  const LogReader& reader_;
  std::mutex mutex_;
  std::list<Part> parts_;  ///< asked for last first
};

}  // namespace vigil
