/// The tables of section 12 of the specification and what it takes to compare a campaign with them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "engine/run/campaign.hpp"

namespace vigil::section12 {

/// VIGIL_FULL set: the whole tables; else reduced statistics, with the bounds that belong to them.
inline bool full() { return std::getenv("VIGIL_FULL") != nullptr; }
inline int runs(int quick, int whole) { return full() ? whole : quick; }

struct Figure {
  double value = 0, error = 0;
};

/// Summaries of one campaign by lane, name, node and variant.
class Results {
 public:
  Results(const Scenario& scenario, int trials, std::uint64_t first_seed = 1) {
    CampaignTable table;
    for (int i = 0; i < trials; ++i) {
      const TrialResult trial = run_trial(scenario, first_seed + static_cast<std::uint64_t>(i));
      for (const FaultCount& fault : trial.faults) stopped_ += fault.stopped ? 1 : 0;
      table.add(trial);
    }
    for (const MetricSummary& row : table.summary())
      rows_[row.key.lane + " " + row.key.name + " " + row.key.node + " " + row.key.variant] = row;
  }

  const MetricSummary& row(const std::string& lane, const std::string& name, const std::string& node = "",
                           const std::string& variant = "") const {
    return rows_.at(lane + " " + name + " " + node + " " + variant);
  }
  double mean(const std::string& lane, const std::string& name = "rmse_position", const std::string& node = "") const {
    return row(lane, name, node).mean;
  }
  double error(const std::string& lane, const std::string& name = "rmse_position", const std::string& node = "") const {
    return row(lane, name, node).se;
  }
  int stopped() const { return stopped_; }  ///< faults that stopped a lane

 private:
  std::map<std::string, MetricSummary> rows_;
  int stopped_ = 0;
};

/// Within four combined standard errors; a figure printed without one has the error of the runs it was made from.
inline void expect_agrees(const MetricSummary& row, const Figure& expected, const std::string& what) {
  const double combined = std::hypot(row.se, expected.error);
  EXPECT_LE(std::abs(row.mean - expected.value), 4 * combined)
      << what << ": " << row.mean << " +- " << row.se << ", expected " << expected.value;
}

/// A scenario with some lanes only: a lane's draws do not depend on the others.
inline Scenario only(const Scenario& scenario, const std::vector<std::string>& lanes) {
  Json patch = {{"lanes", Json::object()}};
  for (const auto& [id, lane] : scenario.document()["lanes"].items()) {
    if (std::find(lanes.begin(), lanes.end(), id) == lanes.end()) patch["lanes"][id] = nullptr;
  }
  return scenario.patched(patch);
}

}  // namespace vigil::section12
