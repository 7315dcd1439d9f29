#include "engine/linalg/care.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/linalg/covariance.hpp"
#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil::care_test {
namespace {

using Eigen::MatrixXd;

MatrixXd matrix(std::initializer_list<std::initializer_list<double>> rows) { return MatrixXd(rows); }

/// Of the equation, relative to what rounding the entries of X alone may leave of it.
double residual(const MatrixXd& A, const MatrixXd& C, const MatrixXd& Q, const MatrixXd& R, const MatrixXd& X) {
  const MatrixXd G = C.transpose() * R.inverse() * C;
  const double size = 2 * A.norm() * X.norm() + X.norm() * G.norm() * X.norm() + Q.norm();
  return (A * X + X * A.transpose() - X * G * X + Q).norm() / size;
}

TEST(ContinuousRiccati, SolvesTheScalarEquation) {
  for (const double a : {-3.0, 0.0, 2.0}) {
    for (const double q : {1e-6, 1.0, 1e10}) {
      const auto X = solve_care(matrix({{a}}), matrix({{2}}), matrix({{q}}), matrix({{0.5}}));
      ASSERT_TRUE(X) << a << " " << q;  // 2 a x - 8 x^2 + q = 0
      const double exact = q / (std::sqrt(a * a + 8 * q) - a);
      EXPECT_NEAR((*X)(0, 0), exact, 1e-9 * exact);
    }
  }
}

TEST(ContinuousRiccati, SolvesTheDoubleIntegrator) {
  const auto X = solve_care(matrix({{0, 1}, {0, 0}}), matrix({{1, 0}}), matrix({{0, 0}, {0, 1}}), matrix({{1}}));
  ASSERT_TRUE(X);
  EXPECT_TRUE(X->isApprox(matrix({{std::sqrt(2), 1}, {1, std::sqrt(2)}}), 1e-12));
}

TEST(ContinuousRiccati, SolvesRandomEquationsAndStabilises) {
  for (int number = 0; number < 60; ++number) {
    RandomMatrices random(number);
    const int n = 1 + random.below(12), p = 1 + random.below(n);
    const MatrixXd A = random.gaussian(n, n), C = random.gaussian(p, n), R = random.definite(p);
    const MatrixXd Q = random.log_uniform(1e-3, 1e8) * random.definite(n);
    const auto X = solve_care(A, C, Q, R);
    ASSERT_TRUE(X) << number;
    EXPECT_LT(residual(A, C, Q, R, *X), 1e-13) << number;
    EXPECT_LT(spectral_abscissa(A - *X * C.transpose() * R.inverse() * C), 0) << number;
    EXPECT_GT(least_eigenvalue(*X), 0) << number;
  }
}

TEST(ContinuousRiccati, HasNoAnswerWhereNoneStabilises) {
  const MatrixXd A = matrix({{1, 0}, {0, -1}}), Q = MatrixXd::Identity(2, 2), R = matrix({{1}});
  EXPECT_FALSE(solve_care(A, matrix({{0, 1}}), Q, R));                                             // mode 1 is not seen
  EXPECT_FALSE(solve_care(matrix({{0}}), R, matrix({{0}}), R));                                    // nor moved
  EXPECT_FALSE(solve_care(matrix({{0, 1}, {-1, 0}}), matrix({{1, 0}}), MatrixXd::Zero(2, 2), R));  // undamped
  EXPECT_TRUE(solve_care(A, matrix({{1, 0}}), Q, R));                                              // -1 decays unseen
}

TEST(ContinuousRiccati, RefusesWhatIsNotPosed) {
  const MatrixXd I = MatrixXd::Identity(2, 2);
  MatrixXd infinite = I;
  infinite(0, 1) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(solve_care(infinite, I, I, I));
  EXPECT_FALSE(solve_care(I, I, -I, I));
  EXPECT_FALSE(solve_care(I, I, I, -I));
  EXPECT_FALSE(solve_care(I, I, matrix({{1, 1}, {0, 1}}), I));
  EXPECT_FALSE(solve_care(I, MatrixXd::Identity(3, 3), I, I));
  EXPECT_FALSE(solve_care(MatrixXd(0, 0), MatrixXd(0, 0), MatrixXd(0, 0), MatrixXd(0, 0)));
}

TEST(ContinuousDetectability, AsksForModesThatDoNotDecayOnly) {
  const MatrixXd A = matrix({{0.5, 0, 0}, {0, 0, 0}, {0, 0, -2}});
  EXPECT_TRUE(detectable_continuous(A, matrix({{1, 1, 0}})));
  EXPECT_TRUE(detectable_continuous(A, matrix({{1e-9, 1e-9, 0}})));
  EXPECT_FALSE(detectable_continuous(A, matrix({{1, 0, 1}})));
  EXPECT_FALSE(detectable_continuous(A, matrix({{0, 1, 1}})));
  EXPECT_FALSE(detectable_continuous(A, MatrixXd::Zero(2, 3)));
  EXPECT_TRUE(detectable_continuous(-MatrixXd::Identity(3, 3), MatrixXd::Zero(1, 3)));
  EXPECT_EQ(spectral_abscissa(A), 0.5);
}

}  // namespace
}  // namespace vigil::care_test
