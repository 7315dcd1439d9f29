/// What was asked of a campaign, complete and checked: from the API, the command line, or the log.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "db/records.hpp"
#include "server/runs/campaign_runner.hpp"

namespace vigil {

inline constexpr std::size_t kMostCells = 10'000;
inline constexpr std::int64_t kMostTrials = 10'000'000;

struct CampaignRequest {
  Scenario scenario;
  std::vector<std::pair<std::string, std::vector<Json>>> sweep;
  std::int64_t runs = 1;  ///< of each cell
  std::uint64_t first_seed = 1;
  int threads = 0;       ///< 0: all cores
  bool workers = false;  ///< made by the broker's workers, not by threads of this process
  bool samples = false;  ///< every trial is kept as a run with its samples, too
  std::vector<std::string> tags;
  std::string note;
  std::optional<std::int64_t> trace;  ///< in the log

  /// As the log keeps it.
  Json to_json() const;
  /// Throws InputError where the document is not valid any more.
  static CampaignRequest from_json(const Json& json);
  /// What decides the results and where they go; two requests with the same text are the same campaign.
  std::string identity() const;
  std::size_t cells() const;
};

/// The plan of a request without its trace and designs. Throws InputError below /sweep.
CampaignPlan make_plan(const CampaignRequest& request);
/// What the log is told of a new campaign; designs are those of the plan's points.
NewCampaign new_campaign(const CampaignRequest& request, const CampaignPlan& plan);
int all_cores();

}  // namespace vigil
