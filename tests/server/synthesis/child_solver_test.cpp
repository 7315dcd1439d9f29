// Solving in a child process: the same answer, and a verdict for whatever becomes of the child.
#include "server/synthesis/child_solver.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "engine/methods/observer/synthesis.hpp"
#include "engine/world/interconnected/examples.hpp"
#include "server/synthesis/dsdp_solver.hpp"
#include "tests/server/synthesis/scripts.hpp"

namespace vigil::api_test::child_solver_test {
namespace {

SdpProblem ring_problem(int subsystems) {
  return observer::theorem_1(observer::error_system(observer::ring(subsystems)), observer::ref()).problem;
}

/// Minimise the sum of y with diag(y) - F_0 >= 0, every entry of F_0 given: much to say, little to solve.
SdpProblem long_problem(int order) {
  SdpProblem problem;
  problem.cost.assign(static_cast<std::size_t>(order), 1);
  problem.blocks = {order};
  for (int row = 0; row < order; ++row) {
    for (int column = row; column < order; ++column) problem.entries.push_back({0, 0, row, column, 1e-3 / (1 + row)});
    problem.entries.push_back({row + 1, 0, row, row, 1});
  }
  canonicalise(problem);
  return problem;
}

class Child : public ::testing::Test {
 protected:
  SdpSolution ask(const std::string& body, double limit = 30) {
    ChildSolver solver(script(folder_, "child", body));
    return solver.solve(problem_, limit);
  }
  void expect_failed(const SdpSolution& solution, const std::string& words) {
    EXPECT_EQ(solution.verdict, SdpVerdict::failed);
    EXPECT_EQ(solution.y.size(), 0);
    EXPECT_NE(solution.detail.find(words), std::string::npos) << solution.detail;
  }
  TemporaryFolder folder_;
  const SdpProblem problem_ = ring_problem(2);
};

TEST_F(Child, AnswersAsTheSolverInThisProcessDoes) {
  DsdpSolver here;
  ChildSolver there(VIGIL_EXECUTABLE);
  const SdpSolution own = here.solve(problem_, 30), other = there.solve(problem_, 30);
  EXPECT_EQ(other.y, own.y);
  EXPECT_EQ(other.verdict, own.verdict);
  EXPECT_EQ(other.iterations, own.iterations);
  EXPECT_EQ(other.detail, own.detail);
  EXPECT_EQ(there.name(), here.name());
  EXPECT_GT(other.seconds, 0);
}

TEST_F(Child, TakesAProblemLongerThanAnyBuffer) {
  const SdpProblem problem = long_problem(170);
  ASSERT_GT(to_json(problem).dump().size(), 300'000u);
  ChildSolver solver(VIGIL_EXECUTABLE);
  const SdpSolution solution = solver.solve(problem, 60);
  EXPECT_EQ(solution.verdict, SdpVerdict::solved) << solution.detail;
  ASSERT_EQ(solution.y.size(), problem.variables());
  for (const double margin : smallest_eigenvalues(problem, solution.y)) EXPECT_GT(margin, -1e-6);
}

TEST_F(Child, IsEndedAtItsLimit) {
  ChildSolver solver(silent(folder_));
  const SdpSolution solution = solver.solve(problem_, 0.5);
  EXPECT_EQ(solution.verdict, SdpVerdict::timed_out);
  EXPECT_EQ(solution.detail, "no answer within 0.5 s");
  EXPECT_GE(solution.seconds, 0.5);
  EXPECT_TRUE(gone(child_of(folder_)));
}

/// The library looks at the clock between two steps only, and those of 750 unknowns take longer than the limit.
TEST_F(Child, IsEndedAtItsLimitInTheMiddleOfAStepOfTheLibrary) {
  ChildSolver solver(VIGIL_EXECUTABLE);
  EXPECT_EQ(solver.solve(ring_problem(20), 0.4).verdict, SdpVerdict::timed_out);
  EXPECT_EQ(solver.solve(problem_, 30).y.size(), problem_.variables());
}

TEST_F(Child, ThatReadsNothingIsEndedToo) {
  ChildSolver solver(silent(folder_));
  EXPECT_EQ(solver.solve(long_problem(170), 0.5).verdict, SdpVerdict::timed_out);
}

TEST_F(Child, WhateverBecomesOfItIsAVerdict) {
  expect_failed(ask("kill -9 $$"), "was ended by signal 9 (Killed) without an answer");
  expect_failed(ask("kill -SEGV $$"), "was ended by signal 11");
  expect_failed(ask("cat > /dev/null; exit 3"), "ended with code 3 without an answer");
  expect_failed(ask("exit 0"), "ended with code 0 without an answer");
  expect_failed(ask("cat > /dev/null; echo hello"), "said what is no solution");
  expect_failed(ask("cat > /dev/null; echo '{}'; kill -9 $$"), "was ended by signal 9 (Killed) and said");
  expect_failed(ask("cat"), "said what is no solution");
  expect_failed(ask("exec yes"), "more than any solution takes");
  const std::string rest = R"(,"verdict":"solved","iterations":1,"seconds":1,"detail":""})";
  expect_failed(ask(R"(cat > /dev/null; echo '{"y":[1])" + rest + "'"), "said what is no solution");
  expect_failed(ask(R"(cat > /dev/null; echo '{"y":[1e999])" + rest + "'"), "said what is no solution");
  expect_failed(ask(R"(cat > /dev/null; echo '{"y":[null])" + rest + "'"), "said what is no solution");
  ChildSolver nobody(folder_.file("missing"));
  expect_failed(nobody.solve(problem_, 30), "could not be started");
}

TEST_F(Child, AnAnswerCountsHoweverTheChildEnds) {
  const SdpSolution solution = ask(
      R"(cat > /dev/null; echo '{"y":[],"verdict":"infeasible","iterations":7,"seconds":1,"detail":"none"}'; exit 9)");
  EXPECT_EQ(solution.verdict, SdpVerdict::infeasible);
  EXPECT_EQ(solution.iterations, 7);
}

TEST_F(Child, IsCancelledFromAnotherThread) {
  ChildSolver solver(silent(folder_));
  SdpSolution solution;
  std::thread thread([&] { solution = solver.solve(problem_, 1000); });
  const pid_t pid = child_of(folder_);
  EXPECT_FALSE(gone(pid));
  solver.cancel();
  thread.join();
  expect_failed(solution, "cancelled");
  EXPECT_TRUE(gone(pid));
  expect_failed(solver.solve(problem_, 1000), "cancelled");
}

TEST_F(Child, OneWaitsForAnother) {
  const std::string body = "mkdir " + folder_.file("busy") + " || touch " + folder_.file("overlap") +
                           "; sleep 0.05; rmdir " + folder_.file("busy") + "; exec " VIGIL_EXECUTABLE " solve-sdp";
  const std::string executable = script(folder_, "child", body);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      ChildSolver solver(executable);
      EXPECT_EQ(solver.solve(problem_, 30).y.size(), problem_.variables());
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_FALSE(std::filesystem::exists(folder_.file("overlap")));
}

TEST_F(Child, WhoWaitsForAnotherCanBeCancelled) {
  ChildSolver first(silent(folder_)), second(VIGIL_EXECUTABLE);
  std::thread one([&] { first.solve(problem_, 1000); });
  child_of(folder_);
  SdpSolution solution;
  std::thread other([&] { solution = second.solve(problem_, 1000); });
  second.cancel();
  other.join();
  expect_failed(solution, "cancelled");
  first.cancel();
  one.join();
}

TEST_F(Child, DiesWithItsParent) {
  const std::string executable = silent(folder_);
  const pid_t parent = fork();
  if (parent == 0) {
    ChildSolver solver(executable);
    solver.solve(problem_, 1000);
    _exit(0);
  }
  const pid_t pid = child_of(folder_);
  EXPECT_FALSE(gone(pid));
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  EXPECT_TRUE(eventually([&] { return gone(pid); }));
}

}  // namespace
}  // namespace vigil::api_test::child_solver_test
