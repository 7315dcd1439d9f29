// Attacks by their shape: growing, noisy, frozen, played back on links; bursts and budgets.
#include <cmath>

#include "tests/engine/runs/capture.hpp"

namespace vigil::shapes_test {
namespace {

struct Told {
  explicit Told(const Json& adversary, const char* preset = "consensus", int steps = 60)
      : run(scenario(adversary, preset, steps), {4, nullptr, {}}) {
    test::run_to_end(run, capture);
  }
  static Scenario scenario(const Json& adversary, const char* preset, int steps) {
    Json document = Scenario::preset(preset).document();
    document["adversary"] = adversary;
    document["time"]["steps"] = steps;
    return Scenario::from_json(document);
  }
  double at(const std::string& signal, int k) const {
    const int id = run.catalogue().find(signal);
    EXPECT_GE(id, 0) << signal;
    return capture.frames.at(static_cast<std::size_t>(k)).values.at(static_cast<std::size_t>(id));
  }
  vigil::Run run;
  test::Capture capture;
};

Json attack(const char* type, const char* place, Json params, int from = 11) {
  return {{"type", type}, {"on", Json::array({place})}, {"from", from}, {"params", std::move(params)}};
}

TEST(Ramp, GrowsFromItsOffsetToItsLimit) {
  const Told told(Json{{"r", attack("ramp", "sensor:2", {{"slope", {3, 4}}, {"offset", {0, 1}}, {"limit", 30}})}});
  EXPECT_TRUE(std::isnan(told.at("sensor.2.p.injected", 10)) || told.at("sensor.2.p.injected", 10) == 0);
  EXPECT_DOUBLE_EQ(told.at("sensor.2.p.injected", 13), 6);
  EXPECT_DOUBLE_EQ(told.at("sensor.2.q.injected", 13), 9);
  EXPECT_NEAR(std::hypot(told.at("sensor.2.p.injected", 40), told.at("sensor.2.q.injected", 40)), 30, 1e-9);
}

TEST(Ramp, OnLinks) {
  const Told told(Json{{"r", attack("ramp", "link:1-2", {{"slope", {1, 0, 0}}})}});
  EXPECT_EQ(told.at("link.1-2.state", 12), 2);
  EXPECT_DOUBLE_EQ(told.at("link.1-2.injected.x", 21), 10);
  EXPECT_EQ(told.at("link.2-1.state", 21), 0);
}

TEST(NoiseAttack, HasItsDeviation) {
  const Told told(Json{{"n", attack("noise", "link:*", {{"deviation", 3}}, 1)}}, "consensus", 200);
  double sum = 0, square = 0;
  int count = 0;
  for (int k = 1; k <= 200; ++k) {
    for (const char* c : {"x", "y", "theta"}) {
      for (const char* link : {"1-2", "4-5", "7-8"}) {
        const double value = told.at(std::string("link.") + link + ".injected." + c, k);
        sum += value;
        square += value * value;
        ++count;
      }
    }
  }
  EXPECT_NEAR(sum / count, 0, 4 * 3 / std::sqrt(count));
  EXPECT_NEAR(square / count, 9, 4 * 9 * std::sqrt(2. / count));
}

TEST(Freeze, ShowsWhatWasSentLast) {
  const Told told(Json{{"f", attack("freeze", "sensor:3", Json::object(), 21)}});
  for (int k = 21; k <= 60; ++k) {
    EXPECT_EQ(told.at("sensor.3.p", k), told.at("sensor.3.p", 20));
    EXPECT_EQ(told.at("sensor.3.p.source", k), 20);
  }
  EXPECT_NE(told.at("sensor.3.p.sent", 30), told.at("sensor.3.p", 30));
}

// A fusion lane's message is its local estimate, so that what the centre heard can be read from the lane.
TEST(LinkReplay, PlaysWhatTheNodeSaid) {
  const Json params = {{"record_from", 10}, {"record_to", 14}, {"start", 30}, {"end", 50}};
  const Told told(Json{{"p", attack("replay", "link:1-fused", params, 1)}}, "privacy-turn", 60);
  const Told clean(Json::object(), "privacy-turn", 60);
  for (int k = 1; k <= 60; ++k) {
    const bool played = k >= 30 && k <= 50;
    EXPECT_EQ(told.at("link.1-fused.state", k), played ? 3 : 0);
    if (played) {
      EXPECT_EQ(told.at("link.1-fused.source", k), 10 + (k - 30) % 5);
    }
    const auto off = [&](const char* signal) { return std::abs(told.at(signal, k) - clean.at(signal, k)); };
    if (k < 30) {
      EXPECT_EQ(off("lane.unprotected.fused.estimate.sx"), 0);
    }
    EXPECT_EQ(off("lane.unprotected.1.estimate.sx"), 0) << "the sensor itself knows better";
  }
  EXPECT_GT(
      std::abs(told.at("lane.unprotected.fused.estimate.sx", 40) - clean.at("lane.unprotected.fused.estimate.sx", 40)),
      .5);
}

TEST(LinkReplay, TheLawOfTracesHolds) {
  const Json adversary = {
      {"p", attack("replay", "link:*", {{"record_from", 5}, {"record_to", 9}, {"start", 20}, {"end", 40}}, 1)},
      {"f", attack("freeze", "link:3-4", Json::object(), 45)}};
  const Scenario scenario = Told::scenario(adversary, "consensus", 60);
  vigil::Run simulated(scenario, {4, nullptr, {}});
  test::Capture first, second;
  test::run_to_end(simulated, first);
  vigil::Run replayed(
      scenario, {4, std::make_shared<Trace>(Trace::from_csv(test::csv_of(simulated.catalogue(), first.frames))), {}});
  test::run_to_end(replayed, second);
  test::expect_same(simulated, first, replayed, second, "lane.");
}

TEST(Schedule, BurstsAndBudgets) {
  Json bias = attack("bias", "sensor:1", {{"vector", {1, 1}}}, 5);
  bias["schedule"] = {{"every", 10}, {"for", 3}, {"budget", 7}};
  const Told told(Json{{"b", bias}});
  int acted = 0;
  for (int k = 1; k <= 60; ++k) {
    const bool expected = k >= 5 && (k - 5) % 10 < 3 && (k - 5) / 10 * 3 + (k - 5) % 10 < 7;
    EXPECT_EQ(told.at("sensor.1.state", k), expected ? 2 : 0) << k;
    acted += expected ? 1 : 0;
  }
  EXPECT_EQ(acted, 7);
  int begins = 0;
  for (const Mark& mark : told.capture.marks)
    begins += mark.type == MarkType::attack && mark.edge == MarkEdge::begin ? 1 : 0;
  EXPECT_EQ(begins, 3);
}

TEST(Schedule, IsChecked) {
  for (const Json& schedule : {Json{{"every", 3}, {"for", 4}}, Json{{"every", 3}}, Json{{"for", 3}},
                               Json{{"every", 0}, {"for", 1}}, Json{{"budget", 0}}, Json{{"budgets", 1}}, Json(3)}) {
    Json bias = attack("bias", "sensor:1", {{"vector", {1, 1}}});
    bias["schedule"] = schedule;
    EXPECT_THROW(Told::scenario({{"b", bias}}, "consensus", 10), InputError) << schedule;
  }
}

}  // namespace
}  // namespace vigil::shapes_test
