#include "engine/linalg/ellipsoid.hpp"

#include <gtest/gtest.h>

#include "engine/linalg/small.hpp"
#include "tests/engine/allocations.hpp"
#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil::ellipsoid_test {
namespace {

using Eigen::MatrixXd;

/// How far the ellipsoid reaches along d.
double support(const MatrixXd& E, const Eigen::VectorXd& d) { return std::sqrt(std::max(0.0, d.dot(E * d))); }

TEST(Ellipsoid, TheSumContainsTheMinkowskiSum) {
  for (int number = 0; number < 200; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(number);
    const int n = 1 + random.below(6);
    std::vector<MatrixXd> operands;
    for (int i = 0; i < 2 + random.below(5); ++i) {
      operands.push_back(random.log_uniform(1e-4, 1e4) * random.semidefinite(n, random.below(n + 1)));
    }
    const MatrixXd two = minimum_trace_sum(operands[0], operands[1]), all = minimum_trace_sum(operands);
    for (int direction = 0; direction < 50; ++direction) {
      const Eigen::VectorXd d = random.vector(n);
      EXPECT_GE(support(two, d), (support(operands[0], d) + support(operands[1], d)) * (1 - 1e-12));
      double reach = 0;
      for (const auto& E : operands) reach += support(E, d);
      EXPECT_GE(support(all, d), reach * (1 - 1e-12));
    }
  }
}

TEST(Ellipsoid, NoOtherOfTheFamilyHasASmallerTrace) {
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(1000 + number);
    const int n = 1 + random.below(6);
    const MatrixXd E1 = random.log_uniform(1e-3, 1e3) * random.definite(n), E2 = random.definite(n);
    const MatrixXd sum = minimum_trace_sum(E1, E2);
    double least = std::numeric_limits<double>::infinity();
    for (double exponent = -4; exponent <= 4; exponent += 0.001) {
      const double q = std::pow(10, exponent);
      const double trace = ((1 + q) * E1 + (1 + 1 / q) * E2).trace();
      EXPECT_GE(trace, sum.trace() * (1 - 1e-12));
      least = std::min(least, trace);
    }
    EXPECT_NEAR(least, sum.trace(), 1e-5 * least);
    const double q = std::sqrt(E2.trace() / E1.trace());
    EXPECT_LE((sum - ((1 + q) * E1 + (1 + 1 / q) * E2)).norm(), 1e-13 * sum.norm());
  }
}

TEST(Ellipsoid, ManyAreTheSameAddedOneByOne) {
  for (int number = 0; number < 50; ++number) {
    RandomMatrices random(2000 + number);
    const int n = 1 + random.below(5);
    std::vector<MatrixXd> operands;
    for (int i = 0; i < 1 + random.below(6); ++i) operands.push_back(random.semidefinite(n, random.below(n + 1)));
    MatrixXd folded = operands[0];
    for (std::size_t i = 1; i < operands.size(); ++i) folded = minimum_trace_sum(folded, operands[i]);
    EXPECT_LE((minimum_trace_sum(operands) - folded).norm(), 1e-12 * folded.norm());
  }
}

TEST(Ellipsoid, APointAddsNothing) {
  RandomMatrices random(1);
  const MatrixXd E = random.definite(3), zero = MatrixXd::Zero(3, 3);
  EXPECT_EQ(minimum_trace_sum(E, zero), E);
  EXPECT_EQ(minimum_trace_sum(zero, E), E);
  EXPECT_EQ(minimum_trace_sum(zero, zero), zero);
  EXPECT_EQ(minimum_trace_sum(std::vector<MatrixXd>{zero, zero}), zero);
  EXPECT_LE((minimum_trace_sum(std::vector<MatrixXd>{zero, E, zero}) - E).norm(), 1e-15 * E.norm());
}

TEST(Ellipsoid, NoSizeIsTooSmallOrTooLarge) {
  RandomMatrices random(2);
  const MatrixXd E = random.definite(3);
  for (const double size : {1e-300, 1e-160, 1e160, 1e300}) {
    const MatrixXd sum = minimum_trace_sum(E, size * E);
    EXPECT_TRUE(sum.allFinite());
    EXPECT_LE((sum - std::pow(1 + std::sqrt(size), 2) * E).norm(), 1e-12 * sum.norm());
  }
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(Ellipsoid, AddingBoundedMatricesAllocatesNothing) {
  RandomMatrices random(3);
  const BoundedMatrix E1 = random.definite(4), E2 = random.definite(4);
  BoundedMatrix sum;
  EXPECT_EQ(allocations_in([&] { sum = minimum_trace_sum(E1, E2); }), 0);
}
#endif

}  // namespace
}  // namespace vigil::ellipsoid_test
