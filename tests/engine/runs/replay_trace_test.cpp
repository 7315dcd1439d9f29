/// Frames of the replay presets as traces: the law of the contract with lanes of their own plants, and lanes that the
/// trace knows nothing of.
#include <fmt/format.h>

#include <functional>

#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::replay_trace_test {
namespace {

using test::Capture;
using test::replay_scenario;
using test::Told;

std::shared_ptr<const Trace> trace_of(const Told& told) {
  return std::make_shared<Trace>(Trace::from_csv(test::csv_of(told.run.catalogue(), told.capture.frames)));
}

/// The CSV with the columns that `keep` takes.
std::shared_ptr<const Trace> trace_of(const Told& told, const std::function<bool(const std::string&)>& keep) {
  std::string text = "k,t";
  std::vector<std::size_t> columns;
  for (const Signal& signal : told.run.catalogue().all()) {
    if (!keep(signal.name)) continue;
    text += "," + signal.name;
    columns.push_back(static_cast<std::size_t>(signal.id));
  }
  text += "\n";
  for (const Frame& frame : told.capture.frames) {
    text += fmt::format("{},{:.17g}", frame.k, frame.t);
    for (const std::size_t c : columns)
      text += std::isnan(frame.values[c]) ? std::string(",") : fmt::format(",{:.17g}", frame.values[c]);
    text += "\n";
  }
  return std::make_shared<Trace>(Trace::from_csv(text));
}

/// run -> frames -> trace -> the same lane.* signals, bit for bit, and the same figures where both have them.
void expect_trace_law(const Scenario& scenario, const std::vector<Command>& commands = {}) {
  const Told first(scenario, {51, nullptr, commands});
  const Told second(scenario, {51, trace_of(first), {}});
  test::expect_same(first.run, first.capture, second.run, second.capture, "lane.");
  for (const MetricValue& m : second.run.metrics()) {
    if (m.name == "tpr" || m.name == "fpr" || m.name == "accuracy" || m.name == "delay" || m.name == "longest" ||
        m.name == "rmse_state_attacked") {
      EXPECT_EQ(m.value, first.metric(m.lane, m.name, m.variant)) << m.lane << " " << m.name;
    }
  }
  // What the trace's lanes say is a trace again.
  const Told third(scenario, {51, trace_of(second), {}});
  test::expect_same(first.run, first.capture, third.run, third.capture, "lane.");
}

TEST(ReplayTraceLaw, HoldsForEveryOtherAttack) {
  const Json attacks[] = {
      {{"type", "bias"}, {"on", {"actuator:1"}}, {"params", {{"vector", Json::array({1.5})}}}},
      {{"type", "dos"}, {"on", {"actuator:1"}}, {"params", {{"probability", 0.5}}}},
      {{"type", "dos"}, {"on", {"sensor:1"}}, {"params", {{"probability", 0.3}}}},
      {{"type", "stealthy"}, {"on", {"sensor:1"}}},
      {{"type", "coordinated"}, {"on", {"sensor:1"}}, {"params", {{"shift", {1, -1}}}}},
  };
  for (Json attack : attacks) {
    SCOPED_TRACE(attack.dump());
    attack["from"] = 60;
    expect_trace_law(replay_scenario("replay-mixed", {}, {{"adversary", {{"replay", nullptr}, {"it", attack}}}}));
  }
}

TEST(ReplayTraceLaw, HoldsForEveryLaneAndCase) {
  for (const char* preset : test::kReplayPresets) {
    for (const int number : {1, 2}) {
      SCOPED_TRACE(std::string(preset) + ", case " + std::to_string(number));
      expect_trace_law(replay_scenario(preset, {}, test::replay_case(number)));
    }
  }
}

TEST(ReplayTraceLaw, HoldsForReferencesAndSparedLanes) {
  Json patch = {{"controller", {{"params", {{"reference", "sine"}}}}}};
  patch["lanes"] = {{"zeta1_wm", {{"adversary", false}}}, {"eq29", {{"adversary", false}}}};
  expect_trace_law(replay_scenario("replay-mixed", {}, patch));
}

TEST(ReplayTraceLaw, HoldsForOneChannelForInjectionsAndForHands) {
  const Json attacks = {{"adversary",
                         {{"replay", {{"on", {"sensor:1.y2"}}}},
                          {"glare",
                           {{"type", "bias"},
                            {"on", {"sensor:1"}},
                            {"from", 120},
                            {"to", 140},
                            {"params", {{"vector", {0.3, -0.2}}}}}}}}};
  const std::vector<Command> commands{{210, {{"attack", {{"id", "a1"}, {"type", "replay"}, {"on", {"sensor:1"}}}}}},
                                      {280, {{"end_attack", "a1"}}}};
  for (const char* preset : test::kReplayPresets) expect_trace_law(replay_scenario(preset, {}, attacks), commands);
}

bool is_plain(const std::string& name) {
  return name.starts_with("truth.") || name.starts_with("input.") || name == "sensor.1.y1" || name == "sensor.1.y2";
}

// A trace of a plant that somebody else drove: inputs and readings are the trace's, for every lane the same.
TEST(ReplayTrace, WithoutLaneColumnsDrivesThemOpenLoop) {
  const Scenario honest = replay_scenario("replay-mixed", {}, test::no_attack());
  const Told recorded(honest, {52, nullptr, {}});
  const auto trace = trace_of(recorded, is_plain);
  const Told told(honest, {52, trace, {}});
  for (const auto& [lane, ignored] : honest.document()["lanes"].items()) {
    for (std::int64_t k = 3; k <= 300; ++k) {
      for (const char* what : {"estimate.x1", "estimate.x2"}) {
        EXPECT_TRUE(std::isfinite(told.of(lane, k, what))) << lane << " " << k;
        EXPECT_NEAR(told.of(lane, k, what), told.at(k, std::string("truth.") + (what + 9)), 8) << lane << " " << k;
      }
    }
    EXPECT_EQ(told.run.catalogue().find("lane." + lane + ".input.u1") >= 0,
              lane.starts_with("zeta1_wm") || lane == "repaired")
        << lane << ": only what marks its sensor has readings of its own";
  }
  // Lanes that differ in nothing but their loop agree: no loop is closed here.
  for (std::int64_t k = 3; k <= 300; ++k) {
    EXPECT_EQ(told.of("zeta1", k, "estimate.x1"), told.of("zeta1_freeze", k, "estimate.x1"));
    EXPECT_EQ(told.of("zeta1", k, "estimate.x1"), told.of("repaired_ctrl", k, "estimate.x1"));
    EXPECT_NEAR(told.of("zeta1", k, "estimate.x1"), told.of("zeta1_wm", k, "estimate.x1"), 1e-10) << k;
  }
}

// The adversary of the document acts on a trace that describes no attack: also on what a lane's sensor marks.
TEST(ReplayTrace, IsPlayedBackByTheDocumentsAdversary) {
  const Told recorded(replay_scenario("replay-ubb", {}, test::no_attack()), {53, nullptr, {}});
  const auto trace = trace_of(recorded, is_plain);
  const Told told(replay_scenario("replay-ubb"), {53, trace, {}});
  for (std::int64_t k = 101; k <= 180; ++k) {
    const std::int64_t source = 50 + (k - 101) % 51;
    EXPECT_EQ(told.at(k, "sensor.1.y1"), trace->at(source, trace->find("sensor.1.y1"))) << k;
    EXPECT_EQ(told.of("repaired", k, "sensor.1.y1"), told.of("repaired", source, "sensor.1.y1")) << k;
    EXPECT_EQ(told.of("zonotope", k, "sensor.1.y1"), told.of("zonotope", source, "sensor.1.y1")) << k;
  }
  EXPECT_GT(told.metric("repaired", "tpr"), 0.95);
  EXPECT_GT(told.metric("zonotope", "tpr"), 0.7);
  EXPECT_EQ(told.metric("zonotope", "fpr"), 0);
}

// A trace that describes an attack on the shared readings: a lane that marks its sensor meets the same attack.
TEST(ReplayTrace, CarriesItsAttackToLanesThatMark) {
  const auto shared = [](const std::string& name) { return !name.starts_with("lane."); };
  const Told recorded(replay_scenario("replay-ubb"), {54, nullptr, {}});
  const Told told(replay_scenario("replay-ubb", {}, test::no_attack()), {54, trace_of(recorded, shared), {}});
  for (std::int64_t k = 1; k <= 300; ++k) {
    const bool played = k >= 101 && k <= 180;
    const std::int64_t source = played ? 50 + (k - 101) % 51 : k;
    EXPECT_EQ(told.of("repaired", k, "sensor.1.state"), played ? 3 : 0) << k;
    if (played) {
      EXPECT_EQ(told.of("repaired", k, "sensor.1.y1"), told.of("repaired", source, "sensor.1.y1")) << k;
      EXPECT_NE(told.of("repaired", k, "sensor.1.y1.sent"), told.of("repaired", k, "sensor.1.y1")) << k;
    }
  }
  EXPECT_GT(told.metric("repaired", "tpr"), 0.95);
}

}  // namespace
}  // namespace vigil::replay_trace_test
