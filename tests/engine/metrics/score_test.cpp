/// A lane's score from beliefs made by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/metrics/lane_score.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::score_test {
namespace {

std::shared_ptr<const Plant> robot() {
  return Registry<PlantMake>::find("unicycle_wheels")->make(rig::completed<PlantMake>("unicycle_wheels"), 1);
}

double metric(const LaneScore& score, const std::string& name, const std::string& node = "") {
  std::vector<MetricValue> metrics;
  score.append_metrics("lane", metrics);
  for (const MetricValue& value : metrics) {
    if (value.name == name && value.node == node) return value.value;
  }
  return std::nan("absent");
}

struct Guess {
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  Belief belief() const { return {.mean = mean.data(), .covariance = covariance.data()}; }
};

TEST(LaneScore, TakesNormsAndWrapsAngles) {
  LaneScore score(*robot(), {"1"});
  const Guess guess{{13, 24, 350}, Eigen::Vector3d(4, 1, 100).asDiagonal()};
  const TickScore tick = score.judge(1, 0, Eigen::Vector3d(10, 20, -5), guess.belief());
  EXPECT_DOUBLE_EQ(tick.error[0], 5);
  EXPECT_NEAR(tick.error[1], 5, 1e-9) << "350 and -5 degrees are 5 apart";
  EXPECT_NEAR(tick.nees, 9.0 / 4 + 16 + 0.25, 1e-9);
  EXPECT_TRUE(std::isnan(tick.nis)) << "nothing was read";
}

TEST(LaneScore, IsTheRootOfTheMeanSquare) {
  LaneScore score(*robot(), {"1", "2"});
  double square[2] = {0, 0}, last = 0;
  for (int k = 0; k <= 25; ++k) {
    for (int o = 0; o < 2; ++o) {
      const double error = k == 0 ? 1e6 : 0.5 * k + o;  // tick 0 does not count
      score.judge(k, o, Eigen::Vector3d::Zero(), Guess{{error, 0, 0}}.belief());
      if (k == 0) continue;
      square[o] += error * error;
      if (k > 15) last += error * error;
    }
  }
  EXPECT_NEAR(metric(score, "rmse_position"), std::sqrt((square[0] + square[1]) / 50), 1e-12);
  EXPECT_NEAR(metric(score, "rmse_position", "1"), std::sqrt(square[0] / 25), 1e-12);
  EXPECT_NEAR(metric(score, "rmse_position", "2"), std::sqrt(square[1] / 25), 1e-12);
  EXPECT_NEAR(metric(score, "rmse_position_last10"), std::sqrt(last / 20), 1e-12);
  EXPECT_EQ(metric(score, "rmse_heading"), 0);
}

TEST(LaneScore, LastTenOfFewerIsOverAll) {
  LaneScore score(*robot(), {"fused"});
  for (int k = 0; k <= 3; ++k)
    score.judge(k, 0, Eigen::Vector3d::Zero(), Guess{{static_cast<double>(k), 0, 0}}.belief());
  EXPECT_NEAR(metric(score, "rmse_position_last10"), std::sqrt(14.0 / 3), 1e-12);
  EXPECT_TRUE(std::isnan(metric(score, "rmse_position", "fused"))) << "one output is the lane itself";
}

TEST(LaneScore, LeavesOutTicksWithoutTruth) {
  LaneScore score(*robot(), {"1"});
  const Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::nan(""));
  score.judge(1, 0, Eigen::Vector3d::Zero(), Guess{{2, 0, 0}}.belief());
  const TickScore silent = score.judge(2, 0, unknown, Guess{{7, 0, 0}}.belief());
  EXPECT_TRUE(std::isnan(silent.error[0]) && std::isnan(silent.nees));
  EXPECT_EQ(metric(score, "rmse_position"), 2);
  LaneScore blind(*robot(), {"1"});
  blind.judge(1, 0, unknown, Guess{{2, 0, 0}}.belief());
  EXPECT_TRUE(std::isnan(metric(blind, "rmse_position")));
}

TEST(LaneScore, JudgesNoIndefiniteBound) {
  LaneScore score(*robot(), {"1"});
  EXPECT_TRUE(std::isnan(
      score.judge(1, 0, Eigen::Vector3d::Zero(), Guess{{1, 1, 1}, Eigen::Vector3d(1, -1, 1).asDiagonal()}.belief())
          .nees));
  EXPECT_TRUE(std::isnan(metric(score, "nees_mean")));
  EXPECT_TRUE(std::isnan(score.judge(2, 0, Eigen::Vector3d::Zero(), {.mean = Guess{}.mean.data()}).nees))
      << "no covariance, no consistency";
}

TEST(LaneScore, TakesNisFromEitherForm) {
  LaneScore score(*robot(), {"1"});
  const Guess guess{{0, 0, 0}};
  const double r[] = {2, 3}, S[] = {4, 0, 0, 9};
  Belief belief = guess.belief();
  belief.innovation = r;
  belief.innovation_size = 2;
  EXPECT_NEAR(score.judge(1, 0, Eigen::Vector3d::Zero(), belief).nis, 13, 1e-12) << "already whitened";
  belief.innovation_covariance = S;
  EXPECT_NEAR(score.judge(2, 0, Eigen::Vector3d::Zero(), belief).nis, 2, 1e-12);
  EXPECT_NEAR(metric(score, "nis_mean"), 7.5, 1e-12);
}

TEST(LaneScore, CountsOnlyItsWindow) {
  LaneScore score(*robot(), {"1"}, {.window = {.from = 3, .to = 4}, .mse = {}});
  for (int k = 0; k <= 9; ++k)
    score.judge(k, 0, Eigen::Vector3d::Zero(), Guess{{static_cast<double>(k), 0, 0}}.belief());
  EXPECT_NEAR(metric(score, "rmse_position"), std::sqrt(12.5), 1e-12);
}

}  // namespace
}  // namespace vigil::score_test
