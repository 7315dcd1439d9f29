// Closed forms of plants whose input is held for a tick.
#include "engine/linalg/zero_order_hold.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace vigil::zero_order_hold_test {
namespace {

using Eigen::MatrixXd;

TEST(ZeroOrderHold, OfADoubleIntegrator) {
  const double dt = 0.3;
  const Held held = zero_order_hold(MatrixXd{{0, 1}, {0, 0}}, MatrixXd{{0}, {1}}, dt);
  EXPECT_LT((held.A - MatrixXd{{1, dt}, {0, 1}}).norm(), 1e-15);
  EXPECT_LT((held.B - MatrixXd{{dt * dt / 2}, {dt}}).norm(), 1e-15);
}

TEST(ZeroOrderHold, OfAnOscillator) {
  const double w = 7, dt = 0.4, c = std::cos(w * dt), s = std::sin(w * dt);
  const Held held = zero_order_hold(MatrixXd{{0, 1}, {-w * w, 0}}, MatrixXd{{0}, {1}}, dt);
  EXPECT_LT((held.A - MatrixXd{{c, s / w}, {-w * s, c}}).norm(), 1e-13);
  EXPECT_LT((held.B - MatrixXd{{(1 - c) / (w * w)}, {s / w}}).norm(), 1e-14);
}

// Time constants of a microsecond and of a second, in one matrix that is not diagonal.
TEST(ZeroOrderHold, OfAStiffPlant) {
  const MatrixXd T{{2, 1}, {1, 1}}, back{{1, -1}, {-1, 2}};
  const double fast = -1e6, slow = -1, dt = 0.5;
  const MatrixXd A = T * Eigen::Vector2d(fast, slow).asDiagonal() * back, B{{3}, {-2}};
  const Eigen::Vector2d decayed(std::exp(fast * dt), std::exp(slow * dt));
  const Eigen::Vector2d gathered((decayed[0] - 1) / fast, (decayed[1] - 1) / slow);
  const Held held = zero_order_hold(A, B, dt);
  EXPECT_LT((held.A - T * decayed.asDiagonal() * back).norm(), 1e-9);
  EXPECT_LT((held.B - T * gathered.asDiagonal() * back * B).norm(), 1e-9);
}

TEST(ZeroOrderHold, IsLinearInTheInputHoweverLarge) {
  const MatrixXd A{{-0.3, 1}, {-2, -0.1}}, B{{1}, {-0.5}};
  const Held small = zero_order_hold(A, B, 0.2), large = zero_order_hold(A, 1e12 * B, 0.2);
  EXPECT_EQ(small.A, large.A);
  EXPECT_LT((large.B / 1e12 - small.B).norm(), 1e-15);
}

TEST(ZeroOrderHold, TwoHalvesAreTheWhole) {
  const MatrixXd A{{0.1, 2, 0}, {-1, 0.3, 1}, {0, 0.2, -4}}, B{{1, 0}, {0, 2}, {1, 1}};
  const Held whole = zero_order_hold(A, B, 0.8), half = zero_order_hold(A, B, 0.4);
  EXPECT_LT((half.A * half.A - whole.A).norm(), 1e-13);
  EXPECT_LT((half.A * half.B + half.B - whole.B).norm(), 1e-13);
}

TEST(ZeroOrderHold, WithoutInputsAndBeyondEveryNumber) {
  const Held none = zero_order_hold(MatrixXd{{-1}}, MatrixXd(1, 0), 2);
  EXPECT_NEAR(none.A(0, 0), std::exp(-2.0), 1e-15);
  EXPECT_EQ(none.B.cols(), 0);
  EXPECT_FALSE(zero_order_hold(MatrixXd{{1000}}, MatrixXd(1, 0), 1).A.allFinite());
  EXPECT_FALSE(zero_order_hold(MatrixXd{{1e300, 1e300}, {0, 1e300}}, MatrixXd(2, 0), 1e9).A.allFinite());
}

}  // namespace
}  // namespace vigil::zero_order_hold_test
