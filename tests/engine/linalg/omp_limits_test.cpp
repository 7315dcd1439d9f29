// Dictionaries and inputs that ask for little, for nothing, or for what cannot be.
#include <gtest/gtest.h>

#include <limits>

#include "engine/linalg/omp.hpp"
#include "tests/engine/linalg/dictionaries.hpp"

namespace vigil::omp_limits_test {
namespace {

using dictionaries::Trial;

TEST(OmpAtItsLimits, PassesOverColumnsThatSayNothingNew) {
  Trial trial(7);
  Eigen::MatrixXd D = trial.gaussian(8, 6);
  D.col(1) = D.col(0);
  D.col(2) = -3 * D.col(0);
  D.col(3).setZero();
  D.col(5) = D.col(0) + D.col(4);
  const Eigen::VectorXd y = trial.gaussian(8, 1);
  Omp omp(6, 6);
  const auto check = [&] {
    EXPECT_EQ(omp.support().size(), 2U);  // the columns' rank
    EXPECT_EQ(omp.entries()[3], 0);
    const Eigen::VectorXd best = D * D.completeOrthogonalDecomposition().solve(y);
    EXPECT_TRUE((D * omp.entries()).isApprox(best, 1e-12));
  };
  ASSERT_TRUE(omp.solve(D, y, 6, 0));
  check();
  ASSERT_TRUE(omp.solve_gram(D.transpose() * D, D.transpose() * y, y.norm(), 6, 0));
  check();
}

TEST(OmpAtItsLimits, PassesOverColumnsThatAreNearlyChosen) {
  Eigen::Matrix<double, 3, 2> D;
  const Eigen::Vector3d y(1, 0.5, 0);
  Omp omp(2, 2);
  for (const auto& [apart, picked] : {std::pair{1e-5, 2U}, {1e-7, 1U}}) {  // its square against 1e-12
    D << 1, 1, 0, apart, 0, 0;
    ASSERT_TRUE(omp.solve(D, y, 2, 0));
    EXPECT_EQ(omp.support().size(), picked);
    ASSERT_TRUE(omp.solve_gram(D.transpose() * D, D.transpose() * y, y.norm(), 2, 0));
    EXPECT_EQ(omp.support().size(), picked);
  }
}

// Least squares on columns that are nearly parallel, where the Gram matrix would have lost half the digits.
TEST(OmpAtItsLimits, FitsNearlyParallelColumnsOnTheDictionary) {
  for (int number = 0; number < 20; ++number) {
    Trial trial(3000 + number);
    const Eigen::MatrixXd D = Eigen::MatrixXd::Ones(20, 6) + 1e-5 * trial.gaussian(20, 6);
    const Eigen::VectorXd y = trial.gaussian(20, 1), exact = D.colPivHouseholderQr().solve(y);
    Omp omp(6, 6);
    ASSERT_TRUE(omp.solve(D, y, 6, 0));
    EXPECT_LE((omp.entries() - exact).norm(), 1e-9 * exact.norm());
    EXPECT_NEAR(omp.residual(), (y - D * exact).norm(), 1e-9);
  }
}

TEST(OmpAtItsLimits, PicksNothingWhereThereIsNothing) {
  Omp omp(3, 3);
  Trial trial(8);
  const Eigen::MatrixXd D = trial.gaussian(3, 3);
  ASSERT_TRUE(omp.solve(D, Eigen::Vector3d::Zero(), 3, 0));
  EXPECT_TRUE(omp.support().empty());
  ASSERT_TRUE(omp.solve(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Ones(), 3, 0));
  EXPECT_TRUE(omp.support().empty());
  EXPECT_NEAR(omp.residual(), std::sqrt(3.0), 1e-15);
  ASSERT_TRUE(omp.solve_gram(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero(), 1, 3, 0));
  EXPECT_TRUE(omp.support().empty());
  ASSERT_TRUE(omp.solve(D, Eigen::Vector3d::Ones(), 0, 0));
  EXPECT_TRUE(omp.support().empty());
  EXPECT_TRUE(omp.entries().isZero(0));
}

TEST(OmpAtItsLimits, CutsPicksToWhatItHasRoomFor) {
  Omp omp(4, 2);
  ASSERT_TRUE(omp.solve_gram(Eigen::Matrix4d::Identity(), Eigen::Vector4d(1, 2, 3, 4), std::sqrt(30.0), 4, 0));
  EXPECT_EQ(std::vector<int>(omp.support().begin(), omp.support().end()), (std::vector<int>{3, 2}));
}

TEST(OmpAtItsLimits, KnowsNoScale) {
  Trial trial(9);
  const Eigen::MatrixXd D = trial.gaussian(10, 14);
  const Eigen::VectorXd y = trial.gaussian(10, 1);
  Omp plain(14, 8), scaled(14, 8);
  ASSERT_TRUE(plain.solve_gram(D.transpose() * D, D.transpose() * y, y.norm(), 8, 0));
  const std::vector<int> support(plain.support().begin(), plain.support().end());
  for (const double factor : {0x1p-100, 0x1p-20, 0x1p20, 0x1p100}) {
    const Eigen::MatrixXd F = factor * D;
    ASSERT_TRUE(scaled.solve_gram(F.transpose() * F, F.transpose() * y, y.norm(), 8, 0));
    EXPECT_EQ(std::vector<int>(scaled.support().begin(), scaled.support().end()), support);
    EXPECT_TRUE((factor * scaled.entries()).isApprox(plain.entries(), 1e-12));
  }
}

TEST(OmpAtItsLimits, SaysSoWhereAnInputIsNotFiniteOrOfAnotherSize) {
  Trial trial(10);
  const Eigen::MatrixXd D = trial.gaussian(4, 5);
  const Eigen::MatrixXd gram = D.transpose() * D;
  const Eigen::VectorXd y = trial.gaussian(4, 1), b = D.transpose() * y;
  Omp omp(5, 3);
  const auto refused = [&](bool solved) {
    return !solved && omp.entries() == Eigen::VectorXd::Zero(5) && omp.support().empty();
  };
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ASSERT_TRUE(omp.solve(D, y, 3, 0));
    const int chosen = omp.support().back(), other = (chosen + 1) % 5;
    Eigen::MatrixXd spoilt = D, spoilt_gram = gram, spoilt_diagonal = gram;
    spoilt(2, 3) = spoilt_gram(chosen, other) = spoilt_gram(other, chosen) = spoilt_diagonal(other, other) = bad;
    Eigen::VectorXd spoilt_y = y, spoilt_b = b;
    spoilt_y[1] = spoilt_b[4] = bad;
    EXPECT_TRUE(refused(omp.solve(spoilt, y, 3, 0)));
    EXPECT_TRUE(refused(omp.solve(D, spoilt_y, 3, 0)));
    EXPECT_TRUE(refused(omp.solve_gram(spoilt_gram, b, y.norm(), 3, 0)));
    EXPECT_TRUE(refused(omp.solve_gram(spoilt_diagonal, b, y.norm(), 3, 0)));
    EXPECT_TRUE(refused(omp.solve_gram(gram, spoilt_b, y.norm(), 3, 0)));
    EXPECT_TRUE(refused(omp.solve_gram(gram, b, bad, 3, 0)));
  }
  EXPECT_TRUE(refused(omp.solve(D.leftCols(4), y, 3, 0)));
  EXPECT_TRUE(refused(omp.solve(D, b, 3, 0)));
  EXPECT_TRUE(refused(omp.solve_gram(gram, y, y.norm(), 3, 0)));
  EXPECT_TRUE(refused(omp.solve(1e300 * D, y, 3, 0))) << "squares overflow";
}

}  // namespace
}  // namespace vigil::omp_limits_test
