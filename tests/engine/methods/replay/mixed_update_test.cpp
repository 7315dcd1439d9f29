#include "engine/methods/replay/mixed_update.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "engine/linalg/covariance.hpp"
#include "engine/linalg/ellipsoid.hpp"
#include "engine/linalg/riccati.hpp"
#include "engine/methods/replay/batch.hpp"
#include "tests/engine/allocations.hpp"
#include "tests/engine/methods/replay/mixed_reference.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::replay::mixed_update_test {
namespace {

using Eigen::MatrixXd;
using reference::Long;
using reference::Problem;

MixedUpdate update_of(const Problem& problem, double zeta_max = tank::kAsPrinted) {
  return {problem.C, problem.R, problem.Mv, problem.mu, zeta_max};
}

/// The tank's gains of samples 3..last.
std::vector<GainChoice> schedule(const tank::Scenario& scenario, double zeta_max, int last) {
  const auto batch = Batch::make(tank::A, tank::B, tank::C);
  const MatrixXd P = scenario.noise(), Mw = scenario.bounded();
  Bounds bounds = batch->error(P, P, Mw, Mw);
  const MixedUpdate update(tank::C, P, Mw, scenario.mu, zeta_max);
  std::vector<GainChoice> gains;
  for (int k = 3; k <= last; ++k) {
    time_update(tank::A, P, Mw, bounds);
    gains.push_back(*update.update(bounds.Q, bounds.M));
    bounds = {gains.back().Q, gains.back().M};
  }
  return gains;
}

double forgetting(const MatrixXd& K) {
  const MatrixXd I1 = MatrixXd::Identity(1, 1), I2 = MatrixXd::Identity(2, 2);
  const MatrixXd L = lqr_gain(tank::A, tank::B, I1, *solve_dare(tank::A, tank::B, I2, I1));
  return spectral_radius((I2 - K * tank::C) * (tank::A + tank::B * L));
}

TEST(MixedUpdate, GivesTheTanksSteadyGains) {
  const MatrixXd printed[] = {MatrixXd({{0.5851, -0.1609}, {0.1749, 0.6167}}),
                              MatrixXd({{0.7848, -0.2064}, {0.2739, 0.9352}}),
                              MatrixXd({{0.7699, -0.2032}, {0.2662, 0.9114}})};
  const double radius[] = {0.404, 0.173, 0.190};
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i + 1);
    const MatrixXd K = schedule(tank::kScenarios[i], 1, 300).back().K;
    EXPECT_LE((K - printed[i]).cwiseAbs().maxCoeff(), 5e-5);
    EXPECT_NEAR(forgetting(K), radius[i], 5e-4);
  }
}

TEST(MixedUpdate, AsPrintedTheTanksResidualIsZeroWhereNoiseIsBounded) {
  for (const int i : {1, 2}) {
    for (const GainChoice& gain : schedule(tank::kScenarios[i], tank::kAsPrinted, 300)) {
      EXPECT_EQ(gain.corner, Corner::infinite);
      EXPECT_EQ(gain.zeta, std::numeric_limits<double>::infinity());
      EXPECT_LE((gain.K * tank::C - MatrixXd::Identity(2, 2)).norm(), 1e-14);
    }
  }
  EXPECT_LE(forgetting(tank::C.inverse()), 1e-14);
  EXPECT_EQ(schedule(tank::kScenarios[0], tank::kAsPrinted, 4).back().zeta, 1);
}

TEST(MixedUpdate, AgreesWithTheTextInExtendedPrecision) {
  int within = 0, bounded = 0;
  for (int number = 0; number < 300; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(number);
    const int n = 1 + random.below(4), p = 1 + random.below(4);
    const Problem problem = reference::random_problem(random, n, p);
    const double zeta_max = number % 2 == 0 ? tank::kAsPrinted : random.log_uniform(0.1, 10);
    const auto gain = update_of(problem, zeta_max).update(problem.Qp, problem.Mp);
    ASSERT_TRUE(gain);
    const long double low = std::max(1e-9L, 1 / (1 + static_cast<long double>(zeta_max))), high = 1 - 1e-9L;
    if (reference::slope(problem, low) >= 0 && !std::isfinite(zeta_max)) {
      EXPECT_EQ(gain->corner, Corner::infinite);
      continue;
    }
    if (reference::slope(problem, high) <= 0) {
      EXPECT_EQ(gain->corner, Corner::zero);
      continue;
    }
    EXPECT_EQ(gain->corner, Corner::none);
    const bool at_bound = reference::slope(problem, low) >= 0;
    const long double sigma = at_bound ? low : reference::best_sigma(problem, low, high);
    const long double zeta = (1 - sigma) / sigma;
    const Long K = reference::gain(problem, sigma);
    const Long Q = reference::covariance(problem, K), M = reference::shape(problem, K, zeta);
    EXPECT_NEAR(gain->zeta, static_cast<double>(zeta), 1e-6 * static_cast<double>(zeta));
    EXPECT_NEAR(gain->sigma, static_cast<double>(sigma), 1e-8);
    EXPECT_LE(reference::distance(gain->K, K), 1e-8 * reference::size(K));
    EXPECT_LE(reference::distance(gain->Q, Q), 1e-8 * reference::size(Q));
    EXPECT_LE(reference::distance(gain->M, M), 1e-8 * reference::size(M));
    (at_bound ? bounded : within) += 1;
  }
  EXPECT_GT(within, 50);
  EXPECT_GT(bounded, 20);
}

TEST(MixedUpdate, TheSlopeIsTheTextsAndNeverFalls) {
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(1000 + number);
    const int n = 1 + random.below(4), p = 1 + random.below(4);
    const Problem problem = reference::random_problem(random, n, p);
    const MixedUpdate update = update_of(problem);
    double last = -std::numeric_limits<double>::infinity();
    for (double sigma = 0.001; sigma < 1; sigma += 0.001) {
      const auto point = update.at(sigma, problem.Qp, problem.Mp);
      ASSERT_TRUE(point);
      const double size = point->of_sensor / std::pow(1 - sigma, 2) + point->of_prediction / (sigma * sigma);
      EXPECT_NEAR(point->slope(), static_cast<double>(reference::slope(problem, sigma)), 1e-9 * size);
      EXPECT_GE(point->slope(), last - 1e-9 * size);
      last = point->slope();
    }
  }
}

// With the best gain for each: convex in sigma, and its slope is (1 - mu) g. Not convex in zeta, whatever the text
// says.
TEST(MixedUpdate, TheCostIsConvexInSigma) {
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(2000 + number);
    const Problem problem = reference::random_problem(random, 1 + random.below(4), 1 + random.below(4));
    const auto cost = [&](long double sigma) {
      return reference::cost(problem, reference::gain(problem, sigma), sigma);
    };
    for (long double sigma = 0.02L; sigma < 0.985L; sigma += 0.01L) {
      const long double h = 1e-3L, before = cost(sigma - h), here = cost(sigma), after = cost(sigma + h);
      EXPECT_GE(before + after - 2 * here, -1e-13L * here);
      const long double difference = (cost(sigma + 1e-6L) - cost(sigma - 1e-6L)) / 2e-6L;
      const long double slope = (1 - problem.mu) * reference::slope(problem, sigma);
      EXPECT_LE(std::abs(difference - slope), 1e-6L * (std::abs(slope) + here));
    }
  }
}

TEST(MixedUpdate, TheCostIsNotConvexInZeta) {
  const MatrixXd I = MatrixXd::Identity(2, 2);
  const Problem problem{.C = tank::C, .R = 0.1 * I, .Mv = 0.5 * I, .Qp = 0.3 * I, .Mp = 0.5 * I, .mu = 0.3};
  const auto cost = [&](long double zeta) {
    const long double sigma = 1 / (1 + zeta);
    return reference::cost(problem, reference::gain(problem, sigma), sigma);
  };
  const long double h = 1e-4L;
  const long double bend = (cost(4.135L + h) - 2 * cost(4.135L) + cost(4.135L - h)) / (h * h);
  EXPECT_NEAR(static_cast<double>(bend), -2.2e-3, 5e-5);
  EXPECT_NEAR(update_of(problem).update(problem.Qp, problem.Mp)->zeta, 0.827, 5e-4);
}

TEST(MixedUpdate, CovarianceAndEllipsoidStaySemidefiniteAndSymmetric) {
  for (int number = 0; number < 200; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(3000 + number);
    const int n = 1 + random.below(4), p = 1 + random.below(4);
    Problem problem = reference::random_problem(random, n, p);
    const MatrixXd A = random.gaussian(n, n), P = random.semidefinite(n, random.below(n + 1)),
                   Mw = random.semidefinite(n, random.below(n + 1));
    const MixedUpdate update = update_of(problem, number % 2 == 0 ? tank::kAsPrinted : 1);
    Bounds bounds{problem.Qp, problem.Mp};
    for (int k = 0; k < 30; ++k) {
      time_update(A, P, Mw, bounds);
      const auto gain = update.update(bounds.Q, bounds.M);
      ASSERT_TRUE(gain);
      EXPECT_EQ(gain->Q, MatrixXd(gain->Q.transpose()));
      EXPECT_EQ(gain->M, MatrixXd(gain->M.transpose()));
      EXPECT_GE(least_eigenvalue(gain->Q), -1e-12 * gain->Q.norm());
      EXPECT_GE(least_eigenvalue(gain->M), -1e-12 * gain->M.norm());
      bounds = {gain->Q, gain->M};
    }
  }
}

TEST(MixedUpdate, WithoutABoundedPartItIsKalmans) {
  for (int number = 0; number < 50; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(4000 + number);
    const int n = 1 + random.below(4), p = 1 + random.below(4);
    Problem problem = reference::random_problem(random, n, p);
    const MatrixXd S = problem.C * problem.Qp * problem.C.transpose() + problem.R;
    const MatrixXd K = problem.Qp * problem.C.transpose() * S.inverse();
    const MatrixXd X = MatrixXd::Identity(n, n) - K * problem.C;
    Problem pure = problem, empty = problem;
    pure.mu = 1;
    empty.Mp.setZero();
    empty.Mv.setZero();
    empty.mu = 0.4;
    for (const Problem& one : {pure, empty}) {
      const auto gain = update_of(one).update(one.Qp, one.Mp);
      ASSERT_TRUE(gain);
      EXPECT_LE((gain->K - K).norm(), 1e-10 * K.norm());
      EXPECT_LE((gain->Q - X * problem.Qp).norm(), 1e-9 * gain->Q.norm());
      EXPECT_EQ(gain->zeta, 1);
      EXPECT_EQ(gain->corner, Corner::none);
      const MatrixXd M = minimum_trace_sum(X * one.Mp * X.transpose(), K * one.Mv * K.transpose());
      EXPECT_LE((gain->M - M).norm(), 1e-9 * (M.norm() + 1e-300));
    }
  }
}

TEST(MixedUpdate, OneBoundedPartAloneIsNoCorner) {
  RandomMatrices random(5);
  Problem problem = reference::random_problem(random, 3, 2);
  Problem quiet = problem;
  quiet.Mv.setZero();
  for (const double zeta_max : {tank::kAsPrinted, 1.0}) {
    const auto gain = update_of(quiet, zeta_max).update(quiet.Qp, quiet.Mp);
    ASSERT_TRUE(gain);
    const Long K = reference::gain(quiet, 1 - 1e-9L);
    EXPECT_LE(reference::distance(gain->K, K), 1e-8 * gain->K.norm());
    EXPECT_EQ(gain->zeta, 0);
    EXPECT_EQ(gain->corner, Corner::none);
    const MatrixXd X = MatrixXd::Identity(3, 3) - gain->K * quiet.C;
    EXPECT_LE((gain->M - X * quiet.Mp * X.transpose()).norm(), 1e-12 * gain->M.norm());

    Problem sure = problem;
    sure.Mp.setZero();
    const auto other = update_of(sure, zeta_max).update(sure.Qp, sure.Mp);
    ASSERT_TRUE(other);
    const Long L = reference::gain(sure, 1e-9L);
    EXPECT_LE(reference::distance(other->K, L), 1e-8 * other->K.norm());
    EXPECT_EQ(other->corner, Corner::none);
    EXPECT_LE((other->M - other->K * sure.Mv * other->K.transpose()).norm(), 1e-12 * other->M.norm());
  }
}

TEST(MixedUpdate, WithoutAnyNoiseOfTheSensorItNeedsAnInvertibleInnovation) {
  const MatrixXd I = MatrixXd::Identity(2, 2), zero = MatrixXd::Zero(2, 2);
  const auto square = MixedUpdate(tank::C, zero, zero, 0.5).update(I, I);
  ASSERT_TRUE(square);
  EXPECT_LE((square->K * tank::C - I).norm(), 1e-12);
  EXPECT_FALSE(MixedUpdate(MatrixXd({{1, 0}, {1, 0}}), zero, zero, 0.5).update(I, I));
  EXPECT_FALSE(
      MixedUpdate(MatrixXd({{1, 0}, {0, 1}, {1, 1}}), MatrixXd::Zero(3, 3), MatrixXd::Zero(3, 3), 0.5).update(I, I));
  EXPECT_FALSE(MixedUpdate(tank::C, zero, zero, 0.5).update(zero, zero));
}

// For a square C the printed G* C' is the same gain.
TEST(MixedUpdate, ThePrintedGainOfASquareSensorIsThisOne) {
  const MatrixXd I = MatrixXd::Identity(2, 2), C = tank::C;
  const MixedUpdate update(C, 0.2 * I, 0.5 * I, 0.5);
  for (double sigma = 0.05; sigma < 1; sigma += 0.05) {
    const MatrixXd W = 0.5 * 0.3 * I + 0.5 * 0.8 * I / sigma, S = 0.5 * 0.2 * I + 0.5 * 0.5 * I / (1 - sigma);
    const MatrixXd G = W * C.transpose() * C * (C.transpose() * (C * W * C.transpose() + S) * C).inverse();
    EXPECT_LE((G * C.transpose() - update.at(sigma, 0.3 * I, 0.8 * I)->K).norm(), 1e-12);
  }
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(MixedUpdate, ATickAllocatesNothing) {
  for (const int i : {0, 1, 2}) {
    const auto& scenario = tank::kScenarios[i];
    const MatrixXd P = scenario.noise(), Mw = scenario.bounded();
    for (const double zeta_max : {0.5, 50.0, tank::kAsPrinted}) {
      const MixedUpdate update(tank::C, P, Mw, scenario.mu, zeta_max);
      Bounds bounds{P, 9 * Mw};
      bool done = false;
      EXPECT_EQ(allocations_in([&] {
                  time_update(tank::A, P, Mw, bounds);
                  done = update.update(bounds.Q, bounds.M).has_value();
                }),
                0);
      EXPECT_TRUE(done);
    }
  }
}
#endif

}  // namespace
}  // namespace vigil::replay::mixed_update_test
