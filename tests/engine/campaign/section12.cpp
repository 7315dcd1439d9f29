#include "tests/engine/campaign/section12.hpp"

namespace vigil::section12 {

Results::Results(const Scenario& scenario, int trials, std::uint64_t first_seed) {
  CampaignTable table;
  for (int i = 0; i < trials; ++i) {
    const TrialResult trial = run_trial(scenario, first_seed + static_cast<std::uint64_t>(i));
    for (const FaultCount& fault : trial.faults) stopped_ += fault.stopped ? 1 : 0;
    table.add(trial);
  }
  for (const MetricSummary& row : table.summary())
    rows_[row.key.lane + " " + row.key.name + " " + row.key.node + " " + row.key.variant] = row;
}

const MetricSummary& Results::row(const std::string& lane, const std::string& name, const std::string& node,
                                  const std::string& variant) const {
  return rows_.at(lane + " " + name + " " + node + " " + variant);
}

double Results::mean(const std::string& lane, const std::string& name, const std::string& node) const {
  return row(lane, name, node).mean;
}

double Results::error(const std::string& lane, const std::string& name, const std::string& node) const {
  return row(lane, name, node).se;
}

void expect_agrees(const MetricSummary& row, const Figure& expected, const std::string& what) {
  const double combined = std::hypot(row.se, expected.error);
  EXPECT_LE(std::abs(row.mean - expected.value), 4 * combined)
      << what << ": " << row.mean << " +- " << row.se << ", expected " << expected.value;
}

Scenario only(const Scenario& scenario, const std::vector<std::string>& lanes) {
  Json patch = {{"lanes", Json::object()}};
  for (const auto& [id, lane] : scenario.document()["lanes"].items()) {
    if (std::find(lanes.begin(), lanes.end(), id) == lanes.end()) patch["lanes"][id] = nullptr;
  }
  return scenario.patched(patch);
}

}  // namespace vigil::section12
