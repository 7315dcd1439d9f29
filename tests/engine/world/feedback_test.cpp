/// Linear feedback by the user's own gain.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "engine/world/controller.hpp"
#include "tests/engine/methods/rig.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::feedback_test {
namespace {

std::shared_ptr<const Plant> plant_of(const Json& A, const Json& B) {
  return Registry<PlantMake>::find("linear")->make(rig::completed<PlantMake>("linear", {{"A", A}, {"B", B}}), 1);
}

std::shared_ptr<const Controller> feedback(const Plant& plant, const Json& params) {
  return Registry<ControllerMake>::find("feedback")->make(rig::completed<ControllerMake>("feedback", params), plant);
}

std::string refusal(const Plant& plant, const Json& params) {
  try {
    feedback(plant, params);
  } catch (const InputError& error) {
    return error.problems().front().pointer;
  }
  return "accepted";
}

Eigen::VectorXd input(const Controller& controller, const double* estimate, int inputs) {
  Eigen::VectorXd u(inputs);
  controller.input(7, estimate, u);
  return u;
}

const Json kA{{1, 0.1}, {0, 1}}, kB{{0.005}, {0.1}};

TEST(Feedback, IsItsFormula) {
  const auto plant = plant_of({{1, 0.1}, {0, 1}}, {{1, 0}, {0.5, 2}});
  const auto controller = feedback(*plant, {{"K", {{1, 2}, {-3, 4}}}, {"x_ref", {5, -1}}, {"u_ref", {0.25, 10}}});
  const double estimate[] = {6, 1};
  const Eigen::VectorXd u = input(*controller, estimate, 2);
  EXPECT_DOUBLE_EQ(u[0], -(1 * 1 + 2 * 2) + 0.25);
  EXPECT_DOUBLE_EQ(u[1], -(-3 * 1 + 4 * 2) + 10);
  EXPECT_EQ(input(*controller, nullptr, 2), Eigen::Vector2d(0.25, 10)) << "without an estimate: the reference alone";
}

// A double integrator, poles placed at 0.8 and 0.9 by hand: z^2 - (2 - a) z + 1 - a + b with a = 0.1 k2 + 0.005 k1,
// b = 0.01 k1.
TEST(Feedback, SaysTheClosedLoopsPoles) {
  const double k1 = 2, a = 2 - 1.7, k2 = (a - 0.005 * k1) / 0.1;
  const auto controller = feedback(*plant_of(kA, kB), {{"K", {{k1, k2}}}});
  const Json design = controller->design();
  std::vector<double> poles;
  for (const Json& pole : design["poles"]) {
    EXPECT_NEAR(pole["im"].get<double>(), 0, 1e-9);
    poles.push_back(pole["re"]);
  }
  std::sort(poles.begin(), poles.end());
  ASSERT_EQ(poles.size(), 2u);
  EXPECT_NEAR(poles[0], 0.8, 1e-9);
  EXPECT_NEAR(poles[1], 0.9, 1e-9);
  EXPECT_NEAR(design["spectral_radius"].get<double>(), 0.9, 1e-9);
  EXPECT_EQ(design["stable"], true);
  EXPECT_EQ(design["K"], (Json{{k1, k2}}));
  EXPECT_TRUE(controller->warnings().empty());
}

TEST(Feedback, AnUnstableLoopIsAWarningOfTheRun) {
  Json document{{"vigil", 1},
                {"id", "mine"},
                {"time", {{"dt", 1}, {"steps", 3000}}},
                {"plant", {{"type", "linear"}, {"params", {{"A", kA}, {"B", kB}}}}},
                {"controller", {{"type", "feedback"}, {"params", {{"K", {{-100, 0}}}}}}},
                {"nodes", {{"1", {{"sensor", {{"type", "linear"}, {"params", {{"C", {{1, 0}}}}}}}}}}},
                {"initial", {{"truth", {1, 0}}}},
                {"lanes", {{"alone", {{"method", "local_ekf"}}}}}};
  vigil::Run run(Scenario::from_json(document), {1, nullptr, {}});
  ASSERT_EQ(run.warnings().size(), 1u);
  EXPECT_NE(run.warnings()[0].find("spectral radius is 2.2"), std::string::npos) << run.warnings()[0];
  test::Capture capture;
  test::run_to_end(run, capture);
  ASSERT_EQ(run.faults().size(), 1u) << "it diverges, and ends with a name for it";
  EXPECT_EQ(run.faults()[0].code, "diverged");
  for (const Frame& frame : capture.frames) {
    for (const double value : frame.values) EXPECT_FALSE(std::isinf(value)) << frame.k;
  }
}

// What a stable loop does to a plant that is not: the truth is held at the reference.
TEST(Feedback, HoldsThePlantAtItsReference) {
  Json document{{"vigil", 1},
                {"id", "mine"},
                {"time", {{"dt", 0.1}, {"steps", 400}}},
                {"plant", {{"type", "linear"}, {"params", {{"A", kA}, {"B", kB}}}}},
                {"controller", {{"type", "feedback"}, {"params", {{"K", {{2, 2.9}}}, {"x_ref", {3, 0}}}}}},
                {"nodes", {{"1", {{"sensor", {{"type", "linear"}, {"params", {{"C", {{1, 0}}}, {"R", 1e-8}}}}}}}}},
                {"noise", {{"Q", 1e-10}, {"P0", 0.01}}},
                {"initial", {{"truth", {-1, 0.5}}}},
                {"lanes", {{"alone", {{"method", "local_ekf"}}}}}};
  vigil::Run run(Scenario::from_json(document), {1, nullptr, {}});
  EXPECT_TRUE(run.warnings().empty());
  test::Capture capture;
  test::run_to_end(run, capture);
  const int x1 = run.catalogue().find("lane.alone.truth.x1");
  ASSERT_GE(x1, 0);
  EXPECT_NEAR(capture.frames.front().values[static_cast<std::size_t>(x1)], -1, 1e-12);
  EXPECT_NEAR(capture.frames.back().values[static_cast<std::size_t>(x1)], 3, 0.01);
}

TEST(Feedback, WrongSizesAreRefused) {
  const auto plant = plant_of(kA, kB);
  EXPECT_EQ(refusal(*plant, {{"K", {{1}, {2}}}}), "/K");
  EXPECT_EQ(refusal(*plant, {{"K", {{1, 2, 3}}}}), "/K");
  EXPECT_EQ(refusal(*plant, {{"K", 1}}), "/K");
  EXPECT_EQ(refusal(*plant, {{"K", {{1e308, 1e308}}}}), "accepted");
  EXPECT_EQ(refusal(*plant_of(kA, {{1e10}, {1e10}}), {{"K", {{1e308, 1e308}}}}), "/K");
  EXPECT_EQ(refusal(*plant, {{"K", {{1, 2}}}, {"x_ref", {1, 2, 3}}}), "/x_ref");
  EXPECT_EQ(refusal(*plant, {{"K", {{1, 2}}}, {"u_ref", {1, 2}}}), "/u_ref");
  EXPECT_EQ(refusal(*plant, Json::object()), "/K");
  const auto without = Registry<PlantMake>::find("linear")->make(rig::completed<PlantMake>("linear", {{"A", kA}}), 1);
  EXPECT_EQ(refusal(*without, {{"K", {{1, 2}}}}), "/");
}

}  // namespace
}  // namespace vigil::feedback_test
