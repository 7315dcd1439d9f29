// Attacks of who knows the model: within the chi-square budget, and coordinated over sensors.
#include <cmath>

#include "engine/linalg/chi_square.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::insider_test {
namespace {

/// Two states that decay, two nodes that see both, everybody by himself.
Json world(const Json& adversary, const Json& lane, int steps = 200) {
  const Json C = {{1.0, 0.0}, {0.3, 1.0}};
  const Json sensor = {{"type", "linear"}, {"params", {{"C", C}, {"R", {0.04, 0.09}}}}};
  return {{"vigil", 1},
          {"id", "insider"},
          {"time", {{"dt", 1}, {"steps", steps}}},
          {"plant", {{"type", "linear"}, {"params", {{"A", {{0.95, 0.1}, {0.0, 0.9}}}}}}},
          {"nodes", {{"1", {{"sensor", sensor}}}, {"2", {{"sensor", sensor}}}}},
          {"noise", {{"Q", {0.01, 0.02}}, {"P0", {0.1, 0.1}}}},
          {"initial", {{"truth", {5, 1}}}},
          {"adversary", adversary},
          {"lanes", {{"it", lane}}}};
}

const Json kTested = {{"method", "local_ekf"}, {"detector", {{"type", "chi_square"}, {"params", {{"alpha", 0.05}}}}}};

struct Told {
  explicit Told(const Json& document) : run(Scenario::from_json(document), {8, nullptr, {}}) {
    test::run_to_end(run, capture);
  }
  double at(const std::string& signal, int k) const {
    const int id = run.catalogue().find(signal);
    EXPECT_GE(id, 0) << signal;
    return capture.frames.at(static_cast<std::size_t>(k)).values.at(static_cast<std::size_t>(id));
  }
  double mean_error(const std::string& node, int from, int to) const {
    double sum = 0;
    for (int k = from; k <= to; ++k) sum += at("lane.it." + node + ".error", k);
    return sum / (to - from + 1);
  }
  vigil::Run run;
  test::Capture capture;
};

Json stealthy(Json params, const Json& on = Json::array({"sensor:1"})) {
  return {{"s", {{"type", "stealthy"}, {"on", on}, {"from", 51}, {"params", std::move(params)}}}};
}

// The lane's filter is the adversary's: once both have forgotten where they started the innovation's square is the
// budget, tick by tick, and no alarm is raised at a test whose threshold lies above it.
TEST(Stealthy, KeepsTheStatisticAtTheBudget) {
  const Told told(world(stealthy({{"quantile", 0.9}}), kTested));
  const double budget = chi_square_quantile(0.9, 2);
  for (int k = 100; k <= 200; ++k) {
    EXPECT_NEAR(told.at("lane.it.1.statistic", k), budget, 1e-6 * budget) << k;
    EXPECT_EQ(told.at("lane.it.1.alarm", k), 0) << k;
    EXPECT_EQ(told.at("sensor.1.state", k), 2);
    const double sent = told.at("sensor.1.y1.sent", k);
    EXPECT_NEAR(told.at("sensor.1.y1", k) - sent, told.at("sensor.1.y1.injected", k), 1e-12);
  }
  EXPECT_EQ(told.at("sensor.2.state", 100), 0);
  EXPECT_GT(told.mean_error("1", 100, 200), 2 * told.mean_error("2", 100, 200)) << "it does harm all the same";
}

TEST(Stealthy, ABudgetOfItsOwnAndADirection) {
  const Told told(world(stealthy({{"budget", 2.5}, {"direction", {0, 3}}}), kTested));
  for (int k = 120; k <= 130; ++k) EXPECT_NEAR(told.at("lane.it.1.statistic", k), 2.5, 1e-5);
  const Told above(world(stealthy({{"budget", 9.0}}), kTested));
  EXPECT_EQ(above.at("lane.it.1.alarm", 150), 1) << "beyond the threshold of 5.99 the test sees it";
}

TEST(Stealthy, StartsAnewAfterAPause) {
  Json adversary = stealthy({{"quantile", 0.9}});
  adversary["s"]["schedule"] = {{"every", 60}, {"for", 50}};
  const Told told(world(adversary, kTested));
  EXPECT_EQ(told.at("sensor.1.state", 105), 0);
  EXPECT_NEAR(told.at("lane.it.1.statistic", 160), chi_square_quantile(0.9, 2), 1e-4);
}

TEST(Stealthy, RefusesWhatItCannotShape) {
  test::expect_refused(world(stealthy({{"direction", {1, 2, 3}}}), kTested), "/adversary/s/params/direction");
  test::expect_refused(world(stealthy({{"direction", {0, 0}}}), kTested), "/adversary/s/params/direction");
  test::expect_refused(world(stealthy(Json::object(), Json::array({"sensor:1.y1"})), kTested), "/adversary/s/params");
  test::expect_refused(world(stealthy(Json::object(), Json::array({"link:*"})), kTested), "/adversary/s/on");
}

Json coordinated(Json params, const Json& on) {
  return {{"c", {{"type", "coordinated"}, {"on", on}, {"from", 51}, {"params", std::move(params)}}}};
}

// a = H c: what is added is exactly that, at every node alike.
TEST(Coordinated, AddsHTimesTheShift) {
  const Told told(
      world(coordinated({{"shift", {2, -1}}, {"grow", 10}}, Json::array({"sensor:1", "sensor:2"})), kTested));
  for (const char* node : {"1", "2"}) {
    const std::string name = std::string("sensor.") + node;
    EXPECT_NEAR(told.at(name + ".y1.injected", 51), 0.2, 1e-12);
    EXPECT_NEAR(told.at(name + ".y1.injected", 60), 2, 1e-12);
    EXPECT_NEAR(told.at(name + ".y2.injected", 100), 0.3 * 2 - 1, 1e-12);
  }
  // In the long run the estimate is off by what the readings agree on, as far as the plant lets it.
  EXPECT_GT(told.mean_error("1", 100, 200), 0.5);
}

// Bent sensors: the reading is that of a state that is off by c, so that all nodes agree on it.
TEST(Coordinated, BentSensorsReadTheShiftedState) {
  Json document = Scenario::preset("sparse").document();
  document["time"]["steps"] = 20;
  document["adversary"] = {{"c",
                            {{"type", "coordinated"},
                             {"on", {"sensor:2", "sensor:4"}},
                             {"from", 5},
                             {"params", {{"shift", {1e5, 0, 0, 0, 0, 0}}}}}}};
  const Told told(document);
  for (const char* node : {"2", "4"}) {
    const std::string name = std::string("sensor.") + node + ".range";
    EXPECT_EQ(told.at(std::string("sensor.") + node + ".state", 10), 2);
    EXPECT_NE(told.at(name + ".injected", 10), 0);
    EXPECT_LE(std::abs(told.at(name + ".injected", 10)), 1e5) << "a range changes by no more than the state";
  }
}

TEST(Coordinated, RefusesAShiftOfAnotherSize) {
  const Json both = Json::array({"sensor:1", "sensor:2"});
  test::expect_refused(world(coordinated({{"shift", {1, 2, 3}}}, both), kTested), "/adversary/c/params/shift");
  test::expect_refused(world(coordinated(Json::object(), both), kTested), "/adversary/c/params/shift");
}

TEST(Dos, OfASensorLeavesTheLaneToPredict) {
  const Json jammed = {{"d", {{"type", "dos"}, {"on", {"sensor:1"}}, {"from", 51}, {"to", 60}}}};
  const Told told(world(jammed, kTested));
  const Told clean(world(Json::object(), kTested));
  for (int k = 51; k <= 60; ++k) {
    EXPECT_TRUE(std::isnan(told.at("sensor.1.y1", k)));
    EXPECT_EQ(told.at("sensor.1.y1.sent", k), clean.at("sensor.1.y1", k));
    EXPECT_EQ(told.at("sensor.1.state", k), 1);
    EXPECT_GT(told.at("lane.it.1.bound", k), told.at("lane.it.1.bound", k - 1)) << k;
  }
  EXPECT_EQ(told.at("lane.it.2.error", 200), clean.at("lane.it.2.error", 200)) << "the other node hears nothing of it";
}

TEST(Dos, OfOneChannelLeavesTheOther) {
  const Json jammed = {{"d", {{"type", "dos"}, {"on", {"sensor:1.y2"}}, {"from", 51}}}};
  const Told told(world(jammed, kTested));
  EXPECT_TRUE(std::isnan(told.at("sensor.1.y2", 80)));
  EXPECT_FALSE(std::isnan(told.at("sensor.1.y1", 80)));
}

}  // namespace
}  // namespace vigil::insider_test
