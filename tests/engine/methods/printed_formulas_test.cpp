/// The kernel against the printed formulas, written a second time with plain inverses: sections 5, 7 and 15 of the
/// specification.
#include "tests/engine/methods/printed_formulas.hpp"

#include <gtest/gtest.h>

namespace vigil::printed_formulas_test {
namespace {

struct Case {
  const char* bound;
  const char* graph;
  double tau;
  bool missing;
};

class OneStep : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Case& given = GetParam();
    scenario = Scenario::preset("consensus-compass").with("network.graph", given.graph);
    known = rig::knowledge_of(scenario, 5);
    rig::set_rates(known, {0.2, 0.3, 2.2});
    constants = {.tau = given.tau,
                 .sigma = 0.1,
                 .beta = 0.1,
                 .eps = 0.3,
                 .phibar = 0.2,
                 .gammabar = 0.3,
                 .delta = 2.2,
                 .u = 0.005,
                 .v = 0.02,
                 .bound = given.bound};
    if (known.graph.max_degree() > 3) constants.eps = 0.1;
    for (Eigen::Index i = 0; i < known.estimates.cols(); ++i)
      nodes.push_back({known.estimates.col(i), {}, known.P0, {}, {}, {}});
    method = consensus::make_filter(rig::completed("consensus_ekf", {{"tau", given.tau},
                                                                     {"eps", constants.eps},
                                                                     {"U", 0.005},
                                                                     {"V", 0.02},
                                                                     {"guard", "strict"},
                                                                     {"bound", given.bound}}),
                                    known);
  }

  /// One tick of both, readings of a robot that follows the model.
  void step(std::int64_t k) {
    Eigen::VectorXd next(3);
    known.plant->advance(truth, Eigen::VectorXd(0), next);
    truth = next;
    Readings readings = rig::readings_at(known, truth, 9, k);
    if (GetParam().missing) {
      readings[1].setConstant(std::nan(""));
      readings[5][2] = std::nan("");
    }
    const rig::Links links = rig::attacked(known, 9, k, 0.2, 0.3, 1.5);
    rig::tick(*method, known, readings, links, faults, k);
    for (auto& node : nodes) printed::predict(node, known, constants);
    printed::update(nodes, known, readings, links, constants);
  }

  void expect_equal(double tolerance) {
    for (int i = 0; i < 8; ++i) {
      const auto& node = nodes[static_cast<std::size_t>(i)];
      EXPECT_LT((rig::mean(*method, i, 3) - node.x).cwiseAbs().maxCoeff(), tolerance * node.x.norm()) << i;
      EXPECT_LT((rig::bound(*method, i, 3) - node.Phi).cwiseAbs().maxCoeff(), tolerance * node.Phi.norm()) << i;
    }
  }

  Scenario scenario;
  Knowledge known;
  printed::Constants constants;
  std::vector<printed::NodeState> nodes;
  std::unique_ptr<Method> method;
  FaultTable faults;
  Eigen::VectorXd truth = Eigen::Vector3d(150, 70, 0);
};

using ManySteps = OneStep;

TEST_P(OneStep, AgreesWithTheFormulas) {
  step(1);
  EXPECT_FALSE(faults.stopped());
  expect_equal(1e-10);
}

TEST_P(ManySteps, AgreeWithTheFormulas) {
  for (int k = 1; k <= 30; ++k) step(k);
  EXPECT_FALSE(faults.stopped());
  expect_equal(1e-8);
}

// (30) is the derivative of the trace of (27) set to zero, in every bound mode: any other gain is worse.
TEST_P(ManySteps, GainMinimisesTheTrace) {
  step(1);
  for (auto& node : nodes) printed::predict(node, known, constants);
  const rig::Links links = rig::attacked(known, 9, 2, 0.2, 0.3, 1.5);
  for (int i = 0; i < 8; ++i) {
    const auto& node = nodes[static_cast<std::size_t>(i)];
    const printed::Heard heard = printed::hear(nodes, i, known, links);
    const int d = known.graph.degree(i);
    Eigen::MatrixXd H(3, 3);
    known.sensors[static_cast<std::size_t>(i)]->jacobian(node.xp, H);
    const Eigen::MatrixXd& R = known.sensors[static_cast<std::size_t>(i)]->noise();
    const Eigen::MatrixXd K = printed::gain(node, H, R, heard.delivered, d, constants);
    const auto trace = [&](const Eigen::MatrixXd& gain) {
      return printed::bound_of(gain, node, H, R, heard.neighbours, heard.delivered, d, constants).trace();
    };
    for (std::int64_t trial = 0; trial < 20; ++trial) {
      Eigen::VectorXd draw(9);
      Draws(3, "gain").normals(trial, draw);
      const Eigen::MatrixXd off = 1e-2 * draw.reshaped(3, 3);
      EXPECT_GT(trace(K + off), trace(K));
      EXPECT_NEAR(trace(K + 1e-3 * off), trace(K - 1e-3 * off), 1e-11 * trace(K));  // no slope
    }
  }
}

std::string name_of(const testing::TestParamInfo<Case>& place) {
  return std::string(place.param.bound) + "_" + place.param.graph + (place.param.missing ? "_missing" : "");
}

INSTANTIATE_TEST_SUITE_P(Consensus, ManySteps,
                         testing::Values(Case{"paper", "ladder", 0.01, false}, Case{"corrected", "ladder", 0.01, false},
                                         Case{"tight", "ladder", 0.01, false}, Case{"paper", "path", 0.02, false},
                                         Case{"tight", "complete", 0.002, false}),
                         name_of);
// Where a reading is missing, the bound grows past (28) within a few steps: one step only.
INSTANTIATE_TEST_SUITE_P(Consensus, OneStep,
                         testing::Values(Case{"paper", "ladder", 0.01, false}, Case{"paper", "path", 0.02, true},
                                         Case{"paper", "none", 0.02, true}, Case{"corrected", "complete", 0.005, true},
                                         Case{"tight", "none", 0.01, true}),
                         name_of);

}  // namespace
}  // namespace vigil::printed_formulas_test
