#include "engine/linalg/sdp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/core/input_error.hpp"
#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil::sdp_test {
namespace {

/// Entries on both sides of the diagonal, some twice, some that cancel.
SdpProblem untidy(int number) {
  RandomMatrices random(number);
  SdpProblem problem;
  problem.blocks = {1, 4, 3};
  problem.cost = {random.normal(), 0, random.log_uniform(1e-12, 1e12), -random.uniform()};
  for (int k = 0; k < 60; ++k) {
    const int block = random.below(3), order = problem.blocks[static_cast<std::size_t>(block)];
    problem.entries.push_back({random.below(5), block, random.below(order), random.below(order),
                               random.normal() * random.log_uniform(1e-9, 1e9)});
  }
  problem.entries.push_back({1, 0, 0, 0, 1.5});
  problem.entries.push_back({1, 0, 0, 0, -1.5});
  return problem;
}

SdpProblem tidy(int number) {
  SdpProblem problem = untidy(number);
  canonicalise(problem);
  return problem;
}

TEST(SemidefiniteProgram, ReadsEntriesOnceSortedInTheUpperTriangle) {
  SdpProblem problem{.cost = {1, 2}, .blocks = {2, 1}};
  problem.entries = {{2, 1, 0, 0, 3}, {1, 0, 1, 0, 4}, {0, 0, 1, 1, 5},
                     {1, 0, 0, 1, 6}, {2, 0, 0, 0, 1}, {2, 0, 0, 0, -1}};
  canonicalise(problem);
  const std::vector<SdpEntry> expected = {{0, 0, 1, 1, 5}, {1, 0, 0, 1, 10}, {2, 1, 0, 0, 3}};
  EXPECT_EQ(problem.entries, expected);
}

TEST(SemidefiniteProgram, EvaluatesItsBlocks) {
  SdpProblem problem{.cost = {3, -1}, .blocks = {2, 1}};
  problem.entries = {{0, 0, 0, 0, -1}, {0, 0, 1, 1, -1}, {1, 0, 0, 1, 1}, {2, 1, 0, 0, 2}, {0, 1, 0, 0, 1}};
  canonicalise(problem);
  const Eigen::Vector2d y(0.25, 3);
  EXPECT_DOUBLE_EQ(objective(problem, y), -2.25);
  const auto blocks = blocks_at(problem, y);  // I + y1 [0 1; 1 0], 2 y2 - 1
  EXPECT_EQ(blocks[0], (Eigen::Matrix2d() << 1, 0.25, 0.25, 1).finished());
  EXPECT_EQ(blocks[1](0, 0), 5);
  const auto least = smallest_eigenvalues(problem, y);
  EXPECT_NEAR(least[0], 0.75, 1e-15);
  EXPECT_NEAR(least[1], 5, 1e-15);
}

TEST(SemidefiniteProgram, ComesBackEqualFromSdpaAndJson) {
  for (int number = 0; number < 50; ++number) {
    const SdpProblem problem = tidy(number);
    EXPECT_EQ(read_sdpa(to_sdpa(problem)), problem);
    EXPECT_EQ(read_sdpa(to_sdpa(problem, "a title, with 3 numbers 1 2 3")), problem);
    EXPECT_EQ(read_sdp(Json::parse(to_json(problem).dump())), problem);
    EXPECT_EQ(content_hash(read_sdpa(to_sdpa(problem))), content_hash(problem));
  }
}

TEST(SemidefiniteProgram, ReadsSdpaAsOthersWriteIt) {
  const SdpProblem problem = read_sdpa(
      "\"Example 1: mDim = 3, nBLOCK = 1, {2}\"\n* another remark\n   3  =  mDIM\n   1  =  nBLOCK\n   (2)\n{+48, -8, "
      "20}\n"
      "0 1 1 1 -11\n0 1 2 2 23\n1 1 1 1 10\n1 1 1 2 4\n");
  EXPECT_EQ(problem.cost, (std::vector<double>{48, -8, 20}));
  EXPECT_EQ(problem.blocks, std::vector<int>{2});
  ASSERT_EQ(problem.entries.size(), 4U);
  EXPECT_EQ(problem.entries[3], (SdpEntry{1, 0, 0, 1, 4}));
}

TEST(SemidefiniteProgram, HashesEverythingInIt) {
  const SdpProblem problem = tidy(1);
  EXPECT_EQ(content_hash(problem).size(), 16U);
  std::vector<SdpProblem> others(6, problem);
  others[0].cost[1] = std::nextafter(others[0].cost[1], 1);
  others[1].blocks[2] += 1;
  others[2].entries[5].value = std::nextafter(others[2].entries[5].value, 1e300);
  others[3].entries.pop_back();
  others[4].entries[0].matrix += 1;
  others[5].cost.push_back(0);
  for (const SdpProblem& other : others) EXPECT_NE(content_hash(other), content_hash(problem));
}

TEST(SemidefiniteProgram, RefusesWhatIsNone) {
  for (const SdpEntry& bad :
       {SdpEntry{3, 0, 0, 0, 1}, SdpEntry{-1, 0, 0, 0, 1}, SdpEntry{1, 2, 0, 0, 1}, SdpEntry{1, 0, 0, 2, 1},
        SdpEntry{1, 0, -1, 1, 1}, SdpEntry{1, 0, 0, 0, std::numeric_limits<double>::infinity()}}) {
    SdpProblem problem{.cost = {1, 2}, .blocks = {2, 1}, .entries = {bad}};
    EXPECT_THROW(canonicalise(problem), std::invalid_argument);
    EXPECT_THROW(read_sdp(to_json(problem), "/problem"), InputError);
  }
  for (const char* bad : {"", "2\n1\n2\n1 x\n", "1\n1\n-3\n1\n", "1\n1\n2\n1\n1 1 1 5 2\n", "1\n1\n2\n1\n1 1 1\n",
                          "1\n1\n2\n1\n1 1 1 1 nan\n", "1e8\n"}) {
    EXPECT_THROW(read_sdpa(bad), InputError) << bad;
  }
  EXPECT_THROW(read_sdp(Json::object()), InputError);
  EXPECT_THROW(read_sdp(Json{{"cost", {1}}, {"blocks", {1}}, {"entries", {{1, 0}}}}), InputError);
}

TEST(SemidefiniteSolution, ComesBackEqualFromJson) {
  SdpSolution solution{.y = Eigen::Vector3d(1.0 / 3, -1e-300, 6e23),
                       .verdict = SdpVerdict::stopped,
                       .iterations = 7,
                       .seconds = 0.1,
                       .detail = "indefinite Schur complement"};
  const SdpSolution back = read_sdp_solution(Json::parse(to_json(solution).dump()));
  EXPECT_EQ(back.y, solution.y);
  EXPECT_EQ(back.verdict, solution.verdict);
  EXPECT_EQ(back.iterations, 7);
  EXPECT_EQ(back.detail, solution.detail);
  solution.y[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(read_sdp_solution(to_json(solution)).verdict, SdpVerdict::failed);
  Json bad = to_json(solution);
  bad["verdict"] = "splendid";
  EXPECT_THROW(read_sdp_solution(bad, "/solution"), InputError);
}

}  // namespace
}  // namespace vigil::sdp_test
