/// Many runs: trial i is the run with seed first + i. The caller brings threads; results do not depend on them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/run/run.hpp"

namespace vigil {

/// What one finished trial leaves behind: its metrics and whatever its metrics' own accumulators need.
class TrialResult {
 public:
  TrialResult();
  TrialResult(TrialResult&&) noexcept;
  TrialResult& operator=(TrialResult&&) noexcept;
  ~TrialResult();

  std::uint64_t seed = 0;
  std::vector<MetricValue> metrics;
  std::vector<FaultCount> faults;
  std::vector<std::string> warnings;
  Json design;
  std::int64_t ticks = 0;
  struct Extra;
  std::unique_ptr<Extra> extra;
};

/// Runs one trial to its end. Throws InputError (the scenario), nothing else of its own. Safe to call from many threads
/// at once. designs: as RunOptions has them.
TrialResult run_trial(const Scenario& scenario, std::uint64_t seed, std::shared_ptr<const Trace> trace = nullptr,
                      const Json& designs = Json::object());

struct MetricSummary {
  MetricValue key;  ///< lane, node, name, variant; value unused
  double mean = 0;  ///< pooled root of the mean square for rmse_… and rms_…
  double se = 0;    ///< standard error (delta method for pooled roots); NaN with fewer than two
  double median = 0, min = 0, max = 0;
  std::int64_t n = 0;  ///< trials with a value
};

Json to_json(const MetricSummary& summary);

/// Merges trials in the order they are added: add them by seed, whatever order they finished in.
class CampaignTable {
 public:
  CampaignTable();
  ~CampaignTable();
  void add(const TrialResult& trial);
  std::vector<MetricSummary> summary() const;
  std::int64_t trials() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vigil
