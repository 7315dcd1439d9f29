// Attacks on the commands of a controller: pushed, lost, held. The plant feels them, the lane does not know.
#include <cmath>

#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::actuators_test {
namespace {

using test::replay_scenario;
using test::Told;

Told told(const Json& attack, const Json& lane = Json::object()) {
  Json patch = {{"adversary", {{"replay", nullptr}, {"it", attack}}}, {"time", {{"steps", 80}}}};
  if (!lane.empty()) patch["lanes"] = {{"repaired", lane}};
  return {replay_scenario("replay-nongaussian", {"repaired"}, patch), {9, nullptr, {}}};
}

Json attack(const char* type, Json params = Json::object(), int from = 21, int to = 60) {
  return {{"type", type}, {"on", {"actuator:1"}}, {"from", from}, {"to", to}, {"params", std::move(params)}};
}

/// What the plant's input matrix makes of a push on u1: B = (0.7, 0.3).
double effect(const Told& with, const Told& without, int k) {
  return with.of("repaired", k, "truth.x1") - without.of("repaired", k, "truth.x1");
}

TEST(Actuators, ABiasPushesThePlantAndIsSaid) {
  const Told pushed = told(attack("bias", {{"vector", Json::array({2.0})}}));
  const Told clean = told(attack("bias", {{"vector", Json::array({0.0})}}));
  EXPECT_EQ(effect(pushed, clean, 20), 0);
  EXPECT_NEAR(effect(pushed, clean, 21), 0.7 * 2, 1e-12);
  EXPECT_NEAR(pushed.of("repaired", 30, "actuator.1.u1.injected"), 2, 1e-12);
  EXPECT_EQ(pushed.of("repaired", 61, "actuator.1.u1.injected"), 0);
  EXPECT_EQ(pushed.at(30, "actuator.1.u1.injected"), 2) << "the reference plant is pushed, too";
  EXPECT_EQ(pushed.marks(MarkType::attack).size(), 2U);
}

TEST(Actuators, ARampGrowsTickByTick) {
  const Told pushed = told(attack("ramp", {{"slope", Json::array({0.5})}}));
  EXPECT_NEAR(pushed.of("repaired", 31, "actuator.1.u1.injected"), 5, 1e-12);
}

TEST(Actuators, ASignalOfTime) {
  // until 3 s (20 ticks of 0.15 s) nothing, then 1.5
  const Json pieces = Json::array({Json::array({6, 0, 0, 0, 0, 0, 0}), Json::array({99, 1.5, 0, 0, 0, 0, 0})});
  const Told pushed = told(attack("waveform", {{"pieces", pieces}}, 1, 80));
  EXPECT_NEAR(pushed.of("repaired", 39, "actuator.1.u1.injected"), 0, 1e-12);
  EXPECT_NEAR(pushed.of("repaired", 41, "actuator.1.u1.injected"), 1.5, 1e-12);
}

TEST(Actuators, NoiseIsDrawnOnceATick) {
  const Told pushed = told(attack("noise", {{"deviation", 3}}));
  double square = 0;
  for (int k = 21; k <= 60; ++k) square += std::pow(pushed.of("repaired", k, "actuator.1.u1.injected"), 2);
  // 40 draws: 99.9 % of chi-square with 40 degrees lie between 16.9 and 76
  EXPECT_GT(square / 9, 16.9);
  EXPECT_LT(square / 9, 76);
  EXPECT_EQ(pushed.of("repaired", 30, "actuator.1.u1.injected"), pushed.at(30, "actuator.1.u1.injected"))
      << "the same for every plant";
}

TEST(Actuators, ALostCommandIsNone) {
  const Told lost = told(attack("dos"));
  for (int k = 21; k <= 60; ++k)
    EXPECT_DOUBLE_EQ(lost.of("repaired", k, "actuator.1.u1.injected"), -lost.of("repaired", k, "input.u1")) << k;
}

TEST(Actuators, AHeldCommandStaysWhereItWas) {
  const Told held = told(attack("freeze"));
  const double last = held.of("repaired", 20, "input.u1");
  for (int k = 21; k <= 60; ++k) {
    const double reached = held.of("repaired", k, "input.u1") + held.of("repaired", k, "actuator.1.u1.injected");
    EXPECT_NEAR(reached, last, 1e-12) << k;
  }
}

TEST(Actuators, AreNotReachedInALaneThatIsSpared) {
  const Told spared = told(attack("bias", {{"vector", Json::array({2.0})}}), {{"adversary", false}});
  EXPECT_EQ(spared.of("repaired", 30, "actuator.1.u1.injected"), 0);
  EXPECT_EQ(spared.at(30, "actuator.1.u1.injected"), 2);
}

TEST(Actuators, AreRefusedWhereThereAreNone) {
  Json document = Scenario::preset("consensus").document();
  document["adversary"] = {{"it", attack("bias")}};
  test::expect_refused(document, "/adversary/it/on/0");
  Json observer = Scenario::preset("observer-pair").document();
  for (const char* type : {"dos", "freeze"}) {
    observer["adversary"] = {{"it", attack(type)}};
    test::expect_refused(observer, "/adversary/it/on");
  }
}

}  // namespace
}  // namespace vigil::actuators_test
