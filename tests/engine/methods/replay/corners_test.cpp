/// Where the optimum of section 4.5 lies at an end of its range, against a search over the gain itself.
#include <gtest/gtest.h>

#include "engine/methods/replay/mixed_update.hpp"
#include "tests/engine/methods/replay/mixed_reference.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::replay::corners_test {
namespace {

using Eigen::MatrixXd;
using reference::Problem;

/// Left over right side of the condition for K = C^-1: optimal up to 1.
double of_inverse(const Problem& problem) {
  const MatrixXd back = problem.C.inverse();
  const MatrixXd Nv = back * problem.Mv * back.transpose(), Nr = back * problem.R * back.transpose();
  const MatrixXd D = (1 - problem.mu) * Nv + problem.mu * Nr;
  return (D * problem.Mp.inverse() * D).trace() / (std::pow(1 - problem.mu, 2) * Nv.trace());
}

/// The same for K = 0.
double of_zero(const Problem& problem) {
  const MatrixXd D2 = ((1 - problem.mu) * problem.Mp + problem.mu * problem.Qp) * problem.C.transpose();
  return (D2 * problem.Mv.inverse() * D2.transpose()).trace() / (std::pow(1 - problem.mu, 2) * problem.Mp.trace());
}

/// Square sensors, mixed so that all three cases are frequent.
Problem problem_of(int number) {
  RandomMatrices random(number);
  const int n = 1 + random.below(3);
  Problem problem = reference::random_problem(random, n, n);
  if (number % 3 == 0) problem.Mp *= 30;
  if (number % 3 == 1) problem.Mv *= 300;
  if (number % 5 == 0) problem.mu = 0;
  return problem;
}

TEST(Corners, AreWhereTheConditionsSayAndNoSearchFindsALowerCost) {
  int corner[3] = {0, 0, 0};
  for (int number = 0; number < 300; ++number) {
    SCOPED_TRACE(number);
    const Problem problem = problem_of(number);
    const auto gain = MixedUpdate(problem.C, problem.R, problem.Mv, problem.mu).update(problem.Qp, problem.Mp);
    ASSERT_TRUE(gain);
    const double inverse = of_inverse(problem), zero = of_zero(problem);
    EXPECT_GT(std::min(std::abs(inverse - 1), std::abs(zero - 1)), 1e-6) << "too close to call";
    EXPECT_EQ(gain->corner == Corner::infinite, inverse < 1) << inverse;
    EXPECT_EQ(gain->corner == Corner::zero, zero < 1) << zero;
    ++corner[static_cast<int>(gain->corner)];

    RandomMatrices random(10000 + number);
    const auto n = problem.C.cols();
    const reference::Long K = reference::extended(gain->K);
    const long double chosen = reference::least_cost(problem, K);
    long double found = reference::searched_cost(problem, K, random);
    for (const MatrixXd& start : {MatrixXd(MatrixXd::Zero(n, n)), MatrixXd(0.9 * problem.C.inverse())}) {
      found = std::min(found, reference::searched_cost(problem, reference::extended(start), random));
    }
    EXPECT_LE(chosen, found * (1 + 1e-9L));
    for (const bool at_inverse : {true, false}) {
      const MatrixXd end = at_inverse ? MatrixXd(problem.C.inverse()) : MatrixXd(MatrixXd::Zero(n, n));
      const long double of_end = reference::least_cost(problem, reference::extended(end));
      const double condition = at_inverse ? inverse : zero;
      EXPECT_TRUE(condition > 1 || of_end <= found * (1 + 1e-9L));
      EXPECT_TRUE(condition < 1.01 || of_end > found);
    }
    EXPECT_NEAR(static_cast<double>(chosen),
                static_cast<double>(problem.mu * gain->Q.trace() + (1 - problem.mu) * gain->M.trace()),
                1e-9 * static_cast<double>(chosen));
  }
  for (const int count : corner) EXPECT_GT(count, 40);
}

// The search of the test itself leaves a gain that is off, or what it does not find would prove nothing.
TEST(Corners, TheSearchFindsTheWayFromAGainThatIsOff) {
  for (int number = 0; number < 40; ++number) {
    SCOPED_TRACE(number);
    const Problem problem = problem_of(number);
    const auto gain = MixedUpdate(problem.C, problem.R, problem.Mv, problem.mu).update(problem.Qp, problem.Mp);
    RandomMatrices random(20000 + number);
    const auto n = problem.C.cols();
    const double best = problem.mu * gain->Q.trace() + (1 - problem.mu) * gain->M.trace();
    const MatrixXd start = MatrixXd(gain->K) + 0.01 * (1 + gain->K.norm()) * random.gaussian(n, n);
    const auto of_start = static_cast<double>(reference::least_cost(problem, reference::extended(start)));
    const auto found = static_cast<double>(reference::searched_cost(problem, reference::extended(start), random));
    EXPECT_GE(of_start, best);
    EXPECT_GE(found, best * (1 - 1e-9));
    EXPECT_LE(found - best, 0.2 * (of_start - best));
  }
}

TEST(Corners, ASensorThatIsNotSquareHasNoInverseToTake) {
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(30000 + number);
    const int n = 2 + random.below(2), p = number % 2 == 0 ? n - 1 : n + 1;
    Problem problem = reference::random_problem(random, n, p);
    problem.Mp *= number % 4 < 2 ? 1000 : 1;
    const auto gain = MixedUpdate(problem.C, problem.R, problem.Mv, problem.mu).update(problem.Qp, problem.Mp);
    ASSERT_TRUE(gain);
    const reference::Long K = reference::extended(gain->K);
    const long double chosen = reference::least_cost(problem, K);
    EXPECT_LE(chosen, reference::searched_cost(problem, K, random, 3000) * (1 + 1e-7L));
    if (gain->corner != Corner::infinite) continue;
    const reference::Long expected = reference::gain(problem, 1e-9L);
    EXPECT_LE(reference::distance(gain->K, expected), 1e-8 * gain->K.norm());
  }
}

TEST(Corners, ABoundOnZetaIsNoCorner) {
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    const Problem problem = problem_of(number);
    const auto gain = MixedUpdate(problem.C, problem.R, problem.Mv, problem.mu, 1).update(problem.Qp, problem.Mp);
    ASSERT_TRUE(gain);
    EXPECT_NE(gain->corner, Corner::infinite);
    EXPECT_LE(gain->zeta, 1 + 1e-12);
    const MatrixXd K = gain->K, X = MatrixXd::Identity(K.rows(), K.rows()) - K * problem.C;
    if (gain->corner == Corner::zero) continue;
    const MatrixXd M =
        (1 + gain->zeta) * X * problem.Mp * X.transpose() + (1 + 1 / gain->zeta) * K * problem.Mv * K.transpose();
    EXPECT_LE((gain->M - M).norm(), 1e-9 * M.norm());
  }
}

}  // namespace
}  // namespace vigil::replay::corners_test
