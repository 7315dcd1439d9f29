#include "server/synthesis/dsdp_solver.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/methods/observer/synthesis.hpp"
#include "engine/world/interconnected/examples.hpp"
#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil::dsdp_solver_test {
namespace {

SdpProblem problem(std::vector<double> cost, std::vector<int> blocks, std::vector<SdpEntry> entries) {
  SdpProblem made{.cost = std::move(cost), .blocks = std::move(blocks), .entries = std::move(entries)};
  canonicalise(made);
  return made;
}

/// The least t with t I - A >= 0.
SdpProblem largest_eigenvalue(const Eigen::MatrixXd& A) {
  SdpProblem made{.cost = {1}, .blocks = {static_cast<int>(A.rows())}};
  for (int row = 0; row < A.rows(); ++row) {
    made.entries.push_back({1, 0, row, row, 1});
    for (int column = row; column < A.cols(); ++column) made.entries.push_back({0, 0, row, column, A(row, column)});
  }
  canonicalise(made);
  return made;
}

TEST(Dsdp, FindsTheLargestEigenvalue) {
  DsdpSolver solver;
  for (int number = 0; number < 10; ++number) {
    RandomMatrices random(number);
    const int n = 1 + random.below(12);
    const Eigen::MatrixXd A = random.definite(n) - 3 * random.semidefinite(n, 1);
    const double exact = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().maxCoeff();
    const SdpSolution solution = solver.solve(largest_eigenvalue(A), 30);
    ASSERT_EQ(solution.verdict, SdpVerdict::solved) << solution.detail;
    EXPECT_NEAR(solution.y[0], exact, 1e-5 * (1 + std::abs(exact)));
    EXPECT_GT(solution.iterations, 0);
  }
}

TEST(Dsdp, SolvesWithSeveralBlocksAndAnEntryOffTheDiagonal) {
  // min 2 y1 + y2 with [y1 1; 1 y2] >= 0 and y2 <= 5: y1 y2 = 1, y2 = 2 y1.
  const SdpProblem made =
      problem({2, 1}, {2, 1}, {{1, 0, 0, 0, 1}, {2, 0, 1, 1, 1}, {0, 0, 0, 1, -1}, {2, 1, 0, 0, -1}, {0, 1, 0, 0, -5}});
  const SdpSolution solution = DsdpSolver().solve(made, 30);
  ASSERT_EQ(solution.verdict, SdpVerdict::solved) << solution.detail;
  EXPECT_NEAR(solution.y[0], std::sqrt(0.5), 1e-4);
  EXPECT_NEAR(solution.y[1], std::sqrt(2), 1e-4);
  EXPECT_NEAR(objective(made, solution.y), 2 * std::sqrt(2), 1e-5);
}

TEST(Dsdp, SaysWhereNothingFits) {
  const SdpProblem made = problem({1}, {1, 1}, {{1, 0, 0, 0, 1}, {0, 0, 0, 0, 1}, {1, 1, 0, 0, -1}, {0, 1, 0, 0, 1}});
  const SdpSolution solution = DsdpSolver().solve(made, 30);  // y >= 1 and -y >= 1
  EXPECT_EQ(solution.verdict, SdpVerdict::infeasible) << solution.detail;
}

TEST(Dsdp, AnswersTheSameTwice) {
  const auto synthesis = observer::theorem_1(observer::error_system(observer::single().network), observer::fast());
  DsdpSolver solver;
  const SdpSolution once = solver.solve(synthesis.problem, 30), again = solver.solve(synthesis.problem, 30);
  EXPECT_EQ(once.y, again.y);
  EXPECT_EQ(once.iterations, again.iterations);
  EXPECT_EQ(solver.solve(read_sdpa(to_sdpa(synthesis.problem)), 30).y, once.y);
}

TEST(Dsdp, StopsAtItsLimit) {
  const auto synthesis = observer::theorem_1(observer::error_system(observer::ring(8)), observer::ref());
  for (const double limit : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const SdpSolution solution = DsdpSolver().solve(synthesis.problem, limit);
    EXPECT_EQ(solution.verdict, SdpVerdict::timed_out);
    EXPECT_LE(solution.iterations, 2);
  }
  const auto small = observer::theorem_1(observer::error_system(observer::single().network), observer::ref());
  EXPECT_NE(DsdpSolver().solve(small.problem, std::numeric_limits<double>::infinity()).verdict, SdpVerdict::timed_out);
}

TEST(Dsdp, DoesNotFallOverOddProblems) {
  DsdpSolver solver;
  EXPECT_EQ(solver.solve({}, 1).verdict, SdpVerdict::failed);
  EXPECT_EQ(solver.solve({.cost = {1}}, 1).verdict, SdpVerdict::failed);
  const SdpProblem idle = problem({1, 1}, {2}, {{1, 0, 0, 0, 1}, {1, 0, 1, 1, 1}, {0, 0, 0, 0, 1}});  // y2 is nowhere
  const SdpSolution solution = solver.solve(idle, 5);
  EXPECT_NE(solution.verdict, SdpVerdict::infeasible);
}

}  // namespace
}  // namespace vigil::dsdp_solver_test
