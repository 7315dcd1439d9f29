#include "engine/methods/privacy/local_filters.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "engine/linalg/covariance.hpp"
#include "engine/methods/privacy/landmark_robot.hpp"
#include "engine/methods/privacy/lmv_fusion.hpp"

namespace vigil::privacy::local_filters_test {
namespace {

using Eigen::MatrixXd;

// All 24 numbers of (4-33), to the digits printed.
TEST(PrivacyFilters, TheEnginesGainsAndWeightsAreThePrintedOnes) {
  const FusionModel model = engine_model();
  const auto filters = stationary_filters(model);
  ASSERT_TRUE(filters);
  const Eigen::Vector3d K1(0.0284, 0.3230, -0.0979), K2(0.0648, 0.4443, -0.1578);
  EXPECT_LE((filters->gains[0].K - K1).cwiseAbs().maxCoeff(), 5.1e-5);
  EXPECT_LE((filters->gains[1].K - K2).cwiseAbs().maxCoeff(), 5.1e-5);
  MatrixXd W(3, 6);
  W << .1874, .0017, .0009, .8126, -.0017, -.0009,  //
      .1566, .2146, .1219, -.1566, .7854, -.1219,   //
      -.0329, -.0067, .1620, .0329, .0067, .8380;
  const Fusion fusion = fuse(filters->P, 3);
  EXPECT_FALSE(fusion.by_rule);
  EXPECT_LE((fusion.W - W).cwiseAbs().maxCoeff(), 5.1e-5);
  EXPECT_NEAR(fusion.P.trace(), 0.0071039, 5.1e-8);
  EXPECT_NEAR(filters->P.topLeftCorner(3, 3).trace(), 0.020670, 5.1e-7);
  EXPECT_NEAR(filters->P.bottomRightCorner(3, 3).trace(), 0.0078427, 5.1e-8);
  EXPECT_NEAR(state_covariance(model)->trace(), 0.26958, 5.1e-6);
}

TEST(PrivacyFilters, TheTurningTargetsTraces) {
  const auto filters = stationary_filters(turning_target());
  ASSERT_TRUE(filters);
  EXPECT_NEAR(filters->P.topLeftCorner(4, 4).trace(), 0.1074, 5.1e-5);
  EXPECT_NEAR(filters->P.bottomRightCorner(4, 4).trace(), 0.1023, 5.1e-5);
  EXPECT_NEAR(fuse(filters->P, 4).P.trace(), 0.06415, 5.1e-6);
}

TEST(PrivacyFilters, TheLinearRobotAtAHundred) {
  const FusionModel model = linear_robot();
  const auto steps = local_steps(model);
  MatrixXd P = common_start(model.P0, 2);
  for (int t = 1; t <= 100; ++t) {
    ASSERT_TRUE(step_local(steps, model.noise(), P));
    EXPECT_GE(least_eigenvalue(P), -1e-12 * P.norm());
  }
  EXPECT_NEAR(P.topLeftCorner(2, 2).trace(), 0.7321, 5.1e-5);
  EXPECT_NEAR(P.bottomRightCorner(2, 2).trace(), 0.8032, 5.1e-5);
  const Fusion fusion = fuse(P, 2);
  EXPECT_NEAR(fusion.P.trace(), 0.4348, 5.1e-5);
  MatrixXd W(2, 4);
  W << 0.4901, 0.0291, 0.5099, -0.0291, -0.0080, 0.5721, 0.0080, 0.4279;
  EXPECT_LE((fusion.W - W).cwiseAbs().maxCoeff(), 5.1e-5);
}

// The stationary solution is where the recursion ends, cross-covariances included.
TEST(PrivacyFilters, TheRecursionEndsAtTheStationaryLaw) {
  for (const FusionModel& model : {linear_robot(), turning_target(), engine_model()}) {
    const auto filters = stationary_filters(model);
    ASSERT_TRUE(filters);
    const auto steps = local_steps(model);
    MatrixXd P = common_start(0.1 * MatrixXd::Identity(model.states(), model.states()), model.count());
    std::optional<std::vector<LocalGains>> gains;
    for (int t = 1; t <= 1500; ++t) gains = step_local(steps, model.noise(), P);
    EXPECT_LE((P - filters->P).norm(), 1e-10 * P.norm());
    EXPECT_LE(((*gains)[1].K - filters->gains[1].K).norm(), 1e-10);
    EXPECT_GE(least_eigenvalue(filters->P), 0);
  }
}

TEST(PrivacyFilters, RefuseASensorThatCannotSeeTheTarget) {
  FusionModel model = linear_robot();
  model.sensors[1].C = Eigen::RowVector2d(0, 1);  // the position drifts unseen
  model.sensors[1].R = MatrixXd::Identity(1, 1);
  EXPECT_FALSE(stationary_filters(model));
  EXPECT_FALSE(state_covariance(model));
}

TEST(PrivacyFilters, AStraightTurnIsTheLimit) {
  EXPECT_LE((turning_target(1e-10).A - turning_target(1e-6).A).norm(), 1e-5);
}

TEST(PrivacyFusion, WeightsSumToOneAndNoOthersDoBetter) {
  const auto filters = stationary_filters(engine_model());
  const Fusion fusion = fuse(filters->P, 3);
  const MatrixXd e = stack(3, 2);
  EXPECT_LE((fusion.W * e - MatrixXd::Identity(3, 3)).norm(), 1e-12);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      MatrixXd other = fusion.W;
      other(row, column) += 1e-3;
      other(row, column + 3) -= 1e-3;
      EXPECT_GT((other * filters->P * other.transpose()).trace(), fusion.P.trace());
    }
  }
}

TEST(PrivacyFusion, IdenticalEstimatesAreAveraged) {
  const MatrixXd P0 = Eigen::Vector2d(0.3, 2).asDiagonal();
  const Fusion fusion = fuse(common_start(P0, 3), 2);
  EXPECT_TRUE(fusion.by_rule);
  EXPECT_LE((fusion.W - stack(2, 3).transpose() / 3).norm(), 1e-12);
  EXPECT_LE((fusion.P - P0).norm(), 1e-12);
  const Fusion known = fuse(MatrixXd::Zero(4, 4), 2);
  EXPECT_LE((known.W * stack(2, 2) - MatrixXd::Identity(2, 2)).norm(), 1e-12);
  EXPECT_EQ(known.P.norm(), 0);
}

// A singular covariance is the limit of regular ones: the fused variance is theirs.
TEST(PrivacyFusion, TheSingularRuleIsTheLimit) {
  MatrixXd root(4, 3);
  root << 1, 0.2, 0, 0.3, 1, 0.1, 0, 0.5, 2, 0.3, 1, 0.1;  // rows 2 and 4 alike: one error in both estimates
  const MatrixXd P = root * root.transpose();
  const Fusion singular = fuse(P, 2), regular = fuse(P + 1e-8 * MatrixXd::Identity(4, 4), 2);
  EXPECT_TRUE(singular.by_rule);
  EXPECT_FALSE(regular.by_rule);
  EXPECT_LE((singular.P - regular.P).norm(), 1e-6 * regular.P.norm());
  EXPECT_LE((singular.W * stack(2, 2) - MatrixXd::Identity(2, 2)).norm(), 1e-10);
}

TEST(PrivacyRobot, JacobiansAreTheDerivatives) {
  const LandmarkRobot robot;
  const Eigen::Vector3d x(3, -2, 0.7);
  const double h = 1e-6;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d up = x + h * Eigen::Vector3d::Unit(c), down = x - h * Eigen::Vector3d::Unit(c);
    EXPECT_LE(((robot.move(up) - robot.move(down)) / (2 * h) - robot.move_jacobian(x).col(c)).norm(), 1e-8);
    for (std::size_t sensor = 0; sensor < 2; ++sensor) {
      const Eigen::VectorXd slope = (robot.observe(sensor, up) - robot.observe(sensor, down)) / (2 * h);
      EXPECT_LE((slope - robot.observe_jacobian(sensor, x).col(c)).norm(), 1e-7);
    }
  }
}

TEST(PrivacyRobot, BearingsWrapAndALandmarkUnderfootIsFinite) {
  const LandmarkRobot robot;
  const Eigen::Vector3d x(1, 2, 40);  // several turns
  const Eigen::VectorXd y = robot.observe(0, x);
  EXPECT_LE(std::abs(y[1]), 3.1415927);
  EXPECT_LE(robot.innovation(0, y, x - Eigen::Vector3d(0, 0, 8 * std::acos(-1.0))).norm(), 1e-12);
  EXPECT_TRUE(robot.observe_jacobian(0, Eigen::Vector3d(-30, -20, 0)).allFinite());
}

}  // namespace
}  // namespace vigil::privacy::local_filters_test
