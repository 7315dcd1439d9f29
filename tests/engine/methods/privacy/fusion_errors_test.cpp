// Squared errors of many runs against the traces that go with them: sections 2.5, 2.6, 2.8, and what the specification
// leaves to us: lost messages, jammed sensors, noise that stays.
#include <cmath>

#include "engine/methods/privacy/lmv_fusion.hpp"
#include "tests/engine/methods/privacy/fusion_rig.hpp"

namespace vigil::fusion_errors_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using privacy::FusionModel;
using rig::Sample;

struct Traces {
  double legitimate = 0, optimal = 0, eavesdropper = 0;
};

/// Squared errors of many runs at one tick, against the traces of that tick.
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
    std::vector<char> heard(2);
    rig::drive(*lane, known, start, at, seed, events,
               [&](std::int64_t k, const VectorXd& truth, const Method& method, const MatrixXd& sent) {
                 const FusionMethod& fusion = *method.fusion();
                 for (int i = 0; i < 2; ++i) heard[static_cast<std::size_t>(i)] = fusion.protection().audible(i);
                 eve->listen(fusion.public_tick(), sent, heard);
                 if (k < at) return;
                 const auto n = static_cast<int>(truth.size());
                 curves.legitimate.add((truth - rig::mean(method, 2, n)).squaredNorm());
                 curves.optimal.add((truth - fusion.optimal()).squaredNorm());
                 curves.eavesdropper.add((truth - eve->estimate()).squaredNorm());
                 curves.expected = {fusion.legitimate_trace(), fusion.optimal_trace(),
                                    fusion.protection().eavesdropper_trace(fusion.public_tick(), "fusing")};
               });
  }
  return curves;
}
void expect_agreement(const Curves& curves) {
  EXPECT_NEAR(curves.legitimate.mean(), curves.expected.legitimate, 4 * curves.legitimate.error());
  EXPECT_NEAR(curves.optimal.mean(), curves.expected.optimal, 4 * curves.optimal.error());
  EXPECT_NEAR(curves.eavesdropper.mean(), curves.expected.eavesdropper, 4 * curves.eavesdropper.error());
}

TEST(FusionErrors, ManyRunsAgreeWithTheTraces) {
  expect_agreement(simulate(privacy::linear_robot(), "time_varying", "contamination", {{"m", 3}}, 30, 1000, {}));
  expect_agreement(simulate(privacy::engine_model(), "stationary", "contamination", {{"m", 5}}, 8, 1000, {}));
  expect_agreement(simulate(privacy::engine_model(), "stationary", "contamination", {{"m", 4}}, 20, 1000, {}));
}

// Section 2.8: only a channel that never lets anything through makes the error grow without end.
TEST(FusionErrors, ComplexNoiseLeavesABoundedErrorWhereSomethingIsDecoded) {
  const auto at_100 = [](const Json& params) {
    const Curves curves = simulate(privacy::linear_robot(), "time_varying", "complex_noise", params, 100, 1000, {});
    EXPECT_NEAR(curves.legitimate.mean(), 0.4348, 4 * curves.legitimate.error());
    return curves.eavesdropper;
  };
  EXPECT_NEAR(at_100({{"power", 1}}).mean(), 1.9, 0.5);
  EXPECT_NEAR(at_100({{"power", 5.6097}}).mean(), 46, 20);
  const Sample always = at_100({{"power", 1}, {"channel", "static"}});
  EXPECT_NEAR(always.mean(), 0.4348, 4 * always.error());
  const Sample never = at_100({{"power", 5.6097}, {"channel", "static"}});
  EXPECT_NEAR(never.mean(), 3.3e5, 4 * never.error());
}

// Noise that the centre knows of and cannot take off again.
TEST(FusionErrors, NoiseOnTheMessagesIsInTheCovariance) {
  const Json variance = {{"variance", 0.05}};
  for (const std::int64_t at : {0, 1, 20}) {
    expect_agreement(simulate(privacy::engine_model(), "stationary", "gaussian_noise", variance, at, 1000, {}));
    expect_agreement(simulate(privacy::linear_robot(), "time_varying", "gaussian_noise", variance, at, 1000, {}));
  }
}

// Lost messages, contaminated or not, are replaced by the prediction, and the covariance knows it.
TEST(FusionErrors, LostMessagesArePredicted) {
  rig::Events lossy;
  lossy.lost = [](std::int64_t k, int node) { return (k * (3 + node) + k / 2 + node) % 5 < 2 || (k > 4 && k < 8); };
  for (const std::int64_t at : {0, 7, 12}) {
    for (const char* protection : {"", "contamination", "gaussian_noise"}) {
      const Curves robot =
          simulate(privacy::linear_robot(), "time_varying", protection, Json::object(), at, 800, lossy);
      EXPECT_NEAR(robot.legitimate.mean(), robot.expected.legitimate, 4 * robot.legitimate.error()) << at << protection;
      const Curves engine = simulate(privacy::engine_model(), "stationary", protection, Json::object(), at, 800, lossy);
      EXPECT_NEAR(engine.legitimate.mean(), engine.expected.legitimate, 4 * engine.legitimate.error())
          << at << protection;
      if (at == 7) {
        EXPECT_GT(engine.expected.legitimate, 1.5 * engine.expected.optimal);
      }
    }
  }
}

// A sensor that gives nothing predicts; a stationary filter keeps its gain, and its covariance is then the real one.
TEST(FusionErrors, JammedSensorsPredict) {
  rig::Events jam;
  jam.jammed = [](std::int64_t k, int node) { return node == 0 ? k > 5 && k < 12 : k == 9; };
  for (const std::int64_t at : {9, 14}) {
    expect_agreement(simulate(privacy::engine_model(), "stationary", "", Json::object(), at, 1000, jam));
    expect_agreement(simulate(privacy::linear_robot(), "time_varying", "", Json::object(), at, 1000, jam));
  }
  const Curves after = simulate(privacy::engine_model(), "stationary", "", Json::object(), 700, 1, jam);
  const MatrixXd settled = privacy::stationary_filters(privacy::engine_model())->P;
  const double optimum = privacy::fuse(settled, 3).P.trace();
  EXPECT_NEAR(after.expected.optimal, optimum, 1e-9 * optimum);
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

TEST(FusionErrors, TheNonlinearRobot) {
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

}  // namespace
}  // namespace vigil::fusion_errors_test
