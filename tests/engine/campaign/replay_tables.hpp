/// The tables of the specification (replay) and what it takes to compare campaigns with them.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/engine/campaign/section12.hpp"
#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::replay_tables {

using section12::full;
using section12::runs;
using test::kReplayPresets;
using test::replay_scenario;

inline constexpr int kTheirRuns = 200;  ///< of the reference implementation, where the specification says nothing else

/// Summaries of `trials` runs, seeds from 1 on, by lane and name; those of one component are left out.
class Campaign {
 public:
  Campaign(const Scenario& scenario, int trials);
  const MetricSummary& row(const std::string& lane, const std::string& name) const { return rows_.at({lane, name}); }
  bool has(const std::string& lane, const std::string& name) const { return rows_.contains({lane, name}); }
  double mean(const std::string& lane, const std::string& name) const { return row(lane, name).mean; }
  /// Run by run, where each had a value.
  const std::vector<double>& values(const std::string& lane, const std::string& name) const;
  int trials() const { return trials_; }

 private:
  std::map<std::pair<std::string, std::string>, MetricSummary> rows_;
  std::map<std::pair<std::string, std::string>, std::vector<double>> values_;
  int trials_;
};

/// A mean with its standard error, of so many runs.
struct Estimate {
  double mean = 0, error = 0;
  int trials = 0;
};

Estimate estimate_of(const std::vector<double>& values);

Estimate estimate_of(const Campaign& campaign, const std::string& lane, const std::string& name);

/// A figure of a table: printed to half a unit of its last digit, from so many runs.
struct Printed {
  double value = 0, half_digit = 0.0005;
  int trials = kTheirRuns;
};

/// Four combined standard errors (their runs scatter as ours do) and what printing cut off.
double allowed(const Estimate& ours, const Printed& theirs);

bool agrees(const Estimate& ours, const Printed& theirs);

void expect_agrees(const Estimate& ours, const Printed& theirs, const std::string& what);

/// What `measure` makes of each of so many runs.
std::vector<double> of_runs(const Scenario& scenario, int trials,
                            const std::function<double(const test::Told&)>& measure);

/// Mean over ticks of a lane's signal.
double mean_over(const test::Told& told, const std::string& lane, const std::string& what, int from, int to);

}  // namespace vigil::replay_tables
