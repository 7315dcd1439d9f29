#include "engine/identify/arx.hpp"

#include <cmath>
#include <limits>

#include "engine/core/input_error.hpp"
#include "engine/identify/choose.hpp"
#include "engine/identify/state_space.hpp"
#include "tests/engine/identify/systems.hpp"

namespace vigil::identify::arx_test {
namespace {

using test::recorded;
using test::two_tanks;

// Each weight's standard error is at most deviation / (standard deviation of its regressor, given the others, times
// sqrt(rows)); 0.05 / (0.1 * sqrt(4000)) = 0.008 with the least such deviation here: five of them.
TEST(Arx, RecoversAKnownSystem) {
  for (const int lag : {0, 1}) {
    const Arx truth = two_tanks(lag);
    const Arx found = fit(recorded(truth, 4000, 0.05, 7), 0, 4000, 1, lag);
    EXPECT_LT((found.A[0] - truth.A[0]).cwiseAbs().maxCoeff(), 0.04) << lag;
    EXPECT_LT((found.B - truth.B).cwiseAbs().maxCoeff(), 0.04) << lag;
    EXPECT_LT((found.c - truth.c).cwiseAbs().maxCoeff(), 0.2) << lag;
    EXPECT_EQ(found.radius, found.fitted_radius);
    EXPECT_EQ(found.loss, 1);
  }
}

TEST(Arx, IsExactWithoutNoiseAndSkipsWhatIsMissing) {
  const Arx truth = two_tanks();
  Records records = recorded(truth, 200, 0, 7);
  records.outputs(50, 0) = std::nan("");
  records.inputs(90, 1) = std::nan("");
  const Arx found = fit(records, 0, 200, 1, 0);
  EXPECT_LT((found.A[0] - truth.A[0]).norm(), 1e-8);
  EXPECT_LT((found.B - truth.B).norm(), 1e-8);
  const Eigen::MatrixXd left = residuals(found, records);
  EXPECT_FALSE(left.row(0).allFinite());
  EXPECT_FALSE(left.row(51).allFinite()) << "its past is missing";
  EXPECT_TRUE(left.row(52).allFinite());
  EXPECT_FALSE(left.row(90).allFinite());
  EXPECT_LT(left.row(120).norm(), 1e-8);
}

TEST(Arx, PolesOfACompanionAreTheRoots) {
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  EXPECT_NEAR(spectral_radius({one(1.1), one(-0.3)}), 0.6, 1e-12) << "z² - 1.1 z + 0.3 = (z - 0.5)(z - 0.6)";
  EXPECT_NEAR(spectral_radius({one(0), one(-0.49)}), 0.7, 1e-12) << "a pair on the imaginary axis";
}

// y rises to about 200 (e - 1) = 344 with a spread of about 100, so shrinking the pole by 1.5e-3 adds about 0.15² =
// 0.02 to a unit square.
TEST(Arx, ProjectsWhatIsBarelyUnstable) {
  Arx truth;
  truth.A = {Eigen::MatrixXd::Constant(1, 1, 1.0005)};
  truth.B = Eigen::MatrixXd(1, 0);
  truth.c = Eigen::VectorXd::Constant(1, 0.1);
  const Arx found = fit(recorded(truth, 2000, 1, 3), 0, 2000, 1, 0);
  EXPECT_GT(found.fitted_radius, 0.9995);
  EXPECT_NEAR(found.radius, kLargestRadius, 1e-12);
  EXPECT_GT(found.loss, 1);
  EXPECT_LT(found.loss, 1.1);
}

TEST(Arx, RefusesAPlantThatGrows) {
  Arx truth;
  truth.A = {Eigen::MatrixXd::Constant(1, 1, 1.05)};
  truth.B = Eigen::MatrixXd(1, 0);
  truth.c = Eigen::VectorXd::Zero(1);
  const Records records = recorded(truth, 300, 1, 3);
  try {
    fit(records, 0, 300, 1, 0);
    ADD_FAILURE() << "it grows";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("spectral radius 1.05"), std::string::npos) << error.what();
  }
  EXPECT_THROW(choose(records, {}), InputError);
}

TEST(Arx, RefusesTooFewRowsAndWhatIsStill) {
  Records records = recorded(two_tanks(), 200, 0.1, 1);
  EXPECT_THROW(fit(records, 0, 14, 1, 0), InputError) << "13 rows for 5 weights";
  records.outputs.col(1).setConstant(4);
  EXPECT_THROW(fit(records, 0, 200, 1, 0), InputError);
}

TEST(Choose, FindsOrderAndLag) {
  Arx truth = two_tanks(1);
  EXPECT_EQ(choose(recorded(truth, 3000, 0.05, 2), {}).model.order(), 1);
  EXPECT_EQ(choose(recorded(truth, 3000, 0.05, 2), {}).model.lag, 1);
  truth = two_tanks(0);
  EXPECT_EQ(choose(recorded(truth, 3000, 0.05, 2), {}).model.lag, 0);
  truth.A = {(Eigen::MatrixXd(2, 2) << 0.5, 0, 0, 0.4).finished(),
             (Eigen::MatrixXd(2, 2) << 0.3, 0.1, 0, 0.4).finished()};
  const Choice two = choose(recorded(truth, 3000, 0.05, 2), {});
  EXPECT_EQ(two.model.order(), 2);
  EXPECT_EQ(two.tried.size(), 6u);
  for (const OutputFigures& figures : two.outputs) {
    EXPECT_NEAR(figures.deviation, 0.05, 0.005);
    EXPECT_GT(figures.whiteness.p, 1e-3);
    EXPECT_GT(figures.r2, 0.5);
  }
}

TEST(Choose, KeepsWithinTheStates) {
  Settings settings;
  settings.most_states = 3;
  for (const Candidate& candidate : choose(recorded(two_tanks(), 1000, 0.05, 2), settings).tried)
    EXPECT_EQ(candidate.order, 1);
  settings.most_states = 1;
  EXPECT_THROW(choose(recorded(two_tanks(), 1000, 0.05, 2), settings), InputError);
  settings = {};
  settings.holdout = 1;
  EXPECT_THROW(choose(recorded(two_tanks(), 1000, 0.05, 2), settings), InputError);
}

TEST(StateSpace, SaysWhatTheModelSays) {
  Arx truth = two_tanks();
  truth.A = {truth.A[0] * 0.5, truth.A[0] * 0.3};
  const Records records = recorded(truth, 2000, 0.05, 4);
  const Eigen::MatrixXd left = residuals(truth, records);
  const StateSpace space = state_space(truth, records, left, 0.1);
  Eigen::VectorXd x(4), u(3);
  x << records.outputs.row(99).transpose(), records.outputs.row(98).transpose();
  u << records.inputs.row(100).transpose(), 1;
  const Eigen::VectorXd next = space.A * x + space.B * u;
  EXPECT_LT((space.C * next + left.row(100).transpose() - records.outputs.row(100).transpose()).norm(), 1e-12);
  EXPECT_LT((next.tail(2) - x.head(2)).norm(), 1e-15) << "the older row moves down";
  EXPECT_NEAR(space.R[0], 0.1 * 0.0025, 0.1 * 0.0025 * 0.2) << "a tenth of 0.05², five standard errors of a variance";
  Eigen::MatrixXd S = space.Q.topLeftCorner(2, 2);
  S.diagonal() += space.R;
  for (const Eigen::MatrixXd& A : truth.A) S += A * space.R.asDiagonal() * A.transpose();
  EXPECT_LT((S - 0.0025 * Eigen::Matrix2d::Identity()).norm(), 0.0025 * 0.2);
  EXPECT_EQ(space.Q.bottomRightCorner(2, 2).norm(), 0);
  EXPECT_EQ(space.P0, space.P0.transpose());
}

}  // namespace
}  // namespace vigil::identify::arx_test
