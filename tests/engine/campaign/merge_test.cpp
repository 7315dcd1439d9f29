/// The merge of many trials: its order, its statistics.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <thread>

#include "engine/metrics/bound_ratio.hpp"
#include "engine/run/campaign.hpp"

namespace vigil::merge_test {
namespace {

std::string merged(const std::vector<TrialResult>& trials) {
  CampaignTable table;
  for (const TrialResult& trial : trials) table.add(trial);
  Json summary = Json::array();
  for (const MetricSummary& row : table.summary()) summary.push_back(to_json(row));
  return summary.dump();
}

std::vector<TrialResult> on_threads(const Scenario& scenario, int trials, int threads) {
  std::vector<TrialResult> results(static_cast<std::size_t>(trials));
  std::vector<std::thread> pool;
  for (int t = 0; t < threads; ++t) {
    pool.emplace_back([&, t] {
      for (int i = t; i < trials; i += threads)
        results[static_cast<std::size_t>(i)] = run_trial(scenario, static_cast<std::uint64_t>(1 + i));
    });
  }
  for (std::thread& thread : pool) thread.join();
  return results;
}

TEST(Campaign, DoesNotDependOnThreads) {
  for (const char* preset : {"consensus", "consensus-compass"}) {
    const Scenario scenario = Scenario::preset(preset);
    const std::string one = merged(on_threads(scenario, 12, 1));
    EXPECT_EQ(one, merged(on_threads(scenario, 12, 2))) << preset;
    EXPECT_EQ(one, merged(on_threads(scenario, 12, 5))) << preset;
  }
}

TEST(Campaign, ATrialIsTheRunOfItsSeed) {
  const Scenario scenario = Scenario::preset("consensus");
  const TrialResult trial = run_trial(scenario, 42);
  struct Nowhere final : Sink {
    void frame(const Frame& /*frame*/) override {}
    void mark(const Mark& /*mark*/) override {}
  } sink;
  vigil::Run run(scenario, {42, nullptr, {}});
  while (!run.done()) run.step(sink);
  const auto metrics = run.metrics();
  ASSERT_EQ(trial.metrics.size(), metrics.size());
  for (std::size_t i = 0; i < metrics.size(); ++i) EXPECT_EQ(to_json(trial.metrics[i]), to_json(metrics[i]));
  EXPECT_EQ(trial.ticks, 30);
  EXPECT_EQ(trial.seed, 42U);
}

TrialResult with_values(const std::vector<std::pair<std::string, double>>& values) {
  TrialResult trial;
  for (const auto& [name, value] : values) trial.metrics.push_back({"lane", "", name, "", value, false});
  return trial;
}

// Pooled roots: sqrt(mean of squares), and by the delta method se = se(mean of squares) / (2 root). All else: plain
// means.
TEST(Campaign, PoolsRootsAndAveragesTheRest) {
  const std::vector<double> values{1.5, 2.5, 0.5, 4, 3};
  CampaignTable table;
  for (const double v : values)
    table.add(with_values({{"rmse_position", v}, {"rms_error", v}, {"nees_mean", v}, {"armse", v}}));
  double mean = 0, mean_square = 0;
  for (const double v : values) {
    mean += v / 5;
    mean_square += v * v / 5;
  }
  double variance = 0, variance_square = 0;
  for (const double v : values) {
    variance += (v - mean) * (v - mean) / 4;
    variance_square += (v * v - mean_square) * (v * v - mean_square) / 4;
  }
  std::map<std::string, MetricSummary> rows;
  for (const MetricSummary& row : table.summary()) rows[row.key.name] = row;
  for (const char* name : {"rmse_position", "rms_error"}) {
    EXPECT_NEAR(rows[name].mean, std::sqrt(mean_square), 1e-14);
    EXPECT_NEAR(rows[name].se, std::sqrt(variance_square / 5) / (2 * std::sqrt(mean_square)), 1e-14);
  }
  for (const char* name : {"nees_mean", "armse"}) {
    EXPECT_NEAR(rows[name].mean, mean, 1e-14);
    EXPECT_NEAR(rows[name].se, std::sqrt(variance / 5), 1e-14);
  }
  EXPECT_EQ(rows["rmse_position"].median, 2.5);
  EXPECT_EQ(rows["rmse_position"].min, 0.5);
  EXPECT_EQ(rows["rmse_position"].max, 4);
  EXPECT_EQ(rows["rmse_position"].n, 5);
  EXPECT_EQ(table.trials(), 5);
}

TEST(Campaign, CountsOnlyTrialsThatHaveAValue) {
  CampaignTable table;
  table.add(with_values({{"first_infeasible_step", std::nan("")}, {"never", std::nan("")}}));
  table.add(with_values({{"first_infeasible_step", 2}, {"never", std::nan("")}}));
  const auto rows = table.summary();
  EXPECT_EQ(rows[0].n, 1);
  EXPECT_EQ(rows[0].mean, 2);
  EXPECT_TRUE(std::isnan(rows[0].se)) << "one value has no standard error";
  const Json json = to_json(rows[1]);
  EXPECT_EQ(json["n"], 0);
  for (const char* field : {"mean", "se", "median", "min", "max"}) EXPECT_TRUE(json[field].is_null()) << field;
  EXPECT_TRUE(json["node"].is_null());
}

TEST(Campaign, MedianOfAnEvenNumber) {
  CampaignTable table;
  for (const double v : {4.0, 1.0, 3.0, 10.0}) table.add(with_values({{"value", v}}));
  EXPECT_EQ(table.summary()[0].median, 3.5);
}

TEST(Campaign, RefusesAnEndlessTrial) {
  try {
    run_trial(Scenario::preset("consensus").patched({{"time", {{"steps", nullptr}}}}), 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().pointer, "/time/steps");
  }
}

TEST(BoundRatio, IsTheLargestGeneralisedEigenvalue) {
  BoundRatio ratio;
  // Two cells of two states; errors along known directions.
  BoundRecord first{"lane", 2, {2, 0, 1, 1}, {4, 0, 0, 1, 2, 0, 0, 2}};
  BoundRecord second{"lane", 2, {0, 1, 1, -1}, {4, 0, 0, 1, 2, 0, 0, 2}};
  ratio.add(first);
  EXPECT_NEAR(ratio.max(), 1, 1e-12);  // cell 1: 4/4; cell 2: (1,1)(1,1)'/2 has the eigenvalue 1
  ratio.add(second);
  EXPECT_NEAR(ratio.max(), 0.5, 1e-12);  // halves of both
  BoundRecord wild{"lane", 2, {6, 0, 0, 0}, {4, 0, 0, 1, 2, 0, 0, 2}};
  ratio.add(wild);
  EXPECT_NEAR(ratio.max(), (4 + 36) / 3.0 / 4, 1e-12);
}

TEST(BoundRatio, NeverPassesWhatIsNotPositiveDefinite) {
  BoundRatio ratio;
  ratio.add({"lane", 2, {0.1, 0}, {1, 0, 0, -1}});
  EXPECT_TRUE(std::isinf(ratio.max()));
  BoundRatio none;
  EXPECT_TRUE(std::isnan(none.max()));
  BoundRatio missing;  // no truth, no figure
  missing.add({"lane", 2, {std::nan(""), 0}, {1, 0, 0, 1}});
  EXPECT_TRUE(std::isnan(missing.max()));
}

// A run that ended early counts where it got to.
TEST(BoundRatio, TakesRunsOfDifferentLengths) {
  BoundRatio ratio;
  ratio.add({"lane", 1, {1, 3}, {1, 9}});
  ratio.add({"lane", 1, {2}, {1}});
  EXPECT_NEAR(ratio.max(), 2.5, 1e-12);
}

}  // namespace
}  // namespace vigil::merge_test
