// Popov, Belevitch and Hautus on systems whose answer is known by hand.
#include "engine/linalg/modes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "engine/linalg/riccati.hpp"

namespace vigil::modes_test {
namespace {

using Eigen::MatrixXd;

Visibility seen(const MatrixXd& A, const MatrixXd& C, TimeKind time = TimeKind::ticks) {
  const auto result = visibility(A, C, time);
  EXPECT_TRUE(result.has_value());
  return result.value_or(Visibility{});
}

/// A fixed change of coordinates that mixes n states.
MatrixXd mixing(int n) {
  MatrixXd T(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) T(i, j) = std::cos(1.3 * i + 2.1 * j * j + 0.4 * i * j) + (i == j ? 2 : 0);
  }
  return T;
}

TEST(Modes, PairsAndRepeatsAreCounted) {
  MatrixXd A = MatrixXd::Zero(5, 5);
  A.topLeftCorner(2, 2) << 0.6, -0.9, 0.9, 0.6;
  A.diagonal().tail(3) << 0.5, 0.5, -0.2;
  const auto modes = Modes::of(A, TimeKind::ticks);
  ASSERT_TRUE(modes);
  ASSERT_EQ(modes->all().size(), 3u);
  EXPECT_EQ(modes->all()[0].count, 2);
  EXPECT_NEAR(modes->all()[0].value.imag(), 0.9, 1e-12);
  EXPECT_EQ(modes->fate(modes->all()[0]), Fate::grows);
  EXPECT_EQ(modes->all()[1].count, 2);
  EXPECT_EQ(modes->fate(modes->all()[1]), Fate::decays);
  EXPECT_FALSE(modes->stable());
}

TEST(Modes, FateByModulusOrByRealPart) {
  const MatrixXd A{{-0.5, 0}, {0, 0}};
  const auto ticks = Modes::of(A, TimeKind::ticks), flow = Modes::of(A, TimeKind::continuous);
  EXPECT_TRUE(ticks->stable());
  EXPECT_FALSE(flow->stable());
  EXPECT_EQ(flow->fate(flow->all()[0]), Fate::stays);
  EXPECT_EQ(flow->fate(flow->all()[1]), Fate::decays);
  EXPECT_FALSE(Modes::of(MatrixXd{{std::nan("")}}, TimeKind::ticks));
}

TEST(Visibility, AHiddenModeThatDecays) {
  const Visibility answer = seen(MatrixXd{{1.1, 0}, {0, 0.5}}, MatrixXd{{1, 0}});
  EXPECT_EQ(answer.rank, 1);
  ASSERT_EQ(answer.hidden.size(), 1u);
  EXPECT_NEAR(answer.hidden[0].value.real(), 0.5, 1e-12);
  EXPECT_LE(answer.margin, kHidden);
}

TEST(Visibility, OfAnIdentityOneModeIsSeenOnce) {
  const Visibility answer = seen(MatrixXd::Identity(3, 3), MatrixXd{{1, 2, 3}});
  EXPECT_EQ(answer.rank, 1);
  ASSERT_EQ(answer.hidden.size(), 1u);
  EXPECT_EQ(answer.hidden[0].count, 2);
}

TEST(Visibility, PositionShowsVelocityButNotTheOtherWay) {
  const MatrixXd A{{1, 0.1}, {0, 1}};
  EXPECT_TRUE(seen(A, MatrixXd{{1, 0}}).hidden.empty());
  EXPECT_EQ(seen(A, MatrixXd{{1, 0}}).rank, 2);
  const Visibility velocity = seen(A, MatrixXd{{0, 1}});
  EXPECT_EQ(velocity.rank, 1);
  EXPECT_NEAR(velocity.hidden.at(0).value.real(), 1, 1e-12);
}

// The eigenvalues of a Jordan block are known to the root of rounding only, in mixed coordinates.
TEST(Visibility, OfAHiddenJordanBlock) {
  MatrixXd A = MatrixXd::Zero(4, 4);
  A.diagonal() << 1, 1, 0.3, 0.7;
  A(0, 1) = 1;
  MatrixXd C = MatrixXd::Zero(1, 4);
  C << 0, 0, 1, 1;
  const MatrixXd T = mixing(4), back = T.inverse();
  const Visibility answer = seen(T * A * back, C * back);
  EXPECT_EQ(answer.rank, 2);
  int hidden = 0;
  for (const Mode& mode : answer.hidden) {
    EXPECT_NEAR(mode.value.real(), 1, 1e-6);
    hidden += mode.count;
  }
  EXPECT_EQ(hidden, 2);
}

TEST(Visibility, TwoBlindNodesSeeItTogether) {
  const MatrixXd A{{1.2, 0}, {0, 1.05}}, one{{1, 0}}, other{{0, 1}};
  EXPECT_NEAR(seen(A, one).hidden.at(0).value.real(), 1.05, 1e-12);
  EXPECT_NEAR(seen(A, other).hidden.at(0).value.real(), 1.2, 1e-12);
  MatrixXd both(2, 2);
  both << one, other;
  EXPECT_TRUE(seen(A, both).hidden.empty());
}

TEST(Visibility, UnitsOfOutputsAndNumberOfRowsSayNothing) {
  const MatrixXd A{{1, 0.1}, {0, 1}};
  EXPECT_TRUE(seen(A, MatrixXd{{1e-15, 0}}).hidden.empty());
  EXPECT_NEAR(seen(A, MatrixXd{{1e-15, 0}}).margin, seen(A, MatrixXd{{1e12, 0}}).margin, 1e-12);
  EXPECT_EQ(seen(A, MatrixXd::Constant(40, 2, 1)).hidden.empty(), true);
  EXPECT_EQ(seen(A, MatrixXd::Zero(40, 2)).rank, 0);
  EXPECT_EQ(seen(A, MatrixXd(0, 2)).rank, 0);
  EXPECT_EQ(seen(MatrixXd::Zero(2, 2), MatrixXd::Identity(2, 2)).rank, 2);
}

// Sampled at half its period an oscillator shows its position, up to the sign, and nothing of its velocity.
TEST(Visibility, OfAnOscillatorSampledAtHalfItsPeriod) {
  const MatrixXd A = -MatrixXd::Identity(2, 2);
  EXPECT_EQ(seen(A, MatrixXd{{1, 0}}).rank, 1);
}

// The hidden part of random systems that were put together from two, and the older test of detectability.
TEST(Visibility, OfRandomSystemsInMixedCoordinates) {
  for (int n = 2; n <= 12; ++n) {
    const int hidden = 1 + (n * 7) % (n - 1);
    MatrixXd A = 0.5 * mixing(n), C = MatrixXd::Zero(2, n);
    A.topRightCorner(n - hidden, hidden).setZero();
    C.leftCols(n - hidden) = mixing(n + 1).block(1, 0, 2, n - hidden);
    const MatrixXd T = mixing(n).fullPivHouseholderQr().matrixQ();
    const MatrixXd there = T * A * T.transpose(), outputs = C * T.transpose();
    const Visibility answer = seen(there, outputs);
    EXPECT_EQ(answer.rank, n - hidden) << n;
    const auto modes = Modes::of(there, TimeKind::ticks);
    bool lasting = false;
    for (const Mode& mode : answer.hidden) lasting = lasting || modes->fate(mode) != Fate::decays;
    EXPECT_EQ(detectable(there, outputs), !lasting) << n;
  }
}

}  // namespace
}  // namespace vigil::modes_test
