/// Detection curves: counted by hand, merged exactly, and through the detector's own point.
#include "engine/metrics/roc.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/run/campaign.hpp"

namespace vigil::roc_test {
namespace {

std::string bytes(const RocCounts& counts) {
  ByteWriter out;
  counts.save(out);
  return out.take();
}

/// The rates at the largest edge that is not above `at`.
RocPoint rates_at(const RocCurve& curve, double at) {
  RocPoint found;
  for (const RocPoint& point : curve.points) {
    if (point.at >= at * (1 - 1e-12)) found = point;
  }
  return found;
}

TEST(Roc, RatesByHand) {
  RocCounts counts;
  for (const double value : {0.5, 1.5, 3.0, 6.0}) counts.note(true, value, 2, value > 2);
  for (const double value : {0.0, 0.4, 1.4, 2.9}) counts.note(false, value, 2, value > 2);
  const RocCurve curve = counts.by_threshold();
  EXPECT_TRUE(std::isinf(curve.points.front().at));
  EXPECT_EQ(curve.points.front().tpr, 0);
  EXPECT_EQ(curve.points.back().at, 0);
  EXPECT_EQ(curve.points.back().fpr, 1);
  EXPECT_EQ(curve.points.back().tpr, 1);
  EXPECT_DOUBLE_EQ(rates_at(curve, 2).tpr, 0.5);
  EXPECT_DOUBLE_EQ(rates_at(curve, 2).fpr, 0.25);
  EXPECT_DOUBLE_EQ(rates_at(counts.by_factor(), 1).tpr, 0.5);
  // Pairs (attacked, clean) with the attacked one larger: 2 + 3 + 4 + 4 of 16.
  EXPECT_DOUBLE_EQ(curve.area, 13.0 / 16);
  EXPECT_EQ(counts.alarms(true), 2);
  EXPECT_EQ(counts.alarms(false), 1);
}

TEST(Roc, WhatHasNoStatisticNeverAlarmsBeforeAlways) {
  RocCounts counts;
  counts.note(true, std::nan(""), std::nan(""), false);
  counts.note(true, 1e30, 1, true);
  counts.note(false, -3, 1, false);
  const RocCurve curve = counts.by_threshold();
  ASSERT_EQ(curve.points.size(), 3u);
  EXPECT_EQ(curve.points[1].at, std::exp2(20));
  EXPECT_EQ(curve.points[1].tpr, 0.5);
  EXPECT_EQ(curve.points[1].fpr, 0);
}

TEST(Roc, WithoutAnAttackThereIsNoArea) {
  RocCounts counts;
  counts.note(false, 1, 1, false);
  EXPECT_TRUE(std::isnan(counts.by_factor().area));
  EXPECT_EQ(counts.by_factor().points.back().tpr, 0);
  EXPECT_TRUE(RocCounts().empty());
}

TEST(Roc, MergesExactlyInAnyOrderAndComesBackFromBytes) {
  RocCounts a, b, c;
  for (int i = 1; i <= 300; ++i) {
    (i % 3 == 0 ? a : i % 3 == 1 ? b : c).note(i % 2 == 0, std::exp2(i % 37 - 18), i % 5, i % 7 == 0);
  }
  RocCounts one, two;
  one.merge(a), one.merge(b), one.merge(c);
  two.merge(c), two.merge(a), two.merge(b);
  EXPECT_EQ(bytes(one), bytes(two));
  EXPECT_EQ(one.ticks(true) + one.ticks(false), 300);
  RocCounts read;
  const std::string saved = bytes(one);
  ByteReader in(saved);
  read.load(in);
  EXPECT_TRUE(in.done());
  EXPECT_EQ(bytes(read), saved);
}

// The counts of a campaign are those of its trials' own rates, and the curve by factor passes where the detector
// stands.
TEST(Roc, ACampaignsCurvePassesThroughTheDetectorsOwnRates) {
  const Scenario scenario = Scenario::preset("replay-nongaussian");
  CampaignTable table;
  double right = 0, attacked_share = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TrialResult trial = run_trial(scenario, seed);
    for (const MetricValue& metric : trial.metrics) {
      if (metric.lane == "fixed_norm" && metric.name == "tpr") right += metric.value / 3;
    }
    table.add(trial);
  }
  int lanes = 0;
  for (const DetectionSummary& lane : table.detection()) {
    ASSERT_GT(lane.counts.ticks(true), 0) << lane.lane;
    const auto share = [&](bool attacked) {
      return static_cast<double>(lane.counts.alarms(attacked)) / static_cast<double>(lane.counts.ticks(attacked));
    };
    if (lane.lane != "fixed_norm") continue;
    ++lanes;
    attacked_share = share(true);
    const RocPoint own = rates_at(lane.counts.by_factor(), 1);
    EXPECT_DOUBLE_EQ(own.tpr, share(true));
    EXPECT_DOUBLE_EQ(own.fpr, share(false));
  }
  EXPECT_EQ(lanes, 1);
  EXPECT_NEAR(attacked_share, right, 1e-12);
}

}  // namespace
}  // namespace vigil::roc_test
