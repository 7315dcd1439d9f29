// The tables of errors: specification (observer), sections 8.1 to 8.3. Root mean squares to 10 % and the table's
// rounding.
#include "tests/server/synthesis/designs.hpp"

namespace vigil::observer::tables_test {
namespace {

constexpr double kShare = 0.1;

TEST(Pair, HasTheTablesErrorsByTheModerateDesign) {
  const auto scores = score(pair(), ref(), 8, 20);
  EXPECT_NEAR(scores[0].signal_w, 0.707, 0.0005);
  EXPECT_NEAR(scores[1].signal_w, 0.707, 0.0005);
  expect_near(scores[0].w, 0.718, kShare);
  expect_near(scores[1].w, 0.037, kShare, 0.0005);
  expect_near(scores[0].f, 0.120, kShare);
  expect_near(scores[1].f, 0.0015, kShare, 0.00005);
  expect_near(scores[0].x, 0.1195, kShare);
  expect_near(scores[1].x, 0.0045, kShare, 0.00005);
}

TEST(Pair, HasTheTablesErrorsByTheFastDesign) {
  const Example example = pair();
  const DesignResult result = certified(example.network, fast());
  expect_near(result.design->gamma_w[0], 0.0342, 0.02);
  expect_near(result.design->gamma_w[1], 0.0321, 0.02);
  const auto lane = NetworkSimulation::intermediate(example.network, result.design->L);
  EXPECT_EQ(steps_per_tick(example.dt, lane.fastest()), 1);
  const auto scores = score(lane, example, 8, 20);
  expect_near(scores[0].w, 0.087, kShare);
  expect_near(scores[1].w, 0.0023, kShare, 0.00005);
  expect_factor_2(scores[0].f, 0.0024);
  expect_factor_2(scores[1].f, 0.0001);
  expect_factor_2(scores[0].x, 0.0021);
  expect_factor_2(scores[1].x, 0.0008);
  const auto start = score(lane, example, 0, 2);  // peaking, 3.64 and 2.74 at the most
  EXPECT_GT(start[0].largest_w, 1);
  EXPECT_GT(start[1].largest_w, 1);
}

struct AreaRow {
  AreaOutputs outputs;
  double fast_1, fast_2, ref_1, ref_2, ref_3;
};

TEST(FourAreas, HaveTheTablesErrorsByTheProposedObserver) {
  for (const AreaRow& row : {AreaRow{AreaOutputs::case_1, 0.00224, 0.0022, 0.0319, 0.0285, 0.0483},
                             AreaRow{AreaOutputs::case_2, 0.00223, 0.0141, 0.0316, 0.0894, 0.0480}}) {
    for (const bool attacked : {false, true}) {
      const Example example = areas(row.outputs, Topology::full, attacked);
      const auto quick = score(example, fast(), 0, 15), slow = score(example, ref(), 0, 15);
      EXPECT_NEAR(quick[0].signal_w, 0.0818, 0.00005);
      EXPECT_NEAR(quick[2].signal_w, 0.5614, 0.00005);
      expect_near(quick[0].w, row.fast_1, kShare);
      expect_near(quick[2].w, 0.0108, kShare);
      expect_near(slow[0].w, row.ref_1, kShare);
      expect_near(slow[2].w, row.ref_3, kShare);
      EXPECT_GT(quick[2].largest_w, 0.6);  // the jumps of w3
      EXPECT_LT(quick[2].largest_w, 0.75);
      if (!attacked) continue;
      EXPECT_NEAR(quick[1].signal_w, 0.7187, 0.00005);
      expect_near(quick[1].w, row.fast_2, kShare, 0.00005);
      expect_near(slow[1].w, row.ref_2, kShare);
    }
  }
}

std::vector<Score> matched_scores(const Example& example) {
  const Gains gains = certified(matched_error_system(example.network), matched()).design->L;
  return score(NetworkSimulation::matched(example.network, gains), example, 0, 15);
}

TEST(FourAreas, HaveTheTablesErrorsByTheMatchedObserver) {
  for (const AreaOutputs outputs : {AreaOutputs::case_1, AreaOutputs::case_2}) {
    const auto scores = matched_scores(areas(outputs));
    expect_near(scores[0].w, 0.0014, kShare);
    expect_near(scores[2].w, 0.0128, kShare);
    EXPECT_NEAR(scores[2].largest_w, 0.60, 0.005);
  }
  const auto seen = matched_scores(areas(AreaOutputs::case_1, Topology::full, true));
  expect_near(seen[1].w, 0.0055, kShare);
  expect_near(seen[0].w, 0.0014, kShare);
  // Figure 7's failure, which needs an attack on the area whose condition is violated.
  const auto blind = matched_scores(areas(AreaOutputs::case_2, Topology::full, true));
  expect_near(blind[0].w, 0.113, kShare);
  expect_near(blind[2].w, 0.113, kShare);
  EXPECT_NEAR(blind[1].w, 0.7187, 0.00005);
}

TEST(FourAreas, ChangeLittleOnARing) {
  for (const AreaOutputs outputs : {AreaOutputs::case_1, AreaOutputs::case_2}) {
    const auto full = score(areas(outputs), fast(), 0, 15), ring = score(areas(outputs, Topology::ring), fast(), 0, 15);
    for (const std::size_t area : {0U, 2U}) expect_near(ring[area].w, full[area].w, 0.03);
  }
}

TEST(SingleSubsystem, HasTheTablesErrors) {
  const auto slow = score(single(), ref(), 2, 20), quick = score(single(), fast(), 2, 20);
  const auto old = score(single(), classical(ref()), 2, 20), old_quick = score(single(), classical(fast()), 2, 20);
  EXPECT_NEAR(slow[0].signal_w, 0.660, 0.0005);
  expect_near(slow[0].w, 0.0817, kShare);
  expect_near(slow[0].f, 0.0017, kShare);
  expect_near(quick[0].w, 0.0070, kShare);
  expect_factor_2(quick[0].f, 0.0002);
  expect_near(old[0].w, 0.2263, kShare);
  expect_near(old[0].f, 0.0106, kShare);
  EXPECT_GE(old_quick[0].w, 0.16);
  EXPECT_LE(old_quick[0].w, 0.21);
  EXPECT_LT(quick[0].w, 0.05 * old_quick[0].w);  // figure 8: at least 95 % lower
}

double of_varsigma(double varsigma, const SynthesisOptions& options) {
  Example example = single();
  example.network.subsystems[0].varsigma = varsigma;
  return score(example, options, 2, 20)[0].w;
}

TEST(SingleSubsystem, DependsOnVarsigmaByTheClassicalEstimator) {
  for (const auto& [varsigma, w] : {std::pair{0.3, 0.523}, {1.0, 0.314}, {3.0, 0.226}, {10.0, 0.173}}) {
    expect_near(of_varsigma(varsigma, classical(ref())), w, kShare);
  }
  for (const auto& [varsigma, w] : {std::pair{0.3, 0.079}, {1.0, 0.080}, {3.0, 0.082}}) {
    expect_near(of_varsigma(varsigma, ref()), w, kShare);
  }
}

TEST(SingleSubsystem, IsAllRightAtLargeVarsigmaWithAFreeKappa) {
  for (const auto& [varsigma, w, old] : {std::tuple{3.0, 0.0062, 0.161}, {9.0, 0.0064, 0.094}, {30.0, 0.0098, 0.072}}) {
    expect_near(of_varsigma(varsigma, with_free_kappa(fast())), w, kShare);
    expect_near(of_varsigma(varsigma, classical(with_free_kappa(fast()))), old, kShare);
  }
}

// With kappa = 5 the theorem's own cost degrades: the certified gamma_d grows, and the classical estimator is better.
TEST(SingleSubsystem, DegradesAtLargeVarsigmaWithAFixedKappa) {
  for (const auto& [varsigma, gamma] : {std::pair{5.0, 1.73}, {7.0, 3.64}, {9.0, 5.07}}) {
    Network network = single().network;
    network.subsystems[0].varsigma = varsigma;
    expect_near(certified(network, ref()).design->gamma_d[0], gamma, 0.02);
  }
  EXPECT_GT(of_varsigma(9, fast()), of_varsigma(9, classical(fast())));
}

TEST(Nonlinearities, MatterLittleToTheErrors) {
  Example example = pair();
  const Gains gains = certified(example.network, fast()).design->L;
  for (const Nonlinearity phi : {Nonlinearity::sine, Nonlinearity::tanh, Nonlinearity::sine_last, Nonlinearity::none}) {
    for (Subsystem& s : example.network.subsystems) s.phi = phi;
    const double w = score(NetworkSimulation::intermediate(example.network, gains), example, 2, 10)[0].w;
    expect_near(w, 0.1455, kShare);  // 0.1445 to 0.1466
  }
}

}  // namespace
}  // namespace vigil::observer::tables_test
