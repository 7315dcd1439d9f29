// The exact properties of section 4, the printed gains' errors and the gains of the fallback. Specification (observer).
#include <gtest/gtest.h>

#include "engine/methods/observer/fallback.hpp"
#include "tests/engine/methods/observer/networks.hpp"

namespace vigil::observer::properties_test {
namespace {

using Eigen::MatrixXd;

Gains moderate(const Network& network) { return *riccati_gains(network, {}); }

TEST(TheErrors, DoNotDependOnTheFaults) {
  const Example with = pair();
  Example without = with;
  for (auto& signals : without.signals) signals.f.clear();
  const auto lane = NetworkSimulation::intermediate(with.network, moderate(with.network));
  const Difference seen = difference(lane, with, lane, without);
  EXPECT_LT(seen.errors, 1e-12);
  EXPECT_GT(seen.estimates, 1);  // the estimate of f follows it all the same
}

TEST(TheErrors, DoNotDependOnTheInputOfALinearPlant) {
  Example with = pair();
  for (Subsystem& s : with.network.subsystems) s.tau = 0;
  Example without = with;
  with.signals[0].u = {Signal({{.sine = 1, .rate = 1}})};
  with.signals[1].u = {Signal({Piece{.offset = 1}})};
  const auto lane = NetworkSimulation::intermediate(with.network, moderate(with.network));
  const Difference seen = difference(lane, with, lane, without);
  EXPECT_LT(seen.errors, 1e-11);
  EXPECT_GT(seen.estimates, 0.1);
}

TEST(Varsigma, IsAChangeOfCoordinates) {
  const Example example = pair();
  const Gains gains = moderate(example.network);
  Example plain = example;
  Gains moved = gains;
  for (std::size_t i = 0; i < 2; ++i) {
    const Augmented a = augment(example.network.subsystems[i]);
    moved[i].bottomRows(1) += a.N * gains[i].topRows(a.N.cols());
    plain.network.subsystems[i].varsigma = 0;
  }
  const Difference seen = difference(NetworkSimulation::intermediate(example.network, gains), example,
                                     NetworkSimulation::intermediate(plain.network, moved), plain);
  EXPECT_LT(seen.estimates, 1e-9);
}

TEST(Mu, OnlyScalesTheGains) {
  const Example example = pair();
  const Gains gains = moderate(example.network);
  Example scaled = example;
  Gains other = gains;
  for (std::size_t i = 0; i < 2; ++i) {
    scaled.network.subsystems[i].mu = 10;
    other[i] /= 10;
  }
  const Difference seen = difference(NetworkSimulation::intermediate(example.network, gains), example,
                                     NetworkSimulation::intermediate(scaled.network, other), scaled);
  EXPECT_LT(seen.estimates, 1e-10);
}

// Section 8.1, 8 to 20 s: stable, certified, and blind to the attacks.
TEST(PrintedGains, GiveTheTablesErrors) {
  const Example example = pair();
  const auto scores = score(NetworkSimulation::intermediate(example.network, printed_gains()), example, 8, 20);
  EXPECT_NEAR(scores[0].signal_w, 0.707, 0.0005);
  EXPECT_NEAR(scores[0].w, 0.698, 0.0005);
  EXPECT_NEAR(scores[1].w, 0.801, 0.0005);
  EXPECT_NEAR(scores[0].f, 0.013, 0.0005);
  EXPECT_NEAR(scores[1].f, 0.054, 0.0005);
  EXPECT_NEAR(scores[0].x, 0.0181, 0.00005);
  EXPECT_NEAR(scores[1].x, 0.1194, 0.00005);
}

TEST(TheFallback, StabilisesWhatItCan) {
  for (const RiccatiWeights& weights :
       {RiccatiWeights{}, RiccatiWeights{1e8, 1e6, 1e10}, RiccatiWeights{1e6, 1e4, 1e8}}) {
    const Network network = pair().network;
    const auto gains = riccati_gains(network, weights);
    ASSERT_TRUE(gains);
    const auto all = poles(global_error_matrix(error_system(network), *gains));
    EXPECT_LT(all.front().real(), 0);
    double fastest = 0;
    for (const auto& pole : all) fastest = std::max(fastest, std::abs(pole));
    if (weights.qd == 1e4) {
      EXPECT_NEAR(fastest, 354, 1);
    }
    if (weights.qd == 1e8) {
      EXPECT_NEAR(fastest, 3.1e4, 1e3);
    }
  }
  Subsystem hidden;
  hidden.A = (MatrixXd(2, 2) << -1, 1, 0, -2).finished();
  hidden.C = (MatrixXd(1, 2) << 0, 1).finished();
  hidden.D = (MatrixXd(2, 1) << 1, 0).finished();
  complete(hidden);
  EXPECT_FALSE(riccati_gains({.subsystems = {hidden}}, {}));
}

TEST(TheFallback, DoesNotDependOnVarsigmaAndMu) {
  Network network = single().network;
  const MatrixXd before = (*riccati_gains(network, {}))[0];
  Subsystem& s = network.subsystems[0];
  const MatrixXd integral = before.bottomRows(1) + augment(s).N * before.topRows(4);
  s.varsigma = 30;
  s.mu = 4;
  const MatrixXd after = 4 * (*riccati_gains(network, {}))[0];
  EXPECT_TRUE(after.topRows(4).isApprox(before.topRows(4), 1e-9));
  EXPECT_TRUE((after.bottomRows(1) + augment(s).N * after.topRows(4)).isApprox(integral, 1e-9));
}

}  // namespace
}  // namespace vigil::observer::properties_test
