#include "engine/methods/privacy/contamination.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/bounded_sets.hpp"
#include "engine/methods/privacy/null_space.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy::contamination_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One tick of a contaminated fusion: covariances only.
struct Tick {
  std::vector<LocalGains> gains;
  Fusion nominal;
  MatrixXd P, Lam, Pe;
  VectorXd h;
  Legitimate user;
};

/// The contaminated fusion of `model` from its own start, ticks 1 to `last`.
std::vector<Tick> plan(const FusionModel& model, const std::vector<ComponentSet>& sets, Selection mode, int last) {
  const bool stationary = model.P0.size() == 0;
  const auto steps = local_steps(model);
  const MatrixXd Qb = model.noise();
  MatrixXd P = stationary ? stationary_filters(model)->P : common_start(model.P0, model.count());
  MatrixXd Lam = stationary ? *state_covariance(model) : MatrixXd(model.P0 + model.x0 * model.x0.transpose());
  Legitimate user = stationary ? legitimate_from(P, model.states()) : legitimate_start(model.P0, model.count());
  std::vector<Tick> ticks;
  for (int t = 1; t <= last; ++t) {
    auto gains = step_local(steps, Qb, P);
    Lam = (model.A * Lam * model.A.transpose() + Qb).eval();
    const Fusion nominal = fuse(P, model.states());
    const VectorXd h = kept(choose_set(sets, mode, nominal, P, Lam), model.stacked());
    step_legitimate(steps, *gains, Qb, P, model.A, h, user);
    ticks.push_back({*gains, nominal, P, Lam, eavesdropper_covariance(nominal, P, Lam, h), h, user});
  }
  return ticks;
}

std::vector<Tick> robot_plan(int m, Selection mode = Selection::norm) {
  const FusionModel model = linear_robot();
  return plan(model, bounded_sets(model, component_sets(4, m)), mode, 100);
}

void expect_near(double value, double expected, double relative) {
  EXPECT_NEAR(value, expected, relative * std::abs(expected));
}

TEST(PrivacyNullSpace, IsAProjectorOnWhatGDoesNotSee) {
  MatrixXd G(2, 5);
  G << 1, 2, 0, -1, 3, 0.5, 1, 0, -0.5, 1.5;  // rank 1
  const MatrixXd Pi = null_projector(G);
  EXPECT_EQ(numerical_rank(G), 1);
  EXPECT_LE((Pi * Pi - Pi).norm(), 1e-13);
  EXPECT_LE((G * Pi).norm(), 1e-13);
  EXPECT_NEAR(Pi.trace(), 4, 1e-13);
  EXPECT_LE((null_projector(MatrixXd::Zero(2, 3)) - MatrixXd::Identity(3, 3)).norm(), 0);
  EXPECT_LE(null_projector(MatrixXd::Identity(3, 3)).norm(), 1e-13);
}

TEST(PrivacyContamination, AdmissibleSetsOfTheLinearRobot) {
  const FusionModel model = linear_robot();
  using Sets = std::vector<ComponentSet>;
  EXPECT_EQ(bounded_sets(model, component_sets(4, 1)), (Sets{{0}, {1}, {2}, {3}}));
  EXPECT_EQ(bounded_sets(model, component_sets(4, 2)), (Sets{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
  EXPECT_EQ(bounded_sets(model, component_sets(4, 3)), (Sets{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_TRUE(bounded_sets(model, component_sets(4, 4)).empty());
}

// Section 2.5, figure 2-3: three components contaminated.
TEST(PrivacyContamination, TheLinearRobotWithThreeComponents) {
  const auto ticks = robot_plan(3);
  const auto set = [&](int t) { return ticks[static_cast<std::size_t>(t - 1)].h; };
  EXPECT_EQ(set(3), kept({1, 2, 3}, 4));
  EXPECT_EQ(set(4), kept({0, 1, 3}, 4));
  EXPECT_EQ(set(28), kept({0, 1, 3}, 4));
  EXPECT_EQ(set(29), kept({1, 2, 3}, 4));
  const Tick& last = ticks.back();
  EXPECT_EQ(last.h, kept({1, 2, 3}, 4));
  expect_near(last.user.S.topLeftCorner(2, 2).trace(), 1.948, 3e-4);
  expect_near(last.user.S.bottomRightCorner(2, 2).trace(), 3.021, 2e-4);
  expect_near(last.user.P.trace(), 0.9477, 6e-5);
  expect_near(last.Pe.trace(), 8.973e4, 6e-5);
  expect_near(ticks[9].Pe.trace(), 116.8, 5e-4);
  expect_near(ticks[19].Pe.trace(), 763.8, 7e-5);
  EXPECT_EQ(contamination_null_dim(last.nominal.W, last.h), 1);
  expect_near(robot_plan(3, Selection::exact)[9].Pe.trace(), 127.5, 4e-4);
}

TEST(PrivacyContamination, TheLinearRobotWithOneComponent) {
  const Tick last = robot_plan(1).back();
  EXPECT_EQ(last.h, kept({2}, 4));
  expect_near(last.user.S.topLeftCorner(2, 2).trace(), 0.7321, 7e-5);
  expect_near(last.user.S.bottomRightCorner(2, 2).trace(), 1.393, 4e-4);
  expect_near(last.user.P.trace(), 0.5841, 9e-5);
  expect_near(last.Pe.trace(), 8.955e4, 6e-5);
  EXPECT_EQ(contamination_null_dim(last.nominal.W, last.h), 0);
}

// Without the check the paper's rule takes both positions and the legitimate user drifts away.
TEST(PrivacyContamination, TheUnrestrictedRuleLosesThePosition) {
  const auto ticks = plan(linear_robot(), component_sets(4, 2), Selection::norm, 100);
  EXPECT_EQ(ticks.back().h, kept({0, 2}, 4));
  EXPECT_NEAR(ticks[9].user.P.trace(), 8.0, 0.051);
  EXPECT_NEAR(ticks[99].user.P.trace(), 81.3, 0.051);
}

// Section 4.7: the engine from its stationary start.
TEST(PrivacyContamination, TheEngine) {
  const FusionModel model = engine_model();
  const auto five = plan(model, component_sets(6, 5), Selection::norm, 100);
  const double legitimate[][2] = {{1, 0.01714},  {2, 0.02681},  {5, 0.05499},
                                  {10, 0.06897}, {20, 0.06989}, {100, 0.06943}};
  for (const auto& [t, trace] : legitimate)
    EXPECT_NEAR(five[static_cast<std::size_t>(t) - 1].user.P.trace(), trace, 6e-6);
  for (const Tick& tick : five) {
    EXPECT_EQ(tick.h, kept({1, 2, 3, 4, 5}, 6));
    EXPECT_NEAR(tick.Pe.trace(), 0.27385, 6e-6);
  }
  const auto four = plan(model, component_sets(6, 4), Selection::norm, 200);
  EXPECT_NEAR(four.back().user.P.trace(), 0.02067, 6e-6);
  EXPECT_NEAR(four.back().Pe.trace(), 0.1789, 6e-5);
  const auto one = plan(model, component_sets(6, 1), Selection::norm, 200);
  EXPECT_NEAR(one.back().user.P.trace(), 0.00745, 6e-6);
  EXPECT_NEAR(one.back().Pe.trace(), 0.1697, 6e-5);
}

TEST(PrivacyContamination, TheNormIsAHeuristic) {
  const FusionModel model = engine_model();
  const Tick norm = plan(model, component_sets(6, 3), Selection::norm, 1).back();
  EXPECT_EQ(norm.h, kept({3, 4, 5}, 6));
  EXPECT_NEAR(norm.Pe.trace(), 0.1813, 6e-5);
  const Tick exact = plan(model, component_sets(6, 3), Selection::exact, 1).back();
  EXPECT_EQ(exact.h, kept({1, 4, 5}, 6));
  EXPECT_NEAR(exact.Pe.trace(), 0.2709, 6e-5);
}

// Where a component is contaminated at both sensors the same prediction stands twice, so that S is singular.
TEST(PrivacyContamination, TheUsersWeightsSumToOneHoweverSingularItsCovariance) {
  const FusionModel robot = linear_robot(), engine = engine_model();
  for (const auto& [model, ticks] :
       {std::pair{robot, robot_plan(3)}, std::pair{engine, plan(engine, component_sets(6, 5), Selection::norm, 50)}}) {
    const MatrixXd e = stack(model.states(), 2);
    for (const Tick& tick : ticks) {
      EXPECT_TRUE(fuse(tick.user.S, model.states()).by_rule);
      EXPECT_LE((tick.user.Wf * e - e.topRows(model.states())).norm(), 1e-9);
      EXPECT_LE((tick.nominal.W * e - e.topRows(model.states())).norm(), 1e-9);
      for (const MatrixXd& P : {tick.user.S, tick.P, tick.user.P}) {
        const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(P, Eigen::EigenvaluesOnly);
        EXPECT_GE(eigen.eigenvalues()[0], -1e-12 * P.norm());
      }
    }
  }
}

TEST(PrivacyContamination, NoiseCountsOnlyInWhatIsKept) {
  const Tick tick = robot_plan(3).back();
  const Foresight none{.P = MatrixXd::Identity(2, 2), .X = MatrixXd::Zero(4, 2)};
  const MatrixXd noise = Eigen::Vector4d(1, 2, 3, 4).asDiagonal();
  Legitimate user;
  take_in(tick.P, none, VectorXd::Ones(4), noise, user);
  EXPECT_LE((user.P - fuse(tick.P + noise, 2).P).norm(), 1e-14);
  EXPECT_LE((user.X - user.Wf * tick.P).norm(), 1e-14);
  take_in(tick.P, none, kept({2, 3}, 4), noise, user);
  EXPECT_EQ(MatrixXd(user.S.bottomRightCorner(2, 2)), none.P);
}

TEST(PrivacyContamination, KeepsTheWorstKnownComponents) {
  const MatrixXd P = Eigen::Vector4d(3, 1, 2, 3).asDiagonal();
  EXPECT_EQ(choose_worst_known(component_sets(4, 2), P), (ComponentSet{1, 2}));
  const MatrixXd alike = MatrixXd::Identity(4, 4);
  EXPECT_EQ(choose_worst_known(component_sets(4, 2), alike), (ComponentSet{0, 1}));
}

// The noise is not seen through the nominal weights, and something of it is there where null_dim says so.
TEST(PrivacyContamination, TheNoisePassesTheNominalWeightsUnseen) {
  const Tick tick = robot_plan(3).back();
  const MatrixXd Pi = contamination_projector(tick.nominal.W, tick.h);
  const Draws draws(11, "contamination");
  const VectorXd xhat = Eigen::Vector4d(50, 1, 51, 1.1);
  for (std::int64_t t = 0; t < 50; ++t) {
    VectorXd a(4);
    draws.normals(t, a);
    const VectorXd sent = contaminate(xhat, tick.h, Pi, a);
    const VectorXd noise = sent - tick.h.cwiseProduct(xhat);
    EXPECT_GT(noise.norm(), 1e-6);
    EXPECT_LE((tick.nominal.W * noise).norm(), 1e-9 * noise.norm());
    const VectorXd compensated = compensate(sent, tick.h, Eigen::Vector2d(7, 8));
    EXPECT_LE((compensated - Eigen::Vector4d(50, 8, 7, 8)).norm(), 1e-12);
  }
}

TEST(PrivacyContamination, RefusesNumbersThatLeaveNoChoiceOrTooMuch) {
  EXPECT_THROW(component_sets(4, 5), InputError);
  EXPECT_THROW(component_sets(4, -1), InputError);
  EXPECT_THROW(component_sets(24, 12), InputError);
  EXPECT_EQ(component_sets(4, 0).size(), 1U);
  EXPECT_EQ(component_sets(6, 3).size(), 20U);
}

/// Squared errors of 100 runs of the linear robot with what `ticks` plans: fused, legitimate, eavesdropper.
struct Errors {
  double fused = 0, legitimate = 0, last_eavesdropper = 0;  ///< the first two averaged over ticks 81 to 100
};
Errors simulate(const FusionModel& model, const std::vector<Tick>& ticks, int runs) {
  Errors sum;
  for (int run = 0; run < runs; ++run) {
    const Draws draws(static_cast<std::uint64_t>(run), "plant");
    VectorXd z(8);
    draws.normals(0, z);
    VectorXd x = model.x0 + std::sqrt(0.1) * z.head(2), user = model.x0;
    VectorXd xhat = stack(2, 2) * model.x0;
    for (std::size_t t = 0; t < ticks.size(); ++t) {
      const Tick& tick = ticks[t];
      draws.normals(static_cast<std::int64_t>(t) + 1, z);
      x = model.A * x + model.B * z.head(1);
      for (int i = 0; i < 2; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const SensorModel& sensor = model.sensors[at];
        const VectorXd y = sensor.C * x + sensor.R.cwiseSqrt() * z.segment(1 + 2 * i, 2);
        const VectorXd ahead = model.A * xhat.segment(2 * i, 2);
        xhat.segment(2 * i, 2) = ahead + tick.gains[at].K * (y - sensor.C * ahead);
      }
      VectorXd a(4);
      draws.normals(static_cast<std::int64_t>(t) + 1000, a);
      const VectorXd sent = contaminate(xhat, tick.h, contamination_projector(tick.nominal.W, tick.h), a);
      user = tick.user.Wf * compensate(sent, tick.h, model.A * user);
      if (t + 20 >= ticks.size()) {
        sum.fused += (x - tick.nominal.W * xhat).squaredNorm() / 20 / runs;
        sum.legitimate += (x - user).squaredNorm() / 20 / runs;
      }
      if (t + 1 == ticks.size()) sum.last_eavesdropper += (x - tick.nominal.W * sent).squaredNorm() / runs;
    }
  }
  return sum;
}

TEST(PrivacyContamination, AHundredRunsAgreeWithTheCovariances) {
  const Errors errors = simulate(linear_robot(), robot_plan(3), 100);
  expect_near(errors.fused, 0.4348, 0.12);
  expect_near(errors.legitimate, 0.9477, 0.12);
  expect_near(errors.last_eavesdropper, 8.97e4, 0.45);
}

}  // namespace
}  // namespace vigil::privacy::contamination_test
