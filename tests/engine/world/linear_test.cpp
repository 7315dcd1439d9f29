/// A linear plant of the user's own: in ticks, in continuous time, with names.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "engine/linalg/zero_order_hold.hpp"
#include "engine/world/controller.hpp"
#include "engine/world/sensor.hpp"
#include "tests/engine/methods/rig.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::linear_test {
namespace {

const Json kA{{0, 1}, {-4, -0.4}}, kB{{0}, {1}};

std::shared_ptr<const Plant> plant_of(const Json& params, double dt = 0.1) {
  return Registry<PlantMake>::find("linear")->make(rig::completed<PlantMake>("linear", params), dt);
}

Json document_of(const Json& plant, const Json& sensor = {{"C", {{1, 0}}}}) {
  return {{"vigil", 1},
          {"id", "mine"},
          {"time", {{"dt", 0.1}, {"steps", 20}}},
          {"plant", {{"type", "linear"}, {"params", plant}}},
          {"nodes", {{"1", {{"sensor", {{"type", "linear"}, {"params", sensor}}}}}}},
          {"noise", {{"Q", 0.25}, {"P0", 0.1}}},
          {"lanes", {{"alone", {{"method", "local_ekf"}}}}}};
}

TEST(LinearPlant, InContinuousTimeIsHeldForATick) {
  const LinearModel model = linear_model(*plant_of({{"A", kA}, {"B", kB}, {"time", "continuous"}}, 0.3));
  const Held held = zero_order_hold(Eigen::MatrixXd{{0, 1}, {-4, -0.4}}, Eigen::MatrixXd{{0}, {1}}, 0.3);
  EXPECT_EQ(model.A, held.A);
  EXPECT_EQ(model.B, held.B);
  const LinearModel ticks = linear_model(*plant_of({{"A", kA}, {"B", kB}}, 0.3));
  EXPECT_EQ(ticks.A, (Eigen::MatrixXd{{0, 1}, {-4, -0.4}}));
}

// Q is of a tick in both: the same noise is added to the same state.
TEST(LinearPlant, ARunInContinuousTimeIsTheRunOfItsTicks) {
  const Held held = zero_order_hold(Eigen::MatrixXd{{0, 1}, {-4, -0.4}}, Eigen::MatrixXd(2, 0), 0.1);
  const auto row = [&](int r) { return Json{held.A(r, 0), held.A(r, 1)}; };
  vigil::Run flow(Scenario::from_json(document_of({{"A", kA}, {"time", "continuous"}})), {3, nullptr, {}});
  vigil::Run ticks(Scenario::from_json(document_of({{"A", {row(0), row(1)}}})), {3, nullptr, {}});
  test::Capture left, right;
  test::run_to_end(flow, left);
  test::run_to_end(ticks, right);
  test::expect_same(flow, left, ticks, right, "");
}

TEST(LinearPlant, NamesStandInTheSignals) {
  const Json plant{{"A", kA}, {"B", kB}, {"states", {"p", "v"}}, {"inputs", {"force"}}};
  const vigil::Run run(Scenario::from_json(document_of(plant, {{"C", {{1, 0}}}, {"channels", {"position"}}})),
                       {1, nullptr, {}});
  for (const char* name : {"truth.p", "truth.v", "input.force", "sensor.1.position", "lane.alone.1.estimate.v"})
    EXPECT_GE(run.catalogue().find(name), 0) << name;
  EXPECT_EQ(run.catalogue().find("truth.x1"), -1);
  Json attacked = document_of(plant, {{"C", {{1, 0}}}, {"channels", {"position"}}});
  attacked["adversary"] = {{"b", {{"type", "bias"}, {"on", {"sensor:1.position"}}, {"params", {{"vector", {2}}}}}}};
  EXPECT_NO_THROW(vigil::Run(Scenario::from_json(attacked), {1, nullptr, {}}));
}

TEST(LinearPlant, WhatIsWrongIsNamed) {
  const std::string plant = "/plant/params", sensor = "/nodes/1/sensor/params";
  test::expect_refused(document_of({{"A", kA}, {"time", "sometimes"}}), plant + "/time");
  test::expect_refused(document_of({{"A", kA}, {"states", {"p"}}}), plant + "/states");
  test::expect_refused(document_of({{"A", kA}, {"states", {"p", "p"}}}), plant + "/states");
  test::expect_refused(document_of({{"A", kA}, {"states", {"p", "a name"}}}), plant + "/states");
  test::expect_refused(document_of({{"A", kA}, {"states", {"p", ""}}}), plant + "/states");
  test::expect_refused(document_of({{"A", kA}, {"states", {"p", 3}}}), plant + "/states");
  test::expect_refused(document_of({{"A", kA}, {"states", {"p", "a_name_that_is_longer"}}}), plant + "/states");
  test::expect_refused(document_of({{"A", kA}, {"inputs", {"u"}}}), plant + "/inputs");
  test::expect_refused(document_of({{"A", {{1e5, 0}, {0, 1}}}, {"time", "continuous"}}), plant + "/A");
  test::expect_refused(document_of({{"A", {{1, 0}}}}), plant + "/A");
  test::expect_refused(document_of({{"A", kA}, {"B", {{1}}}}), plant + "/B");
  test::expect_refused(document_of({{"A", kA}}, {{"C", {{1, 0}}}, {"channels", {"y", "z"}}}), sensor + "/channels");
  test::expect_refused(document_of({{"A", kA}}, {{"C", {{1, 0}}}, {"channels", {"state"}}}), sensor + "/channels");
  test::expect_refused(document_of({{"A", kA}}, {{"C", {{1, 0, 0}}}}), sensor + "/C");
  test::expect_refused(document_of({{"A", kA}}, {{"C", {{1, 0}}}, {"R", {1, 2}}}), sensor + "/R");
  test::expect_refused(document_of({{"A", kA}}, {{"C", {{1, 0}}}, {"Mv", {1, 2}}}), sensor + "/Mv");
}

}  // namespace
}  // namespace vigil::linear_test
