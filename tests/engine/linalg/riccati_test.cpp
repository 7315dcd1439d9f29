#include "engine/linalg/riccati.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "engine/linalg/covariance.hpp"
#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil::riccati_test {
namespace {

using Eigen::MatrixXd;

MatrixXd matrix(std::initializer_list<std::initializer_list<double>> rows) { return MatrixXd(rows); }

const MatrixXd kTankA = matrix({{1, -0.1}, {0.1, 0.9}});
const MatrixXd kTankB = matrix({{0.7}, {0.3}});

MatrixXd right_side(const MatrixXd& A, const MatrixXd& B, const MatrixXd& Q, const MatrixXd& R, const MatrixXd& S) {
  const MatrixXd inner = (B.transpose() * S * B + R).inverse();
  return A.transpose() * S * A - A.transpose() * S * B * inner * B.transpose() * S * A + Q;
}

/// The equation as a recursion, run until it stands still.
MatrixXd iterated(const MatrixXd& A, const MatrixXd& B, const MatrixXd& Q, const MatrixXd& R) {
  MatrixXd S = Q;
  for (int step = 0; step < 200000; ++step) {
    const MatrixXd next = right_side(A, B, Q, R, S);
    const bool still = (next - S).norm() <= 1e-15 * S.norm();
    S = 0.5 * (next + next.transpose());
    if (still) break;
  }
  return S;
}

/// sum x'Qx + u'Ru under u = L x from x.
double cost(const MatrixXd& A, const MatrixXd& B, const MatrixXd& Q, const MatrixXd& R, const MatrixXd& L,
            Eigen::VectorXd x) {
  double sum = 0;
  for (int k = 0; k < 5000; ++k) {
    const Eigen::VectorXd u = L * x;
    sum += x.dot(Q * x) + u.dot(R * u);
    x = A * x + B * u;
  }
  return sum;
}

TEST(Riccati, GivesTheTanksFeedback) {
  const MatrixXd Q = MatrixXd::Identity(2, 2), R = MatrixXd::Identity(1, 1);
  const auto S = solve_dare(kTankA, kTankB, Q, R);
  ASSERT_TRUE(S);
  const MatrixXd L = lqr_gain(kTankA, kTankB, R, *S);
  EXPECT_NEAR(L(0, 0), -0.624, 5e-4);
  EXPECT_NEAR(L(0, 1), -0.298, 5e-4);
  const Eigen::VectorXd modes = (kTankA + kTankB * L).eigenvalues().real();
  EXPECT_NEAR(modes.minCoeff(), 0.4815, 5e-5);
  EXPECT_NEAR(modes.maxCoeff(), 0.8923, 5e-5);
  EXPECT_NEAR(spectral_radius(kTankA), 0.9539, 5e-5);
  const MatrixXd expected = lqr_gain(kTankA, kTankB, R, iterated(kTankA, kTankB, Q, R));
  EXPECT_LE((L - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Riccati, SolvesRandomSystems) {
  for (int number = 0; number < 150; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(number);
    const int n = 1 + random.below(8), m = 1 + random.below(3);
    const MatrixXd A = random.gaussian(n, n) * random.log_uniform(0.1, 2) / std::sqrt(n);
    const MatrixXd B = random.gaussian(n, m) * random.log_uniform(0.1, 10);
    const MatrixXd Q = random.semidefinite(n, 1 + random.below(n)), R = random.definite(m);
    const auto S = solve_dare(A, B, Q, R);
    ASSERT_TRUE(S);
    EXPECT_LE((right_side(A, B, Q, R, *S) - *S).norm(), 1e-10 * S->norm());
    EXPECT_LE((*S - S->transpose()).norm(), 1e-12 * S->norm());
    EXPECT_GE(least_eigenvalue(*S), -1e-12 * S->norm());
    EXPECT_LT(spectral_radius(A + B * lqr_gain(A, B, R, *S)), 1);
    const MatrixXd expected = iterated(A, B, Q, R);
    EXPECT_LE((*S - expected).norm(), 1e-8 * expected.norm());
  }
}

TEST(Riccati, ItsFeedbackCostsLeast) {
  for (int number = 0; number < 30; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(1000 + number);
    const int n = 2 + random.below(3), m = 1 + random.below(2);
    const MatrixXd A = random.gaussian(n, n) / std::sqrt(n), B = random.gaussian(n, m);
    const MatrixXd Q = random.definite(n), R = random.definite(m);
    const auto S = solve_dare(A, B, Q, R);
    ASSERT_TRUE(S);
    const MatrixXd L = lqr_gain(A, B, R, *S);
    const Eigen::VectorXd x = random.vector(n);
    const double least = cost(A, B, Q, R, L, x);
    EXPECT_NEAR(least, x.dot(*S * x), 1e-9 * least);
    for (int other = 0; other < 5; ++other) {
      const MatrixXd change = 1e-3 * random.gaussian(m, n);
      if (spectral_radius(A + B * (L + change)) > 0.99) continue;
      EXPECT_GT(cost(A, B, Q, R, L + change, x), least);
    }
  }
}

// The plain iteration stays at S = 0 here: it is a solution, but one that leaves the mode unstable.
TEST(Riccati, StabilisesAModeThatCostsNothing) {
  const auto S = solve_dare(matrix({{2}}), matrix({{1}}), matrix({{0}}), matrix({{1}}));
  ASSERT_TRUE(S);
  EXPECT_NEAR((*S)(0, 0), 3, 1e-12);
  const MatrixXd A = matrix({{1.5, 0.2}, {0, 0.5}}), B = matrix({{1}, {1}}), Q = matrix({{0, 0}, {0, 1}});
  const auto both = solve_dare(A, B, Q, matrix({{1}}));
  ASSERT_TRUE(both);
  EXPECT_LT(spectral_radius(A + B * lqr_gain(A, B, matrix({{1}}), *both)), 1);
  EXPECT_LE((right_side(A, B, Q, matrix({{1}}), *both) - *both).norm(), 1e-12);
}

TEST(Riccati, RefusesWhatHasNoStabilisingSolution) {
  const MatrixXd I1 = MatrixXd::Identity(1, 1), I2 = MatrixXd::Identity(2, 2);
  EXPECT_FALSE(solve_dare(matrix({{1.1, 0}, {0, 0.5}}), matrix({{0}, {1}}), I2, I1));
  EXPECT_FALSE(solve_dare(matrix({{1, 0}, {0, 0.5}}), matrix({{0}, {1}}), I2, I1));
  EXPECT_TRUE(solve_dare(matrix({{1.1, 0}, {0, 0.5}}), matrix({{1}, {0}}), I2, I1));
  EXPECT_FALSE(solve_dare(I1, I1, 0 * I1, I1));
  EXPECT_FALSE(solve_dare(kTankA, kTankB, I2, -I1));
  EXPECT_FALSE(solve_dare(kTankA, kTankB, I2, 0 * I1));
  EXPECT_FALSE(solve_dare(kTankA, kTankB, -I2, I1));
  EXPECT_FALSE(solve_dare(kTankA, kTankB, matrix({{1, 1}, {0, 1}}), I1));
  EXPECT_FALSE(solve_dare(kTankA, kTankB.transpose(), I2, I1));
  EXPECT_FALSE(solve_dare(kTankA, kTankB, I2, I2));
  EXPECT_FALSE(solve_dare(kTankA, kTankB, I1, I1));
  EXPECT_FALSE(solve_dare(std::numeric_limits<double>::quiet_NaN() * kTankA, kTankB, I2, I1));
}

TEST(Riccati, StabilisableIsAboutTheModesThatDoNotDecay) {
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(2000 + number);
    const int reached = 1 + random.below(4), unreached = 1 + random.below(3), n = reached + unreached;
    MatrixXd A = MatrixXd::Zero(n, n), B = MatrixXd::Zero(n, 1);
    A.topRows(reached) = random.gaussian(reached, n);
    MatrixXd rest = random.gaussian(unreached, unreached);
    rest *= (number % 2 == 0 ? 0.9 : 1.1) / spectral_radius(rest);
    A.bottomRightCorner(unreached, unreached) = rest;
    B.topRows(reached) = random.log_uniform(1e-6, 1e6) * random.gaussian(reached, 1);
    const MatrixXd T = random.orthogonal(n);
    EXPECT_EQ(stabilisable(T * A * T.transpose(), T * B), number % 2 == 0);
    EXPECT_EQ(detectable(T * A.transpose() * T.transpose(), B.transpose() * T.transpose()), number % 2 == 0);
  }
}

TEST(Riccati, ADoubleModeNeedsTwoInputs) {
  const MatrixXd I = MatrixXd::Identity(2, 2);
  EXPECT_FALSE(stabilisable(I, matrix({{1}, {1}})));
  EXPECT_TRUE(stabilisable(I, I));
  EXPECT_TRUE(stabilisable(I, matrix({{1, 0, 0}, {0, 0, 1}}))) << "an input that does nothing takes nothing away";
  EXPECT_TRUE(stabilisable(matrix({{1, 1}, {0, 1}}), matrix({{0}, {1}})));
  EXPECT_FALSE(stabilisable(matrix({{1, 1}, {0, 1}}), matrix({{1}, {0}})));
  EXPECT_TRUE(stabilisable(0.5 * I, MatrixXd::Zero(2, 1)));
}

TEST(Riccati, SpectralRadiusOfARotationIsItsScale) {
  EXPECT_NEAR(spectral_radius(matrix({{0, -0.7}, {0.7, 0}})), 0.7, 1e-14);
  EXPECT_EQ(spectral_radius(matrix({{0, 1}, {0, 0}})), 0);
  EXPECT_EQ(spectral_radius(matrix({{std::numeric_limits<double>::quiet_NaN()}})),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace vigil::riccati_test
