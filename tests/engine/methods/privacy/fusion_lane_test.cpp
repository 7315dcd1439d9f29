// The fusion lane against the specification's numbers, sections 2.5, 2.6 and 4.7, and what may and may not reach whom.
#include <cmath>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/lmv_fusion.hpp"
#include "tests/engine/allocations.hpp"
#include "tests/engine/methods/privacy/fusion_rig.hpp"

namespace vigil {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using privacy::FusionModel;
using rig::Sample;

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

/// Squared errors of many runs of the linear robot at some ticks, against the traces of those ticks.
struct Curves {
  Sample legitimate, optimal, eavesdropper;
  Traces expected;
};
Curves simulate(const FusionModel& model, const char* filter, const std::string& protection, const Json& params,
                std::int64_t at, int runs, const rig::Events& events) {
  Curves curves;
  for (int run = 1; run <= runs; ++run) {
    Knowledge known = rig::knowledge_of_model(model);
    const auto seed = static_cast<std::uint64_t>(run);
    known.seed = seed;
    const VectorXd start = rig::start(known, seed);
    if (!protection.empty()) known.protection = rig::protect(known, protection, params);
    const auto lane = rig::fusion_lane(known, filter);
    const auto eve = lane->fusion()->protection().eavesdropper("fusing");
    const std::vector<char> heard(2, 1);
    rig::drive(*lane, known, start, at, seed, events,
               [&](std::int64_t k, const VectorXd& truth, const Method& method, const MatrixXd& sent) {
                 const FusionMethod& fusion = *method.fusion();
                 eve->listen(fusion.public_tick(), sent, heard);
                 if (k < at) return;
                 const auto n = static_cast<int>(truth.size());
                 curves.legitimate.add((truth - rig::mean(method, 2, n)).squaredNorm());
                 curves.optimal.add((truth - fusion.optimal()).squaredNorm());
                 curves.eavesdropper.add((truth - eve->estimate()).squaredNorm());
                 curves.expected = {fusion.legitimate_trace(),
                                    fusion.optimal_trace(),
                                    fusion.protection().eavesdropper_trace(fusion.public_tick(), "fusing"),
                                    {},
                                    {}};
               });
  }
  return curves;
}
void expect_agreement(const Curves& curves) {
  EXPECT_NEAR(curves.legitimate.mean(), curves.expected.legitimate, 4 * curves.legitimate.error());
  EXPECT_NEAR(curves.optimal.mean(), curves.expected.optimal, 4 * curves.optimal.error());
  EXPECT_NEAR(curves.eavesdropper.mean(), curves.expected.eavesdropper, 4 * curves.eavesdropper.error());
}

TEST(FusionLane, ManyRunsAgreeWithTheTraces) {
  expect_agreement(simulate(privacy::linear_robot(), "time_varying", "contamination", {{"m", 3}}, 30, 2000, {}));
  expect_agreement(simulate(privacy::engine_model(), "stationary", "contamination", {{"m", 5}}, 8, 2000, {}));
  expect_agreement(simulate(privacy::engine_model(), "stationary", "contamination", {{"m", 4}}, 20, 2000, {}));
}

// Lost messages, contaminated or not, are replaced by the prediction, and the covariance knows it.
TEST(FusionLane, LostMessagesArePredicted) {
  rig::Events lossy;
  lossy.lost = [](std::int64_t k, int node) { return (k * (3 + node) + k / 2 + node) % 5 < 2 || (k > 4 && k < 8); };
  for (const std::int64_t at : {0, 7, 12}) {
    for (const char* protection : {"", "contamination"}) {
      const Curves robot =
          simulate(privacy::linear_robot(), "time_varying", protection, Json::object(), at, 1500, lossy);
      EXPECT_NEAR(robot.legitimate.mean(), robot.expected.legitimate, 4 * robot.legitimate.error()) << at << protection;
      const Curves engine =
          simulate(privacy::engine_model(), "stationary", protection, Json::object(), at, 1500, lossy);
      EXPECT_NEAR(engine.legitimate.mean(), engine.expected.legitimate, 4 * engine.legitimate.error())
          << at << protection;
      if (at == 7) {
        EXPECT_GT(engine.expected.legitimate, 1.5 * engine.expected.optimal);
      }
    }
  }
}

// A sensor that gives nothing predicts; a stationary filter keeps its gain, and its covariance is then the real one.
TEST(FusionLane, JammedSensorsPredict) {
  rig::Events jam;
  jam.jammed = [](std::int64_t k, int node) { return node == 0 ? k > 5 && k < 12 : k == 9; };
  for (const std::int64_t at : {9, 14}) {
    expect_agreement(simulate(privacy::engine_model(), "stationary", "", Json::object(), at, 2000, jam));
    expect_agreement(simulate(privacy::linear_robot(), "time_varying", "", Json::object(), at, 2000, jam));
  }
  const auto settled = traces_of(rig::knowledge_of_model(privacy::engine_model()), "stationary", "", {}, 1);
  const Curves after = simulate(privacy::engine_model(), "stationary", "", Json::object(), 700, 1, jam);
  expect_near(after.expected.optimal, settled.back().optimal, 1e-9);
}

/// Averages over ticks 11 to 100 and over runs.
struct RobotErrors {
  double optimal = 0, legitimate = 0, eavesdropper = 0, compensated[2] = {};
};
RobotErrors robot_errors(int m, int runs) {
  RobotErrors errors;
  for (int run = 1; run <= runs; ++run) {
    Knowledge known = rig::knowledge_of_robot();
    const auto seed = static_cast<std::uint64_t>(run);
    known.seed = seed;
    const VectorXd start = rig::start(known, seed);
    known.protection = rig::protect(known, "contamination", {{"m", m}});
    const auto lane = rig::fusion_lane(known, "extended");
    const auto eve = lane->fusion()->protection().eavesdropper("fusing");
    const std::vector<char> heard(2, 1);
    rig::drive(*lane, known, start, 100, seed, {},
               [&](std::int64_t k, const VectorXd& truth, const Method& method, const MatrixXd& sent) {
                 const FusionMethod& fusion = *method.fusion();
                 eve->listen(fusion.public_tick(), sent, heard);
                 if (k < 11) return;
                 const double share = 1.0 / (90 * runs);
                 errors.optimal += share * (truth - fusion.optimal()).squaredNorm();
                 errors.legitimate += share * (truth - rig::mean(method, 2, 3)).squaredNorm();
                 errors.eavesdropper += share * (truth - eve->estimate()).squaredNorm();
                 for (int i = 0; i < 2; ++i)
                   errors.compensated[i] +=
                       share * (truth - Eigen::Map<const VectorXd>(fusion.compensated(i), 3)).squaredNorm();
               });
  }
  return errors;
}

TEST(FusionLane, TheNonlinearRobot) {
  const RobotErrors four = robot_errors(4, 100);
  EXPECT_NEAR(four.optimal, 0.042, 0.004);
  EXPECT_NEAR(four.legitimate, 0.13, 0.03);
  EXPECT_NEAR(four.compensated[0], 0.15, 0.03);
  EXPECT_NEAR(four.compensated[1], 0.14, 0.03);
  EXPECT_NEAR(four.eavesdropper, 660, 60);
  const RobotErrors two = robot_errors(2, 100);
  EXPECT_NEAR(two.legitimate, 0.050, 0.005);
  EXPECT_NEAR(two.eavesdropper, 9, 1);
  const RobotErrors three = robot_errors(3, 100);
  EXPECT_NEAR(three.legitimate, 0.060, 0.006);
  EXPECT_NEAR(three.eavesdropper, 455, 45);
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
}  // namespace vigil
