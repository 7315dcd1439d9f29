#include "engine/linalg/basis_pursuit.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "tests/engine/allocations.hpp"
#include "tests/engine/linalg/dictionaries.hpp"

namespace vigil::basis_pursuit_test {
namespace {

using dictionaries::Trial;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// min ||e||_1, D e = b by going through every basis: the optimum is at a vertex.
double enumerated_optimum(const MatrixXd& D, const VectorXd& b) {
  const auto rows = static_cast<std::size_t>(D.rows()), columns = static_cast<std::size_t>(D.cols());
  std::vector<int> basis(rows);
  std::iota(basis.begin(), basis.end(), 0);
  double best = std::numeric_limits<double>::infinity();
  while (true) {
    const MatrixXd B = D(Eigen::all, basis);
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(B);
    if (qr.isInvertible()) best = std::min(best, qr.solve(b).lpNorm<1>());
    std::size_t i = rows;
    while (i > 0 && basis[i - 1] == static_cast<int>(columns - rows + i - 1)) --i;
    if (i == 0) return best;
    ++basis[i - 1];
    for (std::size_t k = i; k < rows; ++k) basis[k] = basis[k - 1] + 1;
  }
}

/// The optimality conditions, and nothing else: feasible, and a dual point proves that no other is shorter.
void expect_optimum(const BasisPursuit& solver, const MatrixXd& D, const VectorXd& b) {
  const double norm = solver.entries().lpNorm<1>();
  EXPECT_LE((D * solver.entries() - b).norm(), 1e-9 * (b.norm() + D.norm() * norm));
  EXPECT_LE((D.transpose() * solver.dual()).lpNorm<Eigen::Infinity>(), 1 + 1e-6);
  EXPECT_NEAR(b.dot(solver.dual()), norm, 1e-6 * norm);
}

/// Both stages on one problem: the interior point as it is, and simplex steps alone. The norm.
double solved_both_ways(const MatrixXd& D, const VectorXd& b) {
  const int rows = static_cast<int>(D.rows()), columns = static_cast<int>(D.cols());
  BasisPursuit solver(rows, columns), simplex(rows, columns, 0);
  EXPECT_TRUE(solver.solve(D, b));
  EXPECT_TRUE(simplex.solve(D, b));
  EXPECT_TRUE(simplex.finished_by_simplex() || b.isZero(0));
  expect_optimum(solver, D, b);
  expect_optimum(simplex, D, b);
  const double norm = solver.entries().lpNorm<1>();
  EXPECT_NEAR(simplex.entries().lpNorm<1>(), norm, 1e-6 * norm);
  EXPECT_LE((simplex.entries().array() != 0).count(), rows);
  return norm;
}

TEST(BasisPursuit, IsTheRightHandSideOfTheIdentity) {
  BasisPursuit solver(4, 4);
  const Eigen::Vector4d b(3, -2, 0, 0.5);
  ASSERT_TRUE(solver.solve(Eigen::Matrix4d::Identity(), b));
  EXPECT_LE((solver.entries() - b).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(BasisPursuit, SpendsOneRowOnItsLargestCoefficient) {
  BasisPursuit solver(1, 4);
  const Eigen::RowVector4d D(1, -4, 2, 3);
  ASSERT_TRUE(solver.solve(D, VectorXd::Constant(1, 10)));
  EXPECT_LE((solver.entries() - Eigen::Vector4d(0, -2.5, 0, 0)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(BasisPursuit, MayShareOutATie) {
  BasisPursuit solver(1, 2);
  ASSERT_TRUE(solver.solve(Eigen::RowVector2d(1, 1), VectorXd::Constant(1, 3)));
  EXPECT_NEAR(solver.entries().sum(), 3, 1e-9);
  EXPECT_NEAR(solver.entries().lpNorm<1>(), 3, 1e-6);
  EXPECT_NEAR(solved_both_ways(Eigen::RowVector2d(1, -1), VectorXd::Constant(1, 3)), 3, 1e-6);
}

// Below (1 + 1/coherence)/2 entries the sparsest solution is the shortest (Donoho and Elad, 2003).
TEST(BasisPursuit, RecoversSparseSignals) {
  const MatrixXd H = dictionaries::hadamard(5);
  MatrixXd D(32, 64);
  D << MatrixXd::Identity(32, 32), H;
  for (int number = 0; number < 30; ++number) {
    Trial trial(number);
    const VectorXd truth = trial.sparse(64, 3, 0.1, 10);  // (1 + sqrt(32))/2 = 3.3
    BasisPursuit solver(32, 64), simplex(32, 64, 0);
    ASSERT_TRUE(solver.solve(D, D * truth));
    ASSERT_TRUE(simplex.solve(D, D * truth));
    EXPECT_LE((solver.entries() - truth).cwiseAbs().maxCoeff(), 1e-6 * truth.cwiseAbs().maxCoeff());
    EXPECT_LE((simplex.entries() - truth).cwiseAbs().maxCoeff(), 1e-9 * truth.cwiseAbs().maxCoeff());
  }
}

struct Size {
  int rows, columns;
};

class BasisPursuitSize : public testing::TestWithParam<Size> {};

TEST_P(BasisPursuitSize, ProvesItsOptimum) {
  const auto [rows, columns] = GetParam();
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    Trial trial(100 * rows + number);
    const MatrixXd D = number % 2 == 0 ? trial.orthonormal(columns, columns - rows) : trial.gaussian(rows, columns);
    VectorXd b = trial.gaussian(rows, 1);
    if (number % 4 < 2) {  // as the windows are: a sparse attack and noise
      VectorXd e = trial.sparse(columns, std::max(1, rows / 3), 0.3, 10);
      for (double& entry : e) entry += 0.01 * trial.normal();
      b = D * e;
    }
    solved_both_ways(D, b);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, BasisPursuitSize,
                         testing::Values(Size{30, 36}, Size{12, 18}, Size{5, 36}, Size{66, 72}, Size{1, 7}, Size{6, 6}),
                         [](const auto& tested) {
                           return std::to_string(tested.param.rows) + "x" + std::to_string(tested.param.columns);
                         });

TEST(BasisPursuit, AgreesWithEveryBasisTried) {
  for (int number = 0; number < 120; ++number) {
    SCOPED_TRACE(number);
    Trial trial(5000 + number);
    const int rows = 1 + trial.below(4), columns = rows + 1 + trial.below(5);
    const MatrixXd D = trial.gaussian(rows, columns);
    const VectorXd b = trial.gaussian(rows, 1);
    const double norm = solved_both_ways(D, b);
    EXPECT_NEAR(norm, enumerated_optimum(D, b), 1e-6 * norm);
  }
}

// Small whole numbers: ties in every choice, entries at zero in the basis, dependent columns.
TEST(BasisPursuit, AgreesWithEveryBasisTriedOnWholeNumbers) {
  int solved = 0;
  for (int number = 0; number < 300; ++number) {
    SCOPED_TRACE(number);
    Trial trial(7000 + number);
    const int rows = 2 + trial.below(3), columns = rows + 2 + trial.below(4);
    const MatrixXd D = MatrixXd::NullaryExpr(rows, columns, [&] { return trial.below(3) - 1; });
    const VectorXd b = VectorXd::NullaryExpr(rows, [&] { return trial.below(3) - 1; });
    if (Eigen::FullPivLU<MatrixXd>(D).rank() < rows) {
      BasisPursuit solver(rows, columns);
      EXPECT_FALSE(solver.solve(D, b));
      continue;
    }
    ++solved;
    const double norm = solved_both_ways(D, b);
    EXPECT_NEAR(norm, enumerated_optimum(D, b), 1e-6 * (norm + 1e-300));
  }
  EXPECT_GT(solved, 200);
}

TEST(BasisPursuit, TakesDegenerateProblems) {
  Trial trial(1);
  MatrixXd D = trial.gaussian(6, 10);
  D.col(3) = D.col(2);
  D.col(7) = -D.col(2);
  D.col(5).setZero();
  for (int j = 0; j < 10; ++j) {
    if (j != 5) solved_both_ways(D, D.col(j));
  }
  D.colwise().normalize();
  D.col(5).setZero();
  const double norm = solved_both_ways(D, -4 * D.col(2));  // unit columns: none is shorter than itself
  EXPECT_NEAR(norm, 4, 1e-6);
  solved_both_ways(D, trial.gaussian(6, 1));
}

TEST(BasisPursuit, IsZeroForZero) {
  Trial trial(2);
  BasisPursuit solver(5, 9);
  ASSERT_TRUE(solver.solve(trial.gaussian(5, 9), trial.gaussian(5, 1)));
  ASSERT_TRUE(solver.solve(trial.gaussian(5, 9), VectorXd::Zero(5)));
  EXPECT_EQ(solver.entries(), VectorXd::Zero(9));
  EXPECT_EQ(solver.dual(), VectorXd::Zero(5));
}

TEST(BasisPursuit, KnowsNoScale) {
  Trial trial(3);
  const MatrixXd D = trial.gaussian(12, 18);
  const VectorXd b = trial.gaussian(12, 1);
  const double norm = solved_both_ways(D, b);
  for (const double of_b : {1e-300, 1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e200}) {
    EXPECT_NEAR(solved_both_ways(D, of_b * b) / of_b, norm, 1e-6 * norm) << of_b;
    BasisPursuit solver(12, 18);
    ASSERT_TRUE(solver.solve(D, of_b * b));
    EXPECT_FALSE(solver.finished_by_simplex());
  }
  for (const double of_D : {1e-100, 1e-6, 1e6, 1e100}) {
    EXPECT_NEAR(solved_both_ways(of_D * D, b) * of_D, norm, 1e-6 * norm) << of_D;
  }
  VectorXd of_rows(12);
  for (double& factor : of_rows) factor = std::pow(10, 12 * trial.uniform() - 6);
  EXPECT_NEAR(solved_both_ways(of_rows.asDiagonal() * D, of_rows.cwiseProduct(b)), norm, 1e-6 * norm);
}

TEST(BasisPursuit, RefusesRowsThatAreNearlyDependent) {
  Trial trial(8);
  MatrixXd D = trial.gaussian(4, 7);
  const VectorXd b = trial.gaussian(4, 1);
  const Eigen::RowVectorXd other = trial.gaussian(1, 7);
  D.row(3) = D.row(1) + 1e-7 * other;
  BasisPursuit solver(4, 7);
  EXPECT_FALSE(solver.solve(D, b));
  D.row(3) = D.row(1) + 1e-5 * other;
  solved_both_ways(D, b);
}

TEST(BasisPursuit, FinishesByTheSimplexFromAnyIterate) {
  Trial trial(4);
  const MatrixXd D = trial.orthonormal(36, 6);
  const VectorXd b = trial.gaussian(30, 1);
  BasisPursuit whole(30, 36);
  ASSERT_TRUE(whole.solve(D, b));
  ASSERT_FALSE(whole.finished_by_simplex());
  const double norm = whole.entries().lpNorm<1>();
  for (int iterations = 0; iterations < whole.iterations(); ++iterations) {
    BasisPursuit cut(30, 36, iterations);
    ASSERT_TRUE(cut.solve(D, b)) << iterations;
    EXPECT_TRUE(cut.finished_by_simplex());
    EXPECT_EQ(cut.iterations(), iterations);
    expect_optimum(cut, D, b);
    EXPECT_NEAR(cut.entries().lpNorm<1>(), norm, 1e-7 * norm);
  }
}

TEST(BasisPursuit, SaysSoWhereItCannot) {
  Trial trial(5);
  const MatrixXd D = trial.gaussian(4, 7);
  const VectorXd b = trial.gaussian(4, 1);
  BasisPursuit solver(4, 7);
  const auto refuses = [&](const MatrixXd& matrix, const VectorXd& right) {
    EXPECT_TRUE(solver.solve(D, b));
    return !solver.solve(matrix, right) && solver.entries() == VectorXd::Zero(7) && solver.dual() == VectorXd::Zero(4);
  };
  MatrixXd twice = D, empty = D, sum = D;
  twice.row(3) = -2 * D.row(1);
  empty.row(2).setZero();
  sum.row(0) = D.row(1) + D.row(2) + D.row(3);
  for (const MatrixXd& dependent : {twice, empty, sum}) {
    EXPECT_TRUE(refuses(dependent, b));
    EXPECT_TRUE(refuses(dependent, dependent.col(0))) << "a solution may exist";
  }
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    MatrixXd spoilt = D;
    spoilt(1, 4) = bad;
    VectorXd right = b;
    right[3] = bad;
    EXPECT_TRUE(refuses(spoilt, b));
    EXPECT_TRUE(refuses(D, right));
  }
  EXPECT_TRUE(refuses(D.leftCols(6), b));
  EXPECT_TRUE(refuses(D, b.head(3)));
  EXPECT_TRUE(refuses(1e-300 * D, 1e100 * b)) << "the answer overflows";
  BasisPursuit tall(3, 2), nothing;
  EXPECT_FALSE(tall.solve(trial.gaussian(3, 2), trial.gaussian(3, 1)));
  EXPECT_FALSE(nothing.solve(MatrixXd(0, 0), VectorXd(0)));
}

#ifdef VIGIL_COUNTS_MALLOC

TEST(BasisPursuit, AllocatesNothing) {
  Trial trial(6);
  for (const auto& [rows, columns] : {Size{30, 36}, {66, 72}}) {
    const MatrixXd D = trial.orthonormal(columns, columns - rows);
    const VectorXd b = trial.gaussian(rows, 1);
    for (const int iterations : {60, 5, 0}) {
      BasisPursuit solver(rows, columns, iterations);
      bool solved = false;
      EXPECT_EQ(allocations_in([&] { solved = solver.solve(D, b); }), 0) << rows << " rows, " << iterations;
      EXPECT_TRUE(solved);
      BasisPursuit copy(solver);
      EXPECT_EQ(allocations_in([&] { copy.solve(D, b); }), 0);
    }
  }
}

#endif

}  // namespace
}  // namespace vigil::basis_pursuit_test
