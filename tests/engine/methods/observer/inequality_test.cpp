// Theorem 1 beside the letters of (17), block by block. Specification (observer), sections 5 and 6.
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/engine/methods/observer/letters.hpp"

namespace vigil::observer::inequality_test {
namespace {

using Eigen::MatrixXd;

void expect_blocks(const Network& network, const SynthesisOptions& options, int number) {
  const Synthesis synthesis = theorem_1(error_system(network), options);
  const Eigen::VectorXd y = some_y(synthesis, number);
  const auto all = letters(synthesis.system, y, options.free_kappa);
  const auto blocks = blocks_at(synthesis.problem, y);
  const auto k = static_cast<std::size_t>(network.count());
  ASSERT_EQ(blocks.size(), 1 + k * (options.rmax ? 4 : 3));
  ASSERT_EQ(block_names(synthesis).size(), blocks.size());
  const MatrixXd S = printed_sigma(network, all);
  const MatrixXd I = MatrixXd::Identity(S.rows(), S.rows());
  EXPECT_LT(distance(blocks[0], -S - options.eps * I), 1e-12);
  for (std::size_t i = 0; i < k; ++i) {
    const auto size = all[i].P.rows(), p = all[i].W.cols();
    const MatrixXd J = MatrixXd::Identity(size, size);
    EXPECT_LT(distance(blocks[1 + i], all[i].P - options.pmin * J), 1e-12);
    EXPECT_LT(distance(blocks[1 + k + i], *options.pmax * J - all[i].P), 1e-12);
    MatrixXd bound(p + size, p + size);
    bound << all[i].nu * MatrixXd::Identity(p, p), all[i].W.transpose(), all[i].W, all[i].P;
    EXPECT_LT(distance(blocks[1 + 2 * k + i], bound), 1e-12);
    if (!options.rmax) continue;
    const ErrorPart& part = synthesis.system.parts[i];
    const MatrixXd half = all[i].P * part.Abar - part.mu * all[i].W * part.Cbar;
    EXPECT_LT(distance(blocks[1 + 3 * k + i], half + half.transpose() + 2 * *options.rmax * all[i].P), 1e-12);
  }
}

TEST(TheInequality, IsAsPrinted) {
  SynthesisOptions free = ref();
  free.free_kappa = true;
  for (int number = 0; number < 5; ++number) {
    for (const auto& options : {ref(), fast(), free}) {
      expect_blocks(pair().network, options, number);
      expect_blocks(single().network, options, number);
      expect_blocks(areas(AreaOutputs::case_1).network, options, number);
      expect_blocks(mixed(number), options, number);
    }
  }
}

TEST(TheInequality, HasTheSizesOfTheSpecification) {
  const Synthesis synthesis = theorem_1(error_system(pair().network), ref());
  EXPECT_EQ(synthesis.problem.variables(), 75);
  EXPECT_EQ(synthesis.problem.blocks, (std::vector<int>{17, 6, 5, 6, 5, 9, 8}));
  for (const auto& [k, variables, order] : {std::tuple{4, 150, 34}, {8, 300, 68}, {16, 600, 136}}) {
    const SdpProblem problem = theorem_1(error_system(ring(k)), ref()).problem;
    EXPECT_EQ(problem.variables(), variables);
    EXPECT_EQ(problem.blocks[0], order);
  }
  EXPECT_THROW(theorem_1(error_system(ring(28)), ref()), std::length_error);
}

TEST(TheInequality, PricesWhatItsPresetSays) {
  Network network = pair().network;
  network.subsystems[1].mu = 3;
  const Synthesis synthesis = theorem_1(error_system(network), fast());
  double sum = 0;
  for (const double cost : synthesis.problem.cost) sum += cost;
  const auto cost = [&](int at) { return synthesis.problem.cost[static_cast<std::size_t>(at)]; };
  for (const Unknowns& at : synthesis.unknowns) {
    EXPECT_EQ(cost(at.gd2), 10);
    EXPECT_EQ(cost(at.gw2), 1e4);
  }
  EXPECT_EQ(cost(synthesis.unknowns[0].nu), 1e-9);
  EXPECT_NEAR(cost(synthesis.unknowns[1].nu), 9e-9, 1e-20);
  EXPECT_NEAR(sum, 2 * 10010 + 1e-8, 1e-9);
}

}  // namespace
}  // namespace vigil::observer::inequality_test
