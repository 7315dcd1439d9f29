/// Many runs on many threads, merged in trial order: the result does not depend on how many threads there were.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
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
  std::optional<std::int64_t> trace_id;  ///< in the log
  std::int64_t first = 0;                ///< trials before this one are there already
  int nice = 0;                          ///< of the workers' threads
  /// Makes the trial of an index, on a worker's thread; empty: run_trial(). May throw TrialGivenUp.
  std::function<TrialResult(std::int64_t index)> trial;

  std::int64_t trials() const { return runs * static_cast<std::int64_t>(points.size()); }
  std::uint64_t seed_of(std::int64_t index) const { return first_seed + static_cast<std::uint64_t>(index % runs); }
};

/// Thrown out of a trial that nobody waits for any more.
struct TrialGivenUp {};

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

/// One point of a campaign as it grows, trial by trial in their order.
class CampaignCell {
 public:
  void add(const TrialResult& trial);
  std::int64_t trials() const { return table_.trials(); }
  std::vector<MetricSummary> summary() const { return table_.summary(); }
  /// {"trials":{"finished","stopped","failed"},"ticks","metrics","paired","detection","faults","warnings","design"}
  Json result() const;
  CampaignOutcome outcome(Json sweep) const;
  const Json& design() const { return sums_.design; }
  void set_design(Json design) { sums_.design = std::move(design); }
  std::string save() const { return table_.save(); }
  void load(std::string_view bytes) { table_.load(bytes); }

 private:
  CampaignTable table_;
  CampaignOutcome sums_;
  std::int64_t finished_ = 0, stopped_ = 0, failed_ = 0;
};

/// "finished", "stopped" (a fault stopped a lane) or "failed" (there is no result).
const char* trial_state(const TrialResult& trial);

/// What is kept of a trial whose scenario could not be run.
TrialResult failed_trial(const CampaignPlan& plan, std::int64_t index, const std::string& error);

/// A trial without samples; one whose scenario cannot be run is failed_trial(). Throws TrialGivenUp when `stop` becomes
/// true.
TrialResult plain_trial(const CampaignPlan& plan, std::int64_t index, const std::atomic<bool>& stop);

/// All points of a grid: the product of the values. Throws InputError where one of them is not valid.
std::vector<CampaignPoint> make_grid(const Scenario& base,
                                     const std::vector<std::pair<std::string, std::vector<Json>>>& sweeps);

/// `each` is called in trial order, on the calling thread. Ends early (with what is merged) when `stop` becomes true.
/// Throws what a trial threw: InputError.
std::vector<CampaignOutcome> run_campaign(const CampaignPlan& plan, const std::atomic<bool>& stop,
                                          const std::function<void(std::int64_t index, const TrialResult&)>& each);

}  // namespace vigil
