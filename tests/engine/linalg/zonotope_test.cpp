#include "engine/linalg/zonotope.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "tests/engine/allocations.hpp"
#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil::zonotope_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double support(const MatrixXd& H, const VectorXd& d) { return (d.transpose() * H).cwiseAbs().sum(); }

/// The largest |n'z| / sum |n'H_j| over the normals of every p - 1 generators that are independent.
double over_all_facets(const MatrixXd& H, const VectorXd& z) {
  const auto p = H.rows(), m = H.cols();
  std::vector<char> chosen(static_cast<std::size_t>(m), 0);
  std::fill(chosen.begin(), chosen.begin() + (p - 1), 1);
  double most = 0;
  do {
    MatrixXd rows(p - 1, p);
    for (Eigen::Index j = 0, row = 0; j < m; ++j) {
      if (chosen[static_cast<std::size_t>(j)] != 0) rows.row(row++) = H.col(j).transpose();
    }
    Eigen::FullPivLU<MatrixXd> lu(rows);
    lu.setThreshold(1e-10);
    if (lu.rank() < p - 1) continue;
    const VectorXd normal = lu.kernel().col(0).normalized();
    most = std::max(most, std::abs(normal.dot(z)) / support(H, normal));
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return most;
}

/// Generators as they come in practice: general ones, parallel ones, some on the axes, zeros, all sizes.
MatrixXd generators(RandomMatrices& random, int p, int columns, int kind) {
  MatrixXd H = random.gaussian(p, columns);
  if (kind == 1) H = H.array().round();
  if (kind == 2) {
    for (int j = p; j < columns; ++j) H.col(j) = H.col(random.below(p)) * random.normal();
    H.col(columns - 1).setZero();
  }
  if (kind == 3) {
    for (int j = 0; j < columns; ++j) H.col(j) *= random.log_uniform(1e-6, 1);
  }
  if (kind == 4) {
    for (int j = 1; j < columns; ++j) H.col(j).tail(p - 2).setZero();  // many on one plane
    H.rightCols(p).setIdentity();
  }
  return H;
}

TEST(Zonotope, ReductionIsTheSectionsAndContainsWhatItReplaces) {
  for (int number = 0; number < 200; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(number);
    const int p = 1 + random.below(4), columns = 1 + random.below(30), order = p + random.below(20);
    const MatrixXd H = random.gaussian(p, columns), less = reduce(H, order);
    for (int direction = 0; direction < 30; ++direction) {
      const VectorXd d = random.vector(p);
      EXPECT_GE(support(less, d), support(H, d) * (1 - 1e-12));
    }
    if (columns <= order) {
      EXPECT_EQ(less, H);
      continue;
    }
    ASSERT_EQ(less.cols(), order);
    std::vector<VectorXd> sorted;  // by insertion: longer ones before shorter ones
    for (int j = 0; j < columns; ++j) {
      auto place = sorted.begin();
      while (place != sorted.end() && place->norm() >= H.col(j).norm()) ++place;
      sorted.insert(place, H.col(j));
    }
    VectorXd box = VectorXd::Zero(p);
    for (int j = 0; j < columns; ++j) {
      const VectorXd& column = sorted[static_cast<std::size_t>(j)];
      if (j < order - p) {
        EXPECT_EQ(VectorXd(less.col(j)), column);
      } else {
        box += column.cwiseAbs();
      }
    }
    EXPECT_LE((less.rightCols(p) - MatrixXd(box.asDiagonal())).norm(), 1e-14 * box.norm());
  }
}

TEST(Zonotope, ReductionKeepsTheOrderOfEqualGenerators) {
  MatrixXd H(2, 5);
  H << 3, 0, 4, 5, 0.1, 4, 5, 3, 0, 0;
  const MatrixXd less = reduce(H, 4);
  MatrixXd expected(2, 4);
  expected << 3, 0, 9.1, 0, 4, 5, 0, 3;
  EXPECT_LE((less - expected).norm(), 1e-15);
  EXPECT_EQ(reduce(H, 0).cols(), 2);  // a box at least
}

TEST(Zonotope, HalfWidthsAreTheSupportAlongTheAxes) {
  RandomMatrices random(1);
  const MatrixXd H = random.gaussian(3, 7);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(half_widths(H)[i], support(H, VectorXd::Unit(3, i)), 1e-14);
}

TEST(Zonotope, RatioIsThatOfTheTightestFacet) {
  for (int number = 0; number < 1000; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(1000 + number);
    const int p = 2 + number % 4, kind = (number / 4) % (p > 2 ? 5 : 4);
    const MatrixXd H = generators(random, p, 2 * p + random.below(6), kind);
    if (Eigen::FullPivLU<MatrixXd>(H).rank() < p) continue;
    for (int point = 0; point < 3; ++point) {
      const VectorXd z = point == 0 ? random.vector(p) : H * VectorXd::NullaryExpr(H.cols(), [&] {
                                                           return point == 1 ? 2 * random.uniform() - 1
                                                                             : (random.uniform() < 0.5 ? -1.0 : 1.0);
                                                         });
      if (z.isZero()) continue;
      const double expected = over_all_facets(H, z);
      EXPECT_NEAR(ratio(H, z), expected, 1e-9 * expected) << "p " << p << " kind " << kind;
      EXPECT_EQ(contains(H, z), expected <= 1 + 1e-9);
      EXPECT_TRUE(point == 0 || contains(H, z));
      EXPECT_TRUE(contains(H, z / expected * (1 - 1e-8)));
      EXPECT_FALSE(contains(H, z / expected * (1 + 1e-8)));
    }
  }
}

TEST(Zonotope, RatioHoldsForAsManyGeneratorsAsAScheduleKeeps) {
  for (int number = 0; number < 40; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(3000 + number);
    const int p = 3 + number % 2;
    const MatrixXd H = generators(random, p, 26, number % 2 == 0 ? 0 : 1);
    const VectorXd z = random.vector(p);
    const double expected = over_all_facets(H, z);
    EXPECT_NEAR(ratio(H, z), expected, 1e-9 * expected);
  }
}

// Everything is a tie here: whole numbers, every generator many times.
TEST(Zonotope, TiesEverywhereEndInTheSameVerdict) {
  for (int number = 0; number < 300; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(4000 + number);
    const int p = 3 + number % 3;
    MatrixXd H(p, 4 * p);
    for (Eigen::Index i = 0; i < H.size(); ++i) H.data()[i] = random.below(3) - 1;
    H.leftCols(p).setIdentity();
    H.middleCols(p, p) = H.leftCols(p);
    VectorXd z(p);
    for (double& entry : z) entry = random.below(7) - 3;
    if (z.isZero()) continue;
    const double expected = over_all_facets(H, z);
    EXPECT_NEAR(ratio(H, z), expected, 1e-10 * expected);
  }
}

TEST(Zonotope, OfABoxItIsTheLargestCoordinate) {
  for (int p = 1; p <= 12; ++p) {
    RandomMatrices random(5000 + p);
    const VectorXd sizes = VectorXd::NullaryExpr(p, [&] { return random.log_uniform(1e-3, 1e3); });
    const VectorXd z = random.vector(p);
    const double expected = z.cwiseQuotient(sizes).cwiseAbs().maxCoeff();
    EXPECT_NEAR(ratio(sizes.asDiagonal().toDenseMatrix(), z), expected, 1e-12 * expected);
    const MatrixXd T = random.orthogonal(p);
    EXPECT_NEAR(ratio(T * sizes.asDiagonal(), T * z), expected, 1e-9 * expected);
  }
}

TEST(Zonotope, AFlatOneIsMeasuredInItsOwnPlane) {
  for (int number = 0; number < 200; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(6000 + number);
    const int p = 2 + random.below(4), rank = 1 + random.below(p - 1);
    const MatrixXd T = random.orthogonal(p).leftCols(rank), H = random.gaussian(rank, rank + random.below(5));
    const VectorXd z = random.vector(rank), off = random.vector(p);
    const double expected = rank == 1 ? std::abs(z[0]) / H.cwiseAbs().sum() : over_all_facets(H, z);
    EXPECT_NEAR(ratio(T * H, T * z), expected, 1e-8 * expected);
    EXPECT_EQ(ratio(T * H, T * z + 1e-3 * (off - T * (T.transpose() * off))), kInfinity);
  }
}

TEST(Zonotope, DegenerateOnesAreDecided) {
  const MatrixXd none(3, 0), zero = MatrixXd::Zero(3, 4);
  for (const auto& H : {none, zero}) {
    EXPECT_TRUE(contains(H, VectorXd::Zero(3)));
    EXPECT_EQ(ratio(H, VectorXd::Unit(3, 1)), kInfinity);
    EXPECT_TRUE(contains(H.topRows(2), VectorXd::Zero(2)));
    EXPECT_FALSE(contains(H.topRows(2), VectorXd::Unit(2, 1)));
    EXPECT_TRUE(contains(H.topRows(1), VectorXd::Zero(1)));
    EXPECT_FALSE(contains(H.topRows(1), VectorXd::Ones(1)));
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(contains(MatrixXd::Identity(3, 3), VectorXd::Constant(3, nan)));
  EXPECT_TRUE(std::isnan(ratio(nan * MatrixXd::Identity(3, 3), VectorXd::Ones(3))));
  EXPECT_NEAR(ratio(MatrixXd::Identity(3, 3), VectorXd::Constant(3, 1)), 1, 1e-15);
}

TEST(Zonotope, SizeDoesNotMatter) {
  RandomMatrices random(7);
  for (const int p : {2, 3, 5}) {
    const MatrixXd H = random.gaussian(p, 9);
    const VectorXd z = random.vector(p);
    const double expected = ratio(H, z);
    for (const double size : {1e-150, 1e-30, 1e30, 1e150}) {
      EXPECT_NEAR(ratio(size * H, size * z), expected, 1e-12 * expected);
      EXPECT_NEAR(ratio(size * H, z) * size, expected, 1e-12 * expected);
    }
  }
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(Zonotope, AVerdictInThePlaneAllocatesNothing) {
  RandomMatrices random(8);
  const MatrixXd H = random.gaussian(2, 24);
  const VectorXd z = random.vector(2);
  double value = 0;
  EXPECT_EQ(allocations_in([&] { value = ratio(H, z); }), 0);
  EXPECT_GT(value, 0);
}
#endif

}  // namespace
}  // namespace vigil::zonotope_test
