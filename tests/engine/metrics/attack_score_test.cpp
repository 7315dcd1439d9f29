/// How well a lane finds attacks, and the mean square errors a scenario asks for, from beliefs made by hand.
#include "engine/metrics/attack_score.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/metrics/lane_score.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::attack_score_test {
namespace {

constexpr int kChannels = 3, kWindow = 2;

/// Two nodes of three channels; ticks are told one after the other.
class Story {
 public:
  explicit Story(int nodes = 2) : score_(std::vector<int>(static_cast<std::size_t>(nodes), kChannels), kWindow, nodes) {
    effects_.resize(std::vector<int>(static_cast<std::size_t>(nodes), kChannels));
  }

  /// What happened at node 0 in this tick.
  void tick(SensorState state, const Eigen::Vector3d& injected) {
    effects_.injected[0] = injected;
    effects_.state[0] = state;
    score_.note(effects_.injected, effects_.state);
  }
  void judge(const Eigen::Matrix<double, kChannels * kWindow, 1>& E, int choice = -1, int output = 0) {
    score_.judge(output, {E.data(), kChannels, kWindow}, choice);
  }
  void silent(int choice = -1, int output = 0) { score_.judge(output, {}, choice); }
  AttackScore& score() { return score_; }

  double metric(const std::string& name, const std::string& variant = "", const std::string& node = "") const {
    std::vector<MetricValue> metrics;
    score_.append_metrics("lane", {"a", "b"}, metrics);
    for (const MetricValue& value : metrics) {
      if (value.name == name && value.variant == variant && value.node == node) return value.value;
    }
    return std::nan("absent");
  }

 private:
  AttackScore score_;
  SensorEffects effects_;
};

using Window = Eigen::Matrix<double, kChannels * kWindow, 1>;

Window entries(double a, double b, double c, double d, double e, double f) {
  Window w;
  w << a, b, c, d, e, f;
  return w;
}

const Eigen::Vector3d kNothing = Eigen::Vector3d::Zero();

TEST(AttackScore, CountsHitsMissesAndFalseEntriesByKind) {
  Story story;
  story.tick(SensorState::type_i, {2, 3, 0});
  story.silent();  // the window is not full
  story.tick(SensorState::type_i, {1, 4, 0});
  story.judge(entries(1e-9, 5, 0, 1, -4, 0));  // exact: values do not matter, only where they are
  story.tick(SensorState::type_i, {1, 0, 0});  // a draw of zero is no entry
  story.judge(entries(1, 0, 0, 0, 7, 7));
  EXPECT_DOUBLE_EQ(story.metric("omp_exact", "I"), 1.0 / 2);
  EXPECT_DOUBLE_EQ(story.metric("omp_hit_rate", "I"), 5.0 / 7) << "of 4 and of 3 entries: 4 and 1";
  EXPECT_DOUBLE_EQ(story.metric("omp_false_entries", "I"), 2.0 / 2);
  EXPECT_TRUE(std::isnan(story.metric("omp_exact", "II")));
  EXPECT_TRUE(std::isnan(story.metric("alarm_rate_clean")));
  for (int k = 0; k < 2; ++k) story.tick(SensorState::type_ii, {1, 1, 0});
  story.judge(entries(1, 0, 0, 1, 0, 0));
  EXPECT_EQ(story.metric("omp_exact", "II"), 0);
  EXPECT_EQ(story.metric("omp_hit_rate", "II"), 0.5);
  EXPECT_EQ(story.metric("omp_false_entries", "II"), 0);
  EXPECT_DOUBLE_EQ(story.metric("omp_exact", "I"), 1.0 / 2) << "another kind counts elsewhere";
}

// The oldest reading comes first in E, wherever it stands in the score's ring.
TEST(AttackScore, MatchesEntriesToTheirTicks) {
  Story story;
  for (int k = 0; k < 7; ++k) {
    const Eigen::Vector3d now = k % 2 == 0 ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, 0, 1);
    story.tick(SensorState::type_r, now);
    if (k == 0) continue;
    story.judge(k % 2 == 0 ? entries(0, 0, 1, 1, 0, 0) : entries(1, 0, 0, 0, 0, 1));
  }
  EXPECT_EQ(story.metric("omp_exact", "R"), 1);
}

TEST(AttackScore, LeavesOutWindowsThatAreMixed) {
  Story story;
  story.tick(SensorState::clean, kNothing);
  story.tick(SensorState::type_i, {1, 1, 0});
  story.judge(entries(1, 1, 1, 0, 0, 0));
  story.tick(SensorState::type_ii, {1, 1, 0});
  story.judge(entries(1, 1, 1, 0, 0, 0));
  story.tick(SensorState::clean, kNothing);
  story.judge(entries(1, 1, 1, 0, 0, 0));
  for (const char* name : {"omp_exact", "omp_hit_rate", "omp_false_entries"}) {
    EXPECT_TRUE(std::isnan(story.metric(name, "I"))) << name;
    EXPECT_TRUE(std::isnan(story.metric(name, "II"))) << name;
  }
  EXPECT_TRUE(std::isnan(story.metric("alarm_rate_clean")));
}

TEST(AttackScore, RatesAlarmsInCleanWindows) {
  Story story;
  story.tick(SensorState::clean, kNothing);
  for (int k = 0; k < 8; ++k) {
    story.tick(SensorState::clean, kNothing);
    if (k == 5) {
      story.silent();  // a window that is not searched is no window
    } else {
      story.judge(k == 3 ? entries(0, 0, 1e-12, 0, 0, 0) : entries(0, 0, 0, 0, 0, 0));
    }
  }
  EXPECT_DOUBLE_EQ(story.metric("alarm_rate_clean"), 1.0 / 7);
  EXPECT_TRUE(std::isnan(story.metric("omp_exact", "clean")));
}

TEST(AttackScore, SharesOfAttackedChoices) {
  Story story;
  story.tick(SensorState::type_i, {1, 0, 0});
  story.silent(0, 0);  // its own sensor, which is attacked
  story.silent(0, 1);
  story.tick(SensorState::type_i, {1, 0, 0});
  story.silent(1, 0);
  story.silent(-1, 1);  // chose nobody
  story.tick(SensorState::clean, kNothing);
  story.silent(0, 0);  // judged by this tick alone
  story.silent(1, 1);
  EXPECT_DOUBLE_EQ(story.metric("choice_attacked_share", "", "a"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(story.metric("choice_attacked_share", "", "b"), 1.0 / 2);
}

TEST(AttackScore, WithoutWindowsSaysNothing) {
  AttackScore none({3, 3}, 0, 2);
  none.judge(0, {}, -1);
  std::vector<MetricValue> metrics;
  none.append_metrics("lane", {"a", "b"}, metrics);
  EXPECT_TRUE(metrics.empty());
  AttackScore fused({3, 3}, 2, 1);
  fused.judge(1, {}, 0);  // an output beyond the nodes is not judged
}

TEST(AttackScore, ACopyGoesOnByItself) {
  Story story;
  for (int k = 0; k < 2; ++k) story.tick(SensorState::type_i, {1, 1, 0});
  Story fork = story;
  story.judge(entries(1, 1, 0, 1, 1, 0));
  fork.judge(entries(1, 1, 0, 0, 0, 0));
  EXPECT_EQ(story.metric("omp_hit_rate", "I"), 1);
  EXPECT_EQ(fork.metric("omp_hit_rate", "I"), 0.5);
}

// metrics.mse: one component, its own ticks, at each output; rmse keeps its own window.
TEST(MseFigures, AreMeansOfSquaresOverTheirTicks) {
  const auto plant = Registry<PlantMake>::find("tracker")->make(rig::completed<PlantMake>("tracker"), 0.05);
  ScoreRules rules;
  rules.mse = {{"whole", 0, {}}, {"early", 2, {.from = 1, .to = 3}}};
  LaneScore score(*plant, {"1", "2"}, rules);
  Eigen::VectorXd truth = Eigen::VectorXd::Zero(6), guess(6);
  double whole[2] = {0, 0}, early[2] = {0, 0};
  for (int k = 0; k <= 8; ++k) {
    for (int o = 0; o < 2; ++o) {
      guess << 0.5 * k + o, 50, k - 2 * o, 60, 70, 80;
      if (k == 0) guess.setConstant(1e6);  // the initial state does not count
      score.judge(k, o, truth, {.mean = guess.data()});
      if (k == 0) continue;
      whole[o] += guess[0] * guess[0] / 8;
      if (k <= 3) early[o] += guess[2] * guess[2] / 3;
    }
  }
  truth[0] = std::nan("");  // a tick without its truth does not count either
  score.judge(9, 0, truth, {.mean = guess.data()});
  std::vector<MetricValue> metrics;
  score.append_metrics("lane", metrics);
  int found = 0;
  for (const MetricValue& value : metrics) {
    const std::size_t o = value.node == "2" ? 1 : 0;
    if (value.name != "whole" && value.name != "early") continue;
    EXPECT_NEAR(value.value, value.name == "whole" ? whole[o] : early[o], 1e-12) << value.name << value.node;
    ++found;
  }
  EXPECT_EQ(found, 4) << "one a node and figure, none for the lane";
}

TEST(MseFigures, NameAComponentOfThePlant) {
  const Scenario sparse = Scenario::preset("sparse");
  try {
    const vigil::Run run(sparse.patched({{"metrics", {{"mse", {{"mse_px", {{"component", "pxx"}}}}}}}}),
                         {1, nullptr, {}});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().pointer, "/metrics/mse/mse_px/component");
    EXPECT_NE(error.problems().front().allowed.find("px, vx, py"), std::string::npos);
  }
}

}  // namespace
}  // namespace vigil::attack_score_test
