#include "tests/engine/campaign/replay_tables.hpp"

namespace vigil::replay_tables {

Campaign::Campaign(const Scenario& scenario, int trials) : trials_(trials) {
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

const std::vector<double>& Campaign::values(const std::string& lane, const std::string& name) const {
  return values_.at({lane, name});
}

Estimate estimate_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, std::sqrt(squares / (n - 1) / n), static_cast<int>(values.size())};
}

Estimate estimate_of(const Campaign& campaign, const std::string& lane, const std::string& name) {
  const MetricSummary& row = campaign.row(lane, name);
  return {row.mean, std::isnan(row.se) ? 0 : row.se, campaign.trials()};
}

double allowed(const Estimate& ours, const Printed& theirs) {
  const double other = ours.error * std::sqrt(static_cast<double>(ours.trials) / theirs.trials);
  return 4 * std::hypot(ours.error, other) + theirs.half_digit + 1e-9;
}

bool agrees(const Estimate& ours, const Printed& theirs) {
  return std::abs(ours.mean - theirs.value) <= allowed(ours, theirs);
}

void expect_agrees(const Estimate& ours, const Printed& theirs, const std::string& what) {
  EXPECT_TRUE(agrees(ours, theirs)) << what << ": " << ours.mean << " +- " << ours.error << " of " << ours.trials
                                    << " runs, printed " << theirs.value << ", allowed " << allowed(ours, theirs);
}

std::vector<double> of_runs(const Scenario& scenario, int trials,
                            const std::function<double(const test::Told&)>& measure) {
  std::vector<double> values;
  for (int i = 1; i <= trials; ++i)
    values.push_back(measure(test::Told(scenario, {static_cast<std::uint64_t>(i), nullptr, {}})));
  return values;
}

double mean_over(const test::Told& told, const std::string& lane, const std::string& what, int from, int to) {
  const auto id = static_cast<std::size_t>(told.run.catalogue().find("lane." + lane + ".1." + what));
  double sum = 0;
  for (int k = from; k <= to; ++k) {
    const double value = told.capture.frames[static_cast<std::size_t>(k)].values[id];
    sum += std::isnan(value) ? 0 : value;
  }
  return sum / (to - from + 1);
}

}  // namespace vigil::replay_tables
