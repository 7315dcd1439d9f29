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
  Campaign(const Scenario& scenario, int trials) : trials_(trials) {
    CampaignTable table;
    for (int i = 1; i <= trials; ++i) {
      const TrialResult trial = run_trial(scenario, static_cast<std::uint64_t>(i));
      table.add(trial);
      for (const MetricValue& m : trial.metrics) {
        if (m.variant.empty()) values_[{m.lane, m.name}].push_back(m.value);
      }
    }
    for (const MetricSummary& row : table.summary()) {
      if (row.key.variant.empty()) rows_[{row.key.lane, row.key.name}] = row;
    }
  }
  const MetricSummary& row(const std::string& lane, const std::string& name) const { return rows_.at({lane, name}); }
  bool has(const std::string& lane, const std::string& name) const { return rows_.contains({lane, name}); }
  double mean(const std::string& lane, const std::string& name) const { return row(lane, name).mean; }
  /// Run by run, where each had a value.
  const std::vector<double>& values(const std::string& lane, const std::string& name) const {
    return values_.at({lane, name});
  }
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

inline Estimate estimate_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, std::sqrt(squares / (n - 1) / n), static_cast<int>(values.size())};
}

inline Estimate estimate_of(const Campaign& campaign, const std::string& lane, const std::string& name) {
  const MetricSummary& row = campaign.row(lane, name);
  return {row.mean, std::isnan(row.se) ? 0 : row.se, campaign.trials()};
}

/// A figure of a table: printed to half a unit of its last digit, from so many runs.
struct Printed {
  double value = 0, half_digit = 0.0005;
  int trials = kTheirRuns;
};

/// Four combined standard errors (their runs scatter as ours do) and what printing cut off.
inline double allowed(const Estimate& ours, const Printed& theirs) {
  const double other = ours.error * std::sqrt(static_cast<double>(ours.trials) / theirs.trials);
  return 4 * std::hypot(ours.error, other) + theirs.half_digit + 1e-9;
}

inline bool agrees(const Estimate& ours, const Printed& theirs) {
  return std::abs(ours.mean - theirs.value) <= allowed(ours, theirs);
}

inline void expect_agrees(const Estimate& ours, const Printed& theirs, const std::string& what) {
  EXPECT_TRUE(agrees(ours, theirs)) << what << ": " << ours.mean << " +- " << ours.error << " of " << ours.trials
                                    << " runs, printed " << theirs.value << ", allowed " << allowed(ours, theirs);
}

/// What `measure` makes of each of so many runs.
inline std::vector<double> of_runs(const Scenario& scenario, int trials,
                                   const std::function<double(const test::Told&)>& measure) {
  std::vector<double> values;
  for (int i = 1; i <= trials; ++i)
    values.push_back(measure(test::Told(scenario, {static_cast<std::uint64_t>(i), nullptr, {}})));
  return values;
}

/// Mean over ticks of a lane's signal.
inline double mean_over(const test::Told& told, const std::string& lane, const std::string& what, int from, int to) {
  const auto id = static_cast<std::size_t>(told.run.catalogue().find("lane." + lane + ".1." + what));
  double sum = 0;
  for (int k = from; k <= to; ++k) {
    const double value = told.capture.frames[static_cast<std::size_t>(k)].values[id];
    sum += std::isnan(value) ? 0 : value;
  }
  return sum / (to - from + 1);
}

}  // namespace vigil::replay_tables
