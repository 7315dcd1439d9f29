/// Many runs on many threads, merged in trial order: the result does not depend on how many threads there were.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/run/campaign.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil {

/// One point of the grid: what it sets ({} without a sweep) and the scenario that comes of it.
struct CampaignPoint {
  Json sweep = Json::object();
  Scenario scenario;
  Json designs = Json::object();  ///< {"<lane>":record} for every task of the scenario
};

struct CampaignPlan {
  std::vector<CampaignPoint> points;
  std::int64_t runs = 1;  ///< of each point
  std::uint64_t first_seed = 1;
  int threads = 1;
  std::shared_ptr<const Trace> trace;

  std::int64_t trials() const { return runs * static_cast<std::int64_t>(points.size()); }
};

/// Faults of one kind over all trials of a point. count is their sum; first and last the extremes.
struct CampaignFault {
  FaultCount fault;
  std::int64_t runs = 0;  ///< trials that had it
};

struct CampaignOutcome {
  Json sweep;
  std::vector<MetricSummary> metrics;
  std::vector<CampaignFault> faults;
  std::vector<std::string> warnings;  ///< each once
  Json design;                        ///< of the first trial
  std::int64_t ticks = 0;
};

/// All points of a grid: the product of the values. Throws InputError where one of them is not valid.
std::vector<CampaignPoint> make_grid(const Scenario& base,
                                     const std::vector<std::pair<std::string, std::vector<Json>>>& sweeps);

/// `each` is called in trial order, on the calling thread. Ends early (with what is merged) when `stop` becomes true.
/// Throws what a trial threw: InputError.
std::vector<CampaignOutcome> run_campaign(const CampaignPlan& plan, const std::atomic<bool>& stop,
                                          const std::function<void(std::int64_t index, const TrialResult&)>& each);

/// The metrics of every point, each with its "sweep".
Json campaign_metrics_json(const std::vector<CampaignOutcome>& outcomes);
Json campaign_faults_json(const std::vector<CampaignOutcome>& outcomes);
/// {"sweep":design} of a sweep's points, or the design itself where there is one point.
Json campaign_design_json(const std::vector<CampaignOutcome>& outcomes);
Json campaign_warnings_json(const std::vector<CampaignOutcome>& outcomes);

}  // namespace vigil
