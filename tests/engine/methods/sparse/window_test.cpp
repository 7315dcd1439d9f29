/// The window's regression beside the same by dense algebra: specification of seed 001, section 7.
#include <gtest/gtest.h>

#include "tests/engine/methods/sparse/windows.hpp"

namespace vigil::window_test {
namespace {

using sparse::Linearisation;
using windows::Plain;
using windows::Scene;
using windows::Tampering;

/// Everything that a regression says, beside the dense reference of unit noise `sigma` a channel.
void expect_like(const sparse::Regression& regression, const Plain& plain, double sigma) {
  EXPECT_TRUE(regression.observable);
  EXPECT_LT((regression.r - plain.r).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((regression.Phi - plain.Phi).cwiseAbs().maxCoeff(), 1e-12);
  const auto size = plain.r.size();
  const Eigen::MatrixXd M = Eigen::MatrixXd::Identity(size, size) - regression.Q1 * regression.Q1.transpose();
  EXPECT_LT((M - plain.M).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((regression.Q1.transpose() * regression.Q1 - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-13);
  const Eigen::VectorXd left = sigma * (plain.M * (plain.W * plain.r));
  EXPECT_LT((regression.left - left).norm(), 1e-11 * (1 + left.norm()));
  EXPECT_NEAR(regression.statistic, left.norm(), 1e-11 * (1 + left.norm()));
}

TEST(SparseWindow, IsTheDenseRegression) {
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    const auto sensor = windows::station(trial % 2 == 0 ? Json{-6, 8, 0} : Json{6, -8, 0});
    const auto tampering = trial % 3 == 0 ? Tampering::none : Tampering::random;
    const Scene scene = windows::scene(sensor, trial, trial % 4 == 3 ? 12 : 6, tampering);
    for (const auto where : {Linearisation::prior, Linearisation::current, Linearisation::frozen}) {
      for (const bool as_printed : {false, true}) {
        SCOPED_TRACE(trial);
        const sparse::Regression regression = windows::regress(scene, where, as_printed);
        EXPECT_NEAR(regression.sigma, 0.01, 1e-16);
        expect_like(regression, windows::plain(scene, where, as_printed), 0.01);
      }
    }
  }
}

TEST(SparseWindow, LinearisesWhereItIsTold) {
  const Scene scene = windows::scene(windows::station({-6, 8, 0}), 3, 6, Tampering::none);
  const auto prior = windows::regress(scene), current = windows::regress(scene, Linearisation::current),
             frozen = windows::regress(scene, Linearisation::frozen);
  EXPECT_EQ(prior.r, current.r) << "the innovations are along the trajectory in both";
  EXPECT_EQ(prior.Phi.bottomRows(6), current.Phi.bottomRows(6));
  EXPECT_GT((prior.Phi - current.Phi).topRows(6).norm(), 1e-4);
  EXPECT_GT((prior.Phi - frozen.Phi).topRows(6).norm(), 1e-4);
  EXPECT_EQ(prior.Phi.bottomRows(6), frozen.Phi.bottomRows(6)) << "the newest reading met this prior";
}

// Seen from the east, the target stands where the azimuth jumps by a turn.
TEST(SparseWindow, WrapsTheAzimuthAcrossTheJump) {
  int jumps = 0;
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    Scene scene = windows::scene(windows::station({30, 0, 0}), trial, 6, Tampering::none);
    scene.prior[2] = 0.002 * (static_cast<double>(trial) - 20);  // py
    scene.prior[3] = 0;
    for (int j = 0; j < 6; ++j) {
      Eigen::VectorXd y(6);
      scene.sensor->measure(scene.prior, y);
      y[1] = windows::turned(y[1] + 0.01 * (j - 2.5));
      jumps += std::abs(y[1] - scene.readings(1, std::max(j - 1, 0))) > 6 ? 1 : 0;
      scene.readings.col(j) = y;
    }
    const sparse::Regression regression = windows::regress(scene);
    expect_like(regression, windows::plain(scene), 0.01);
    for (int j = 0; j < 6; ++j) EXPECT_LT(std::abs(regression.r[6 * j + 1]), 0.1) << trial;
  }
  EXPECT_GT(jumps, 10) << "or nothing was tested";
}

TEST(SparseWindow, KeepsOnlyTheLastReadingsAndForgetsWhenCleared) {
  const Scene scene = windows::scene(windows::station({-6, 8, 0}), 5, 6, Tampering::random);
  sparse::Window window(scene.sensor, 6, Linearisation::frozen, false);
  for (int j = 0; j < 4; ++j) window.push(Eigen::VectorXd::Constant(6, 100 + j), BoundedVector(scene.prior * (2 + j)));
  window.clear();
  for (int j = 0; j < 6; ++j) {
    EXPECT_FALSE(window.full());
    window.push(scene.readings.col(j), scene.met.col(j));
  }
  EXPECT_TRUE(window.full());
  sparse::Regression regression(6, 6, 6);
  window.regress(scene.prior, sparse::Transition(windows::loop(), 6), regression);
  expect_like(regression, windows::plain(scene, Linearisation::frozen), 0.01);
  BoundedVector newest;
  BoundedMatrix C(6, 6);
  window.newest(scene.prior, newest, C);
  EXPECT_EQ(newest, BoundedVector(regression.r.tail(6)));
  EXPECT_EQ(C, BoundedMatrix(windows::derivative(*scene.sensor, scene.prior, false)));
}

// R = sigma^2 I is the same number, diagonal or full matrix; anything else is whitened.
TEST(SparseWindow, WhitensWhatIsNotWhite) {
  Json full = Json::array();
  for (int i = 0; i < 6; ++i) {
    full.push_back(Json::array({0, 0, 0, 0, 0, 0}));
    full[static_cast<std::size_t>(i)][static_cast<std::size_t>(i)] = 1e-4;
  }
  const Json place{-6, 8, 0};
  const Scene scene = windows::scene(windows::station(place), 8, 6, Tampering::random);
  Scene other = scene;
  other.sensor = windows::station(place, full);
  const auto a = windows::regress(scene), b = windows::regress(other);
  EXPECT_EQ(a.left, b.left);
  EXPECT_EQ(a.Q1, b.Q1);
  EXPECT_EQ(b.sigma, a.sigma);
  for (const Json& R : {windows::coloured(), Json{1e-4, 4e-4, 1e-4, 1e-4, 1e-4, 9e-4}, Json(1.0)}) {
    other.sensor = windows::station(place, R);
    const auto whitened = windows::regress(other);
    EXPECT_EQ(whitened.sigma, 1);
    expect_like(whitened, windows::plain(other), 1);
  }
}

// Straight below the target azimuth and elevation say nothing, so one reading does not determine the state.
TEST(SparseWindow, SaysWhereTheStateIsNotDetermined) {
  Scene scene = windows::scene(windows::station({1, 2, 0}), 1, 1, Tampering::none);
  EXPECT_TRUE(windows::regress(scene).observable);
  scene.prior << 1, 0, 2, 0, 5, 0;
  EXPECT_FALSE(windows::regress(scene).observable);
}

// Theorem 1's check is relative: scaling leaves it alone, a column that is nearly another fails it.
TEST(SparseWindow, JudgesRankByTheRatioOfPivots) {
  Eigen::MatrixXd A(40, 6), Q1;
  for (Eigen::Index c = 0; c < 6; ++c) A.col(c) = windows::normals(7, "columns", c, 40);
  for (const double scale : {1e-100, 1.0, 1e100}) EXPECT_TRUE(sparse::orthonormalise(scale * A, Q1)) << scale;
  for (const auto& [apart, independent] : {std::pair{1e-8, true}, {1e-12, false}, {0.0, false}}) {
    Eigen::MatrixXd B = A;
    B.col(4) = B.col(1) + apart * A.col(4);
    EXPECT_EQ(sparse::orthonormalise(B, Q1), independent) << apart;
    if (!independent) continue;
    EXPECT_LT((Q1.transpose() * Q1 - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-13);
    EXPECT_LT((B - Q1 * (Q1.transpose() * B)).norm(), 1e-12);
  }
}

TEST(SparseTransition, InvertsAndRefusesWhatCannotBe) {
  const Eigen::MatrixXd F = windows::loop();
  const sparse::Transition transition(F, 4);
  EXPECT_LT((transition.inverse() * F - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-13);
  EXPECT_LT((transition.power(3) - F * F * F).norm(), 1e-13);
  EXPECT_EQ(transition.power(0), BoundedMatrix::Identity(6, 6));
  Eigen::MatrixXd singular = F;
  singular.row(2).setZero();
  EXPECT_THROW(sparse::Transition(singular, 4), InputError);
}

}  // namespace
}  // namespace vigil::window_test
