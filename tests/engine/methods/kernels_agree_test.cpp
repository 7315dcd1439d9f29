/// The fixed kernels and the bounded one are the same filter: same draws, same numbers.
#include <gtest/gtest.h>

#include "tests/engine/methods/rig.hpp"

namespace vigil::kernels_agree_test {
namespace {

struct Case {
  const char* scenario;
  Json params;
};

class Kernels : public testing::TestWithParam<int> {};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"consensus", Json::object()},
      {"consensus", {{"mode", "drop"}, {"bound", "corrected"}}},
      {"consensus", {{"mode", "naive_hold"}, {"bound", "tight"}}},
      {"consensus", {{"mode", "naive_zero"}}},
      {"consensus-compass", {{"guard", "strict"}, {"U", 0.005}, {"V", 0.02}}},
  };
  return all;
}

// The two round differently (fixed 3x3 eigenvalue problems have a path of their own), by about 1e-16 a step; the
// network hardly amplifies it.
TEST_P(Kernels, AgreeToTheLastDigits) {
  const Case& given = cases()[static_cast<std::size_t>(GetParam())];
  Knowledge known = rig::knowledge_of(Scenario::preset(given.scenario), 3);
  rig::set_rates(known, {0.2, 0.2, 2.2});
  const Params params = rig::completed("consensus_ekf", given.params);
  auto fixed = consensus::make_filter(params, known), bounded = consensus::make_filter(params, known, true);
  FaultTable fixed_faults, bounded_faults;
  Eigen::VectorXd truth = Eigen::Vector3d(150, 70, 0);
  for (int k = 1; k <= 30; ++k) {
    Eigen::VectorXd next(3);
    known.plant->advance(truth, Eigen::VectorXd(0), next);
    truth = next;
    Readings readings = rig::readings_at(known, truth, 3, k);
    if (k % 7 == 0) readings[2][0] = std::nan("");
    const rig::Links links = rig::attacked(known, 3, k, 0.2, 0.2, 1.5);
    rig::tick(*fixed, known, readings, links, fixed_faults, k);
    rig::tick(*bounded, known, readings, links, bounded_faults, k);
    for (int i = 0; i < 8; ++i) {
      const double tolerance = k <= 3 ? 1e-12 : 1e-10;
      const Eigen::VectorXd x = rig::mean(*fixed, i, 3);
      const Eigen::MatrixXd Phi = rig::bound(*fixed, i, 3);
      ASSERT_LT((x - rig::mean(*bounded, i, 3)).norm(), tolerance * x.norm()) << k << " " << i;
      ASSERT_LT((Phi - rig::bound(*bounded, i, 3)).norm(), tolerance * Phi.norm()) << k << " " << i;
    }
  }
  EXPECT_EQ(fixed->design(), bounded->design());
  const auto mine = rig::faults_of(fixed_faults, *fixed), theirs = rig::faults_of(bounded_faults, *bounded);
  ASSERT_EQ(mine.size(), theirs.size());
  for (std::size_t f = 0; f < mine.size(); ++f) {
    EXPECT_EQ(mine[f].code + mine[f].node, theirs[f].code + theirs[f].node);
    EXPECT_EQ(mine[f].count, theirs[f].count);
  }
}

INSTANTIATE_TEST_SUITE_P(Consensus, Kernels, testing::Range(0, 5));

}  // namespace
}  // namespace vigil::kernels_agree_test
