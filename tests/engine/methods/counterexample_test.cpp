/// Why the paper's theorem is wrong for two neighbours and more: the two one-step counterexamples of section 7, on the
/// filter itself. Complete graph, d = 7, K = 0 in effect (R = 1e14 I), C = I/7, U = 0, Phi_0 = 1e-9 I.
#include <gtest/gtest.h>

#include "tests/engine/methods/linear_plant.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::counterexample_test {
namespace {

constexpr int kNodes = 8, kDegree = 7;
constexpr double kPhi = 1e-9;

Knowledge network(double q) {
  Knowledge known;
  known.plant = std::make_shared<rig::LinearPlant>(Eigen::Matrix3d::Identity());
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i < kNodes; ++i) {
    known.nodes.push_back(std::to_string(i + 1));
    known.sensors.push_back(std::make_shared<rig::LinearSensor>(Eigen::MatrixXd::Identity(2, 3),
                                                                Eigen::MatrixXd(1e14 * Eigen::Matrix2d::Identity())));
    for (int j = 0; j < i; ++j) edges.emplace_back(j, i);
  }
  known.graph = Graph(kNodes, edges);
  known.Q = q * Eigen::Matrix3d::Identity();
  known.P0 = kPhi * Eigen::Matrix3d::Identity();
  known.estimates = Eigen::MatrixXd::Zero(3, kNodes);
  known.rates.resize(known.graph.links().size());
  return known;
}

/// The filter whose gain C is I/7 at the first step.
std::unique_ptr<Method> filter(const Knowledge& known, const std::string& bound) {
  const double predicted = 1 / (1 / kPhi - 1.1 * 0.1) + known.Q(0, 0);
  const Json params = {
      {"tau", 1 / (kDegree * predicted)}, {"eps", 0.1}, {"U", 0}, {"V", 0.1}, {"guard", "strict"}, {"bound", bound}};
  return consensus::make_filter(rig::completed("consensus_ekf", params), known);
}

Eigen::MatrixXd bound_after_one_step(const Knowledge& known, const std::string& bound) {
  auto method = filter(known, bound);
  FaultTable faults;
  rig::tick(*method, known, rig::readings_at(known, Eigen::Vector3d::Zero(), 1, 1), rig::Links(known), faults, 1);
  EXPECT_FALSE(faults.stopped()) << "the conditions (28), (29) hold";
  EXPECT_TRUE(rig::faults_of(faults, *method).empty());
  return rig::bound(*method, 0, 3);
}

// (a) No attack. Every estimate is the mean of seven that miss the same process noise, so the error is that noise:
// covariance Q. The trace of its sample covariance over 20 000 trials is within 1.2 % (4 standard errors of
// sqrt(2/3/20000)).
TEST(Counterexample, CommonProcessNoiseBreaksThePaperBound) {
  const Knowledge known = network(0.5);
  const Draws noise(5, "process");
  double sum = 0;
  constexpr int trials = 20'000;
  for (int trial = 0; trial < trials; ++trial) {
    Eigen::VectorXd w(3);
    noise.normals(trial, w);
    w *= std::sqrt(0.5);
    auto method = filter(known, "paper");
    FaultTable faults;
    rig::tick(*method, known, rig::readings_at(known, w, 6, trial), rig::Links(known), faults, 1);
    sum += (rig::mean(*method, trial % kNodes, 3) - w).squaredNorm();
  }
  const double variance = sum / trials / 3;
  EXPECT_NEAR(variance, 0.5, 0.012 * 0.5);
  EXPECT_NEAR(variance / bound_after_one_step(known, "paper")(0, 0), 7.0 / 3, 0.012 * 7 / 3);
  EXPECT_NEAR(variance / bound_after_one_step(known, "corrected")(0, 0), 7.0 / 15, 0.012 * 7 / 15);
  EXPECT_NEAR(0.5 / bound_after_one_step(known, "paper")(0, 0), 7.0 / 3, 1e-6);  // in closed form
  EXPECT_NEAR(0.5 / bound_after_one_step(known, "corrected")(0, 0), 7.0 / 15, 1e-6);
  EXPECT_LE(0.5 / bound_after_one_step(known, "tight")(0, 0), 1);
}

// (b) The same vector of norm 7 on each link with probability 0.9: the error is -xi/7 times a binomial number of links,
// so its second moment along xi is 0.9 * 7 * 0.1 + (0.9 * 7)^2 = 40.32.
TEST(Counterexample, ConstantFalseDataBreakThePaperBound) {
  Knowledge known = network(1e-9);
  rig::set_rates(known, {0, 0.9, 7});
  const Draws branch(8, "branch");
  double sum = 0;
  constexpr int trials = 20'000;
  for (int trial = 0; trial < trials; ++trial) {
    rig::Links links(known);
    for (std::size_t l = 0; l < links.state.size(); ++l) {
      if (!branch.bernoulli(trial, static_cast<std::uint32_t>(l), 0.9)) continue;
      links.state[l] = LinkState::fdi;
      links.injected(0, static_cast<Eigen::Index>(l)) = 7;
    }
    auto method = filter(known, "paper");
    FaultTable faults;
    rig::tick(*method, known, rig::readings_at(known, Eigen::Vector3d::Zero(), 6, trial), links, faults, 1);
    const double e = rig::mean(*method, trial % kNodes, 3)[0];
    sum += e * e;
  }
  const double moment = sum / trials;
  EXPECT_NEAR(moment, 40.32, 0.01 * 40.32);  // 4 standard errors are 0.7 %
  EXPECT_NEAR(moment / bound_after_one_step(known, "paper")(0, 0), 2.133, 0.01 * 2.133);
  EXPECT_NEAR(moment / bound_after_one_step(known, "corrected")(0, 0), 0.4267, 0.01 * 0.4267);
  EXPECT_LE(moment / bound_after_one_step(known, "tight")(0, 0), 1);
}

// What makes a Young-type bound valid: 1/m0 + d/mn + d/ma <= 1.
TEST(Multipliers, AreValidWhereTheyClaimToBe) {
  using consensus::Bound;
  for (int d = 1; d <= 40; ++d) {
    for (const double norm : {0.0, 1e-9, 1e-3, 0.02, 0.09, 0.5, 3.0}) {
      for (const Bound bound : {Bound::paper, Bound::corrected, Bound::tight}) {
        const auto m = consensus::multipliers(bound, d, norm);
        const double sum = 1 / m.own + d / m.neighbour + d / m.attack;
        EXPECT_EQ(sum <= 1 + 1e-12, consensus::bound_is_valid(bound, d)) << d << " " << norm;
      }
    }
    EXPECT_FALSE(d > 1 && consensus::bound_is_valid(Bound::paper, d));
  }
  EXPECT_EQ(consensus::multipliers(Bound::tight, 0, 1).own, 1);
  EXPECT_EQ(consensus::multipliers(Bound::paper, 0, 1).neighbour, 0);
}

}  // namespace
}  // namespace vigil::counterexample_test
