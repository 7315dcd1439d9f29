// The fusion lane against the specification's numbers, sections 2.5, 2.6 and 4.7, and what may and may not reach whom.
#include <cmath>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/centre.hpp"
#include "engine/methods/privacy/lmv_fusion.hpp"
#include "tests/engine/allocations.hpp"
#include "tests/engine/methods/privacy/fusion_rig.hpp"

namespace vigil::fusion_lane_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Traces {
  double legitimate = 0, optimal = 0, eavesdropper = 0, compensated[2] = {}, local[2] = {};
};

/// Traces at every tick of one run, from 0 on.
std::vector<Traces> traces_of(Knowledge known, const char* filter, const std::string& protection, const Json& params,
                              std::int64_t last) {
  const VectorXd truth = rig::start(known, 1);
  if (!protection.empty()) known.protection = rig::protect(known, protection, params);
  const auto lane = rig::fusion_lane(known, filter);
  std::vector<Traces> traces;
  const int n = known.plant->states();
  rig::drive(*lane, known, truth, last, 1, {},
             [&](std::int64_t, const VectorXd&, const Method& method, const MatrixXd&) {
               const FusionMethod& fusion = *method.fusion();
               Traces at{fusion.legitimate_trace(),
                         fusion.optimal_trace(),
                         fusion.protection().eavesdropper_trace(fusion.public_tick(), "fusing"),
                         {},
                         {}};
               for (int i = 0; i < 2; ++i) {
                 at.compensated[i] = fusion.compensated_trace(i);
                 at.local[i] = rig::bound(method, i, n).trace();
               }
               EXPECT_NEAR(rig::bound(method, 2, n).trace(), at.legitimate, 1e-12 * at.legitimate);
               traces.push_back(at);
             });
  return traces;
}

void expect_near(double value, double expected, double relative) {
  EXPECT_NEAR(value, expected, relative * std::abs(expected));
}

TEST(FusionLane, TheLinearRobotContaminated) {
  const Knowledge known = rig::knowledge_of_model(privacy::linear_robot());
  for (const char* filter : {"time_varying", "extended"}) {
    const auto traces = traces_of(known, filter, "contamination", {{"m", 3}}, 100);
    const Traces& last = traces[100];
    expect_near(last.optimal, 0.4348, 2e-4);
    expect_near(last.local[0], 0.7321, 7e-5);
    expect_near(last.local[1], 0.8032, 7e-5);
    expect_near(last.compensated[0], 1.948, 3e-4);
    expect_near(last.compensated[1], 3.021, 2e-4);
    expect_near(last.legitimate, 0.9477, 6e-5);
    expect_near(last.eavesdropper, 8.973e4, 6e-5);
    expect_near(traces[10].eavesdropper, 116.8, 5e-4);
    expect_near(traces[20].eavesdropper, 763.8, 7e-5);
    expect_near(traces[0].legitimate, 0.2, 1e-12);
    EXPECT_TRUE(std::isnan(traces[0].compensated[0]));
  }
  const Traces last = traces_of(known, "time_varying", "contamination", {{"m", 1}}, 100)[100];
  expect_near(last.compensated[0], 0.7321, 7e-5);
  expect_near(last.compensated[1], 1.393, 4e-4);
  expect_near(last.legitimate, 0.5841, 9e-5);
  expect_near(last.eavesdropper, 8.955e4, 6e-5);
  expect_near(traces_of(known, "time_varying", "contamination", {{"m", 3}, {"mode", "exact"}}, 10)[10].eavesdropper,
              127.5, 4e-4);
}

TEST(FusionLane, TheEngineContaminatedFromItsStationaryStart) {
  const Knowledge known = rig::knowledge_of_model(privacy::engine_model());
  for (const char* filter : {"stationary", "time_varying"}) {
    const auto traces = traces_of(known, filter, "contamination", {{"m", 5}}, 200);
    const double legitimate[][2] = {{0, 0.0071039}, {1, 0.01714},  {2, 0.02681},  {5, 0.05499},
                                    {10, 0.06897},  {20, 0.06989}, {100, 0.06943}};
    for (const auto& [t, trace] : legitimate) EXPECT_NEAR(traces[static_cast<std::size_t>(t)].legitimate, trace, 6e-6);
    EXPECT_NEAR(traces[0].eavesdropper, 0.0071039, 6e-8);  // nothing is contaminated yet
    for (std::size_t t = 1; t <= 200; ++t) EXPECT_NEAR(traces[t].eavesdropper, 0.27385, 6e-6);
    EXPECT_NEAR(traces[200].legitimate, 0.06942, 6e-6);
  }
  const Traces four = traces_of(known, "stationary", "contamination", {{"m", 4}}, 200).back();
  EXPECT_NEAR(four.legitimate, 0.02067, 6e-6);
  EXPECT_NEAR(four.eavesdropper, 0.1789, 6e-5);
}

TEST(FusionLane, UnprotectedTheUserHasTheOptimum) {
  Knowledge known = rig::knowledge_of_model(privacy::engine_model());
  const VectorXd truth = rig::start(known, 4);
  const auto lane = rig::fusion_lane(known, "stationary");
  rig::drive(
      *lane, known, truth, 60, 4, {}, [&](std::int64_t, const VectorXd&, const Method& method, const MatrixXd& sent) {
        const FusionMethod& fusion = *method.fusion();
        EXPECT_EQ(fusion.optimal(), rig::mean(method, 2, 3));
        EXPECT_EQ(sent.col(0), rig::mean(method, 0, 3));
        EXPECT_NEAR(fusion.legitimate_trace(), 0.0071039, 5.1e-8);
        EXPECT_EQ(fusion.protection().eavesdropper_trace(fusion.public_tick(), "fusing"), fusion.optimal_trace());
        EXPECT_NEAR(fusion.protection().eavesdropper_trace(fusion.public_tick(), "zero"), 0.26958, 5.1e-6);
        EXPECT_EQ(fusion.compensated(0), nullptr);
      });
}

TEST(FusionLane, TheWeightsOfACommonStartAreEqual) {
  const Knowledge known = rig::knowledge_of_model(privacy::linear_robot());
  const auto lane = rig::fusion_lane(known, "time_varying");
  const auto& tick = lane->fusion()->public_tick();
  EXPECT_LE((tick.nominal.W - privacy::stack(2, 2).transpose() / 2).norm(), 1e-12);
  EXPECT_LE((tick.nominal.P - known.P0).norm(), 1e-12);
}

TEST(FusionLane, SeparateGuessesHaveSeparateErrors) {
  Knowledge known = rig::knowledge_of_model(privacy::linear_robot());
  known.estimates.col(1) += Eigen::Vector2d(0.1, -0.2);
  const auto lane = rig::fusion_lane(known, "time_varying");
  const MatrixXd& P = lane->fusion()->public_tick().P;
  EXPECT_EQ(MatrixXd(P.topRightCorner(2, 2)), MatrixXd::Zero(2, 2));
  EXPECT_NEAR(lane->fusion()->optimal_trace(), known.P0.trace() / 2, 1e-12);
}

TEST(FusionLane, ACopyGoesOnAsTheLaneDoes) {
  Knowledge known = rig::knowledge_of_robot();
  const VectorXd start = rig::start(known, 2);
  known.protection = rig::protect(known, "contamination", {{"m", 4}});
  const auto lane = rig::fusion_lane(known, "extended");
  std::unique_ptr<Method> copy;
  std::vector<Delivery> inbox(2, {.lost = false, .flagged = false, .payload = VectorXd::Zero(3)});
  FaultTable faults;
  const auto tick = [&](Method& method, const Readings& readings) {
    method.predict(VectorXd(0), faults);
    method.measure(readings, faults);
    for (int i = 0; i < 2; ++i) method.send(i, inbox[static_cast<std::size_t>(i)].payload);
    method.update(readings, inbox, faults);
    return rig::mean(method, 2, 3);
  };
  rig::drive(*lane, known, start, 9, 2, {}, [&](std::int64_t k, const VectorXd& truth, const Method&, const MatrixXd&) {
    if (k < 9) return;
    copy = lane->clone();
    for (std::int64_t later = 10; later < 14; ++later) {
      const Readings readings = rig::readings_at(known, truth, 2, later);
      EXPECT_EQ(tick(*lane, readings), tick(*copy, readings));
      EXPECT_EQ(inbox[0].payload.size(), 3);
    }
  });
  EXPECT_EQ(copy->fusion()->optimal(), lane->fusion()->optimal());
}

TEST(FusionLane, AnglesAreFusedOnOneTurn) {
  VectorXd estimate = Eigen::Vector2d(-3.1, -3.1);
  privacy::to_turn_of(Eigen::Vector2d(3.1, 3.1), {0, 2 * std::acos(-1.0)}, estimate);
  EXPECT_EQ(estimate[0], -3.1);
  EXPECT_NEAR(estimate[1], 2 * std::acos(-1.0) - 3.1, 1e-12);
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(FusionLane, ASettledTickAllocatesNothing) {
  for (const char* protection : {"", "contamination", "complex_noise"}) {
    Knowledge known = rig::knowledge_of_model(privacy::engine_model());
    const VectorXd truth = rig::start(known, 1);
    if (*protection) known.protection = rig::protect(known, protection);
    const auto lane = rig::fusion_lane(known, "stationary");
    rig::drive(*lane, known, truth, 1500, 1, {}, [](std::int64_t, const VectorXd&, const Method&, const MatrixXd&) {});
    const Readings readings = rig::readings_at(known, truth, 1, 1501);
    const VectorXd input(0);
    std::vector<Delivery> inbox(2, {.lost = false, .flagged = false, .payload = VectorXd::Zero(3)});
    FaultTable faults;
    EXPECT_EQ(allocations_in([&] {
                lane->predict(input, faults);
                lane->measure(readings, faults);
                for (int i = 0; i < 2; ++i) lane->send(i, inbox[static_cast<std::size_t>(i)].payload);
                lane->update(readings, inbox, faults);
              }),
              0)
        << protection;
  }
}
#endif

}  // namespace
}  // namespace vigil::fusion_lane_test
