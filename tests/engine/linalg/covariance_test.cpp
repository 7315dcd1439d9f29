#include "engine/linalg/covariance.hpp"

#include <gtest/gtest.h>

#include "engine/core/input_error.hpp"
#include "engine/linalg/small.hpp"
#include "engine/random/draws.hpp"

namespace vigil::covariance_test {
namespace {

Eigen::MatrixXd random_matrix(int rows, int columns, std::int64_t tick) {
  Eigen::VectorXd draw(rows * columns);
  Draws(1, "matrix").normals(tick, draw);
  return draw.reshaped(rows, columns);
}

TEST(SymmetricRoot, SquaresToTheMatrix) {
  for (int tick = 0; tick < 20; ++tick) {
    const Eigen::MatrixXd half = random_matrix(4, 4, tick);
    const Eigen::MatrixXd matrix = half * half.transpose();
    const Eigen::MatrixXd root = symmetric_root(matrix);
    EXPECT_TRUE((root * root).isApprox(matrix, 1e-12));
    EXPECT_TRUE(root.isApprox(root.transpose(), 1e-12));
  }
}

TEST(SymmetricRoot, TakesSingularMatrices) {
  EXPECT_TRUE(symmetric_root(Eigen::Matrix3d::Zero()).isZero());
  const Eigen::MatrixXd thin = random_matrix(4, 2, 3);
  const Eigen::MatrixXd matrix = thin * thin.transpose();
  const Eigen::MatrixXd root = symmetric_root(matrix);
  EXPECT_TRUE(root.allFinite());
  EXPECT_TRUE((root * root).isApprox(matrix, 1e-7));  // roots of rounding: 1e-16 becomes 1e-8
}

TEST(ReadCovariance, TakesEveryForm) {
  EXPECT_EQ(read_covariance(2.5, 2, "/Q", Definiteness::definite), (Eigen::Matrix2d() << 2.5, 0, 0, 2.5).finished());
  EXPECT_EQ(read_covariance({1, 0}, 2, "/Q", Definiteness::semidefinite), (Eigen::Matrix2d() << 1, 0, 0, 0).finished());
  EXPECT_EQ(read_covariance(Json::parse("[[2,1],[1,2]]"), 2, "/Q", Definiteness::definite),
            (Eigen::Matrix2d() << 2, 1, 1, 2).finished());
  EXPECT_EQ(read_covariance(0, 3, "/Q", Definiteness::semidefinite), Eigen::Matrix3d::Zero());
}

struct Bad {
  const char* json;
  int n;
  Definiteness kind;
};

class BadCovariance : public testing::TestWithParam<Bad> {};

TEST_P(BadCovariance, IsRefusedAtItsPointer) {
  try {
    read_covariance(Json::parse(GetParam().json), GetParam().n, "/noise/Q", GetParam().kind);
    FAIL() << GetParam().json;
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U);
    EXPECT_EQ(error.problems()[0].pointer, "/noise/Q");
    EXPECT_FALSE(error.problems()[0].detail.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Covariance, BadCovariance,
    testing::Values(Bad{"[1,2]", 3, Definiteness::semidefinite}, Bad{"[1,2,3,4]", 3, Definiteness::semidefinite},
                    Bad{"[[1,2],[0,1]]", 2, Definiteness::semidefinite},
                    Bad{"[[1,0],[0]]", 2, Definiteness::semidefinite}, Bad{"[1,-1e-3]", 2, Definiteness::semidefinite},
                    Bad{"[[1,2],[2,1]]", 2, Definiteness::semidefinite}, Bad{"[1,0]", 2, Definiteness::definite},
                    Bad{"0", 2, Definiteness::definite}, Bad{"\"I\"", 2, Definiteness::semidefinite},
                    Bad{"[]", 2, Definiteness::semidefinite}, Bad{"[1,null]", 2, Definiteness::semidefinite},
                    Bad{"null", 2, Definiteness::semidefinite}, Bad{"{}", 2, Definiteness::semidefinite}));

TEST(Symmetrise, TakesTheMean) {
  Eigen::Matrix2d a;
  a << 1, 2, 4, 3;
  symmetrise(a);
  EXPECT_EQ(a, (Eigen::Matrix2d() << 1, 3, 3, 3).finished());
}

}  // namespace
}  // namespace vigil::covariance_test
