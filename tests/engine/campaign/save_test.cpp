/// A table that is saved in the middle and taken up again is the table that went on; pairs and quantiles.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/metrics/paired_law.hpp"
#include "engine/run/campaign.hpp"
#include "tests/engine/campaign/everything.hpp"

namespace vigil::save_test {
namespace {

TrialResult with_values(const std::vector<std::tuple<std::string, std::string, double>>& values) {
  TrialResult trial;
  for (const auto& [lane, name, value] : values) trial.metrics.push_back({lane, "", name, "", value, false});
  return trial;
}

class Saved : public testing::TestWithParam<const char*> {};

// Bounds (consensus), pooled ratios (privacy), counts of detectors (replay).
TEST_P(Saved, ATableTakenUpAgainIsTheTableThatWentOn) {
  const Scenario scenario = Scenario::preset(GetParam()).with("time.steps", 25);
  CampaignTable whole;
  CampaignTable begun;
  TrialColumns columns;
  std::vector<std::string> rows;
  std::string state;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const TrialResult trial = run_trial(scenario, seed);
    whole.add(trial);
    if (seed > 4) continue;
    begun.add(trial);
    rows.push_back(columns.encode(trial));
    state = begun.save();
  }
  const TrialColumns read = TrialColumns::from_json(Json::parse(columns.to_json().dump()));
  CampaignTable resumed;
  for (const std::string& row : rows) resumed.add(read.decode(row));
  resumed.load(state);
  EXPECT_EQ(everything(begun), everything(resumed));
  for (std::uint64_t seed = 5; seed <= 6; ++seed) resumed.add(run_trial(scenario, seed));
  EXPECT_EQ(everything(whole), everything(resumed));
  EXPECT_EQ(whole.save(), resumed.save());
}

INSTANTIATE_TEST_SUITE_P(Presets, Saved, testing::Values("consensus", "privacy-turn", "replay-nongaussian", "sparse"),
                         [](const auto& preset) {
                           std::string name = preset.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Columns, GrowWithTheTrialsAndTellMissingFromNotANumber) {
  TrialColumns columns;
  const std::string first = columns.encode(with_values({{"a", "x", 1.5}}));
  const std::string second = columns.encode(with_values({{"b", "y", -0.0}, {"a", "x", std::nan("")}}));
  const std::string third = columns.encode(with_values({{"b", "y", INFINITY}}));
  EXPECT_EQ(columns.size(), 2u);
  EXPECT_EQ(first.size(), 8u);
  EXPECT_EQ(columns.decode(first).metrics.size(), 1u);
  const TrialResult both = columns.decode(second);
  ASSERT_EQ(both.metrics.size(), 2u);
  EXPECT_TRUE(std::isnan(both.metrics[0].value));
  EXPECT_TRUE(std::signbit(both.metrics[1].value));
  const TrialResult one = columns.decode(third);
  ASSERT_EQ(one.metrics.size(), 1u) << "the trial had no x";
  EXPECT_EQ(one.metrics[0].lane, "b");
  EXPECT_TRUE(std::isinf(one.metrics[0].value));
  const int y = columns.find({"b", "", "y", "", 0, false});
  EXPECT_EQ(TrialColumns::value(third, y), INFINITY);
  EXPECT_TRUE(std::isnan(TrialColumns::value(first, y)));
  EXPECT_EQ(columns.find({"b", "", "x", "", 0, false}), -1);
  EXPECT_THROW(columns.decode(std::string(24, 'x')), std::runtime_error);
  EXPECT_THROW(columns.decode("abc"), std::runtime_error);
}

TEST(SavedBytes, DamagedAccumulatorsAreRefused) {
  CampaignTable table;
  table.add(run_trial(Scenario::preset("consensus").with("time.steps", 3), 1));
  const std::string good = table.save();
  for (const std::size_t size : {std::size_t{1}, std::size_t{9}, good.size() / 2, good.size() - 1}) {
    CampaignTable other;
    EXPECT_THROW(other.load(good.substr(0, size)), std::runtime_error) << size;
  }
  CampaignTable other;
  EXPECT_THROW(other.load(good + "x"), std::runtime_error);
}

TEST(Statistics, QuantilesAreLinearBetweenOrderStatistics) {
  CampaignTable table;
  for (const double v : {50.0, 10.0, 40.0, 20.0, 30.0}) table.add(with_values({{"a", "value", v}}));
  const MetricSummary row = table.summary().front();
  EXPECT_DOUBLE_EQ(row.q05, 12);
  EXPECT_DOUBLE_EQ(row.q25, 20);
  EXPECT_DOUBLE_EQ(row.median, 30);
  EXPECT_DOUBLE_EQ(row.q75, 40);
  EXPECT_DOUBLE_EQ(row.q95, 48);
}

// Only trials that have both count, whatever order the lanes come in.
TEST(Statistics, LanesArePairedTrialByTrial) {
  CampaignTable table;
  table.add(with_values({{"a", "x", 1}, {"b", "x", 2}, {"c", "y", 0}}));
  table.add(with_values({{"b", "x", 7}}));
  table.add(with_values({{"a", "x", 4}, {"b", "x", 8}}));
  table.add(with_values({{"a", "x", std::nan("")}, {"b", "x", 8}}));
  table.add(with_values({{"b", "x", 12}, {"a", "x", 6}}));
  const auto pairs = table.paired();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].base, "a");
  EXPECT_EQ(pairs[0].key.lane, "b");
  const PairedDifference& d = pairs[0].difference;  // 1, 4, 6
  EXPECT_EQ(d.n, 3);
  EXPECT_NEAR(d.mean, 11.0 / 3, 1e-14);
  const double se = std::sqrt((53 - 121.0 / 3) / 2 / 3);
  EXPECT_NEAR(d.se, se, 1e-14);
  EXPECT_NEAR(d.hi, 11.0 / 3 + student_quantile(0.975, 2) * se, 1e-12);
}

}  // namespace
}  // namespace vigil::save_test
