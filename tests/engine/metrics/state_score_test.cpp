#include "engine/metrics/state_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "tests/engine/methods/rig.hpp"

namespace vigil::state_score_test {
namespace {

std::map<std::string, double> figures(const StateScore& score, const std::string& suffix = "") {
  std::vector<MetricValue> metrics;
  score.append_metrics("lane", suffix, metrics);
  std::map<std::string, double> result;
  for (const MetricValue& m : metrics) result[m.name + (m.variant.empty() ? "" : " " + m.variant)] = m.value;
  return result;
}

std::shared_ptr<const Plant> two_states() {
  return Registry<PlantMake>::find("linear")->make(rig::completed<PlantMake>("linear", {{"A", {{1, 0}, {0, 1}}}}), 1);
}

TEST(StateScore, CountsASeriesByHand) {
  const auto plant = two_states();
  StateScore score(*plant, 3);
  const double errors[5][2] = {{100, 100}, {-50, 0}, {3, 0}, {-1, 2}, {0, -4}};
  for (int k = 1; k <= 5; ++k) {
    const Eigen::Vector2d truth(k, -k);
    const Eigen::Vector2d estimate = truth + Eigen::Vector2d(errors[k - 1][0], errors[k - 1][1]);
    score.note(k, truth, estimate.data());
  }
  const auto f = figures(score);
  EXPECT_DOUBLE_EQ(f.at("rmse_state"), std::sqrt(30.0 / 6)) << "9 + 1 + 4 + 16 over 3 ticks and 2 components";
  EXPECT_DOUBLE_EQ(f.at("rmse_state x1"), std::sqrt(10.0 / 3));
  EXPECT_DOUBLE_EQ(f.at("rmse_state x2"), std::sqrt(20.0 / 3));
  EXPECT_EQ(f.at("peak_error"), 4);
  EXPECT_EQ(figures(score, "_attacked").at("peak_error_attacked"), 4);
  EXPECT_EQ(figures(score, "_attacked").at("rmse_state_attacked x1"), f.at("rmse_state x1"));
}

TEST(StateScore, SaysNothingOfNoTicks) {
  const auto plant = two_states();
  StateScore score(*plant, 20);
  const Eigen::Vector2d estimate(1, 1);
  score.note(19, Eigen::Vector2d(0, 0), estimate.data());
  EXPECT_TRUE(figures(score).empty());
  score.note(20, Eigen::Vector2d(std::numeric_limits<double>::quiet_NaN(), 0), estimate.data());
  EXPECT_TRUE(figures(score).empty()) << "a truth that is not known judges nobody";
  score.note(21, Eigen::Vector2d(0, 1), estimate.data());
  EXPECT_EQ(figures(score).at("peak_error"), 1);
}

TEST(StateScore, TurnsAnglesTheShortWay) {
  const auto plant =
      Registry<PlantMake>::find("unicycle_wheels")->make(rig::completed<PlantMake>("unicycle_wheels"), 1);
  const double period = plant->state()[2].period;
  ASSERT_GT(period, 0);
  StateScore score(*plant, 1);
  const Eigen::Vector3d truth(0, 0, 0.49 * period), estimate(0, 0, -0.49 * period);
  score.note(1, truth, estimate.data());
  EXPECT_NEAR(figures(score).at("peak_error"), 0.02 * period, 1e-12 * period);
}

}  // namespace
}  // namespace vigil::state_score_test
