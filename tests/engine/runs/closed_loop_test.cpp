/// Lanes that control a plant of their own: beside a plain loop of matrices, beside each other, beside their twins.
#include "engine/linalg/riccati.hpp"
#include "tests/engine/runs/plain_tank.hpp"
#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::closed_loop_test {
namespace {

using test::kReplayPresets;
using test::replay_case;
using test::replay_scenario;
using test::Told;

/// Both missing, or within 1e-12 of their size.
void expect_close(double ours, double plain, const std::string& what) {
  if (std::isnan(plain)) {
    ASSERT_TRUE(std::isnan(ours)) << what << " is " << ours;
  } else {
    ASSERT_NEAR(ours, plain, 1e-12 * std::max(1.0, std::abs(plain))) << what;
  }
}

void expect_vector(const Told& told, const std::string& lane, std::int64_t k, const Eigen::VectorXd& plain,
                   const std::string& name, const std::string& tail = "") {
  for (int c = 0; c < 2; ++c) {
    const std::string what = name + std::to_string(c + 1) + tail;
    expect_close(told.of(lane, k, what), plain.size() > 0 ? plain[c] : test::plain::kMissing,
                 lane + " " + what + " at " + std::to_string(k));
  }
}

void expect_matrix(const Told& told, const std::string& lane, std::int64_t k, const Eigen::MatrixXd& plain,
                   const std::string& name) {
  const auto entry = [&](int r, int c) { return plain.size() > 0 ? plain(r, c) : test::plain::kMissing; };
  for (const auto& [r, c] : {std::pair{0, 0}, std::pair{0, 1}, std::pair{1, 1}})
    expect_close(told.of(lane, k, name + ".x" + std::to_string(r + 1) + ".x" + std::to_string(c + 1)), entry(r, c),
                 lane + " " + name + " at " + std::to_string(k));
}

void expect_plain(const Told& told, const std::string& lane, const std::vector<test::plain::Row>& rows) {
  ASSERT_EQ(told.capture.frames.size(), rows.size());
  for (std::int64_t k = 0; k < static_cast<std::int64_t>(rows.size()); ++k) {
    const test::plain::Row& row = rows[static_cast<std::size_t>(k)];
    expect_vector(told, lane, k, row.truth, "truth.x");
    expect_vector(told, lane, k, row.arrived, "sensor.1.y");
    expect_vector(told, lane, k, row.estimate, "estimate.x");
    expect_vector(told, lane, k, row.residual, "residual.y");
    expect_matrix(told, lane, k, row.covariance, "covariance");
    expect_matrix(told, lane, k, row.shape, "shape");
    if (k > 0) expect_close(told.of(lane, k, "input.u1"), row.input[0], lane + " input at " + std::to_string(k));
    const std::string where = lane + " at " + std::to_string(k);
    expect_close(told.of(lane, k, "statistic"), row.statistic, "statistic of " + where);
    expect_close(told.of(lane, k, "threshold"), row.threshold, "threshold of " + where);
    const bool judged = !std::isnan(row.statistic) && !std::isnan(row.threshold);
    expect_close(told.of(lane, k, "alarm"), judged ? row.alarm : test::plain::kMissing, "alarm of " + where);
  }
}

void expect_channel(const Told& told, const std::string& lane, const std::vector<test::plain::Row>& rows,
                    const test::plain::Attack& attack) {
  for (int k = 1; k <= 300; ++k) {
    const test::plain::Row& row = rows[static_cast<std::size_t>(k)];
    for (int c = 0; c < 2; ++c) {
      const std::string channel = "sensor.1.y" + std::to_string(c + 1);
      const bool played = attack.active(k);
      expect_close(told.of(lane, k, channel + ".source"), played ? attack.source(k) : test::plain::kMissing, channel);
      expect_close(told.of(lane, k, channel + ".sent"), played ? row.sent[c] : test::plain::kMissing, channel);
      EXPECT_EQ(told.of(lane, k, channel + ".injected"), 0);
    }
    EXPECT_EQ(told.of(lane, k, "sensor.1.state"), attack.active(k) ? 3 : 0) << k;
  }
}

TEST(ClosedLoop, IsThePlainLoopInEveryProfile) {
  for (int s = 0; s < 3; ++s) {
    for (const int number : {1, 2}) {
      const auto attack = number == 1 ? test::plain::Attack{} : test::plain::Attack{250, 300};
      const std::uint64_t seed = 100 + static_cast<std::uint64_t>(s);
      const Told told(replay_scenario(kReplayPresets[s], {}, replay_case(number)), {seed, nullptr, {}});
      for (const auto& profile : test::plain::profiles()) {
        SCOPED_TRACE(std::string(kReplayPresets[s]) + ", case " + std::to_string(number));
        const auto rows = test::plain::simulate(profile, replay::tank::kScenarios[s], seed, attack);
        expect_plain(told, profile.id, rows);
        if (testing::Test::HasFatalFailure()) return;
        expect_channel(told, profile.id, rows, attack);
      }
    }
  }
}

// Case 1 lasts for 80 ticks and the record for 51: at 152 it begins again.
TEST(ClosedLoop, RepeatsARecordThatIsTooShort) {
  const Told told(replay_scenario("replay-mixed", {"zeta1"}), {5, nullptr, {}});
  for (const auto& [k, source] : {std::pair{101, 50}, std::pair{151, 100}, std::pair{152, 50}, std::pair{180, 78}}) {
    EXPECT_EQ(told.of("zeta1", k, "sensor.1.y1.source"), source);
    EXPECT_EQ(told.of("zeta1", k, "sensor.1.y1"), told.of("zeta1", source, "sensor.1.y1"));
  }
  const auto marks = told.marks(MarkType::attack);
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].k, 101);
  EXPECT_EQ(marks[1].k, 181);
  EXPECT_EQ(marks[0].node, "1");
  EXPECT_NE(marks[0].detail.find("ticks 50 to 100 is shorter than the attack and repeats"), std::string::npos)
      << marks[0].detail;
}

TEST(ClosedLoop, DoesNotDependOnLanesBeside) {
  for (const char* preset : kReplayPresets) {
    const Told all(replay_scenario(preset), {31, nullptr, {}});
    for (const auto& [lane, ignored] : all.run.scenario().document()["lanes"].items()) {
      const Told alone(replay_scenario(preset, {lane}), {31, nullptr, {}});
      test::expect_same(alone.run, alone.capture, all.run, all.capture, "");
    }
  }
}

// The reference plant follows its own truth; the attack leaves its mark on what the shared sensor says, nothing else.
TEST(ClosedLoop, HasAReferencePlant) {
  const Told told(replay_scenario("replay-mixed", {"zeta1"}), {32, nullptr, {}});
  const Eigen::MatrixXd L = test::plain::feedback();
  for (int k = 1; k <= 300; ++k) {
    const double u = L(0, 0) * told.at(k - 1, "truth.x1") + L(0, 1) * told.at(k - 1, "truth.x2");
    EXPECT_NEAR(told.at(k, "input.u1"), u, 1e-12 * std::max(1.0, std::abs(u))) << k;
  }
}

struct Twins {
  const char* metric;
  const char* variant;
};

// What a lane's twin was worth is what the lane itself is worth where the adversary does not touch it.
TEST(Twin, IsTheLaneWithoutAdversary) {
  for (const char* preset : kReplayPresets) {
    const Scenario scenario = replay_scenario(preset);
    Json patch = Json::object();
    for (const auto& [lane, ignored] : scenario.document()["lanes"].items()) patch["lanes"][lane]["adversary"] = false;
    const Told attacked(scenario, {33, nullptr, {}}), spared(scenario.patched(patch), {33, nullptr, {}});
    for (const auto& [lane, ignored] : scenario.document()["lanes"].items()) {
      for (const Twins& twin :
           {Twins{"rmse_state", ""}, Twins{"rmse_state", "x1"}, Twins{"rmse_state", "x2"}, Twins{"peak_error", ""}}) {
        EXPECT_EQ(attacked.metric(lane, twin.metric, twin.variant), spared.metric(lane, twin.metric, twin.variant))
            << preset << " " << lane << " " << twin.metric;
      }
      EXPECT_FALSE(spared.has_metric(lane, "rmse_state_attacked")) << lane;
      if (!attacked.has_metric(lane, "event")) continue;
      bool flagged = false;
      for (int k = 101; k <= 180; ++k) flagged = flagged || spared.of(lane, k, "alarm") == 1;
      EXPECT_EQ(attacked.metric(lane, "event_without_attack"), flagged ? 1 : 0) << preset << " " << lane;
    }
  }
}

TEST(Watermark, OfTheSensorCostsNothingWithoutAttack) {
  for (const char* preset : kReplayPresets) {
    for (const auto& [marked, plain] : {std::pair{"zeta1_wm", "zeta1"}, std::pair{"zeta1_wm_freeze", "zeta1_freeze"}}) {
      const Told told(replay_scenario(preset, {marked, plain}, test::no_attack()), {34, nullptr, {}});
      double largest_mark = 0;
      for (int k = 1; k <= 300; ++k) {
        for (const char* what : {"truth.x1", "truth.x2", "input.u1", "estimate.x1", "estimate.x2", "residual.y1",
                                 "residual.y2", "statistic", "threshold", "alarm"}) {
          const double a = told.of(marked, k, what), b = told.of(plain, k, what);
          if (std::isnan(b)) {
            EXPECT_TRUE(std::isnan(a)) << what << " at " << k;
          } else {
            EXPECT_NEAR(a, b, 1e-10 * std::max(1.0, std::abs(b))) << what << " at " << k;
          }
        }
        const double mark = told.of(marked, k, "sensor.1.y1") - told.of(plain, k, "sensor.1.y1");
        largest_mark = std::max(largest_mark, std::abs(mark));
      }
      EXPECT_GT(largest_mark, 2) << "the mark is there";
    }
  }
}

// Path `monitor`: estimator and controller hear what was sent.
TEST(Monitor, KeepsItsEstimatorUnharmed) {
  for (const char* preset : kReplayPresets) {
    for (const char* lane : {"eq29", "eq29_freeze", "fixed_norm"}) {
      const Scenario scenario = replay_scenario(preset, {lane});
      const Told attacked(scenario, {35, nullptr, {}}),
          spared(scenario.with(std::string("lanes.") + lane + ".adversary", false), {35, nullptr, {}});
      int apart = 0;
      for (int k = 1; k <= 300; ++k) {
        for (const char* what : {"truth.x1", "truth.x2", "input.u1", "estimate.x1", "estimate.x2"})
          EXPECT_TRUE(test::same_bits(attacked.of(lane, k, what), spared.of(lane, k, what))) << what << " at " << k;
        apart += test::same_bits(attacked.of(lane, k, "residual.y1"), spared.of(lane, k, "residual.y1")) ? 0 : 1;
      }
      EXPECT_EQ(apart, 80) << "the residual is that of what arrived";
      EXPECT_EQ(attacked.metric(lane, "rmse_state"), attacked.metric(lane, "rmse_state_attacked"));
    }
  }
}

}  // namespace
}  // namespace vigil::closed_loop_test
