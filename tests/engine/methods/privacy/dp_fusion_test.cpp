#include "engine/methods/privacy/dp_fusion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/gaussian_mechanism.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy::dp_fusion_test {
namespace {

using Eigen::MatrixXd;

const double kLn2 = std::log(2.0);

DpSettings turn_settings() {
  DpSettings settings;
  settings.H = Eigen::Vector4d(1, 0, 1, 0);
  return settings;
}

TEST(PrivacyGaussian, TheSpecificationsFactors) {
  EXPECT_NEAR(gamma_factor(kLn2, 0.1), 2.179810, 5.1e-7);
  EXPECT_NEAR(gamma_factor(1, 0.05), 1.907040, 5.1e-7);
  EXPECT_NEAR(exact_delta(kLn2, 1 / gamma_factor(kLn2, 0.1)), 0.018195, 5.1e-7);
}

TEST(PrivacyGaussian, TheLossExceedsEpsilonWithProbabilityDelta) {
  for (const double epsilon : {0.01, 0.3, 0.7, 2.0, 10.0}) {
    for (const double delta : {1e-6, 0.01, 0.1, 0.4}) {
      const double mu = 1 / gamma_factor(epsilon, delta);
      EXPECT_NEAR(loss_probability(epsilon, mu), delta, 1e-10 * delta + 1e-14);
      EXPECT_LT(exact_delta(epsilon, mu), delta);
      EXPECT_LT(exact_epsilon(mu, delta), epsilon);
    }
  }
}

TEST(PrivacyGaussian, EpsilonAndDeltaAreInverse) {
  for (const double mu : {0.3, 1.0, 6.22, 30.0, 100.0}) {
    const double epsilon = exact_epsilon(mu, 0.1);
    EXPECT_TRUE(std::isfinite(epsilon));
    EXPECT_NEAR(exact_delta(epsilon, mu), 0.1, 1e-9);
  }
  EXPECT_EQ(exact_epsilon(0, 0.1), 0);
  EXPECT_EQ(exact_epsilon(0.1, 0.1), 0);  // so little that delta alone covers it
  EXPECT_TRUE(std::isinf(exact_epsilon(std::numeric_limits<double>::infinity(), 0.1)));
}

TEST(PrivacyGaussian, RefusesWhatIsNoPrivacy) {
  EXPECT_THROW(gamma_factor(0, 0.1), InputError);
  EXPECT_THROW(gamma_factor(-1, 0.1), InputError);
  EXPECT_THROW(gamma_factor(1, 0.5), InputError);
  EXPECT_THROW(gamma_factor(1, 0), InputError);
  EXPECT_THROW(gamma_factor(std::nan(""), 0.1), InputError);
}

TEST(PrivacyGaussian, AShiftWithoutNoiseIsSeenForCertain) {
  const MatrixXd D = MatrixXd::Identity(2, 2);
  MatrixXd S = MatrixXd::Identity(2, 2);
  EXPECT_NEAR(PrivacyLoss(D, S, 0.5).mu(), 0.5, 1e-14);
  S(1, 1) = 0;
  EXPECT_TRUE(std::isinf(PrivacyLoss(D, S, 0.5).mu()));
  EXPECT_NEAR(PrivacyLoss(D.leftCols(1), S, 0.5).mu(), 0.5, 1e-14);
  EXPECT_EQ(PrivacyLoss(D, S, 0).mu(), 0);
}

// The sampled loss against the exact law: one published mean of section 3.5, 20000 draws, four standard errors.
TEST(PrivacyGaussian, TheSampledLossAgreesWithTheExactOne) {
  const DpSettings settings = turn_settings();
  const DpFusion design = design_dp_fusion(turning_target(), settings);
  const double variance = design.q_total / settings.kappa;
  const MatrixXd D = design.nominal.W * column_of(design.KCH) / settings.kappa;
  const PrivacyLoss loss(D, variance * MatrixXd::Identity(4, 4), settings.lambda);
  EXPECT_NEAR(loss.mu(), 1 / design.gamma, 1e-12);
  EXPECT_NEAR(loss.shift().norm(), 0.0737, 5.1e-5);
  EXPECT_NEAR(std::sqrt(variance), 0.1607, 5.1e-5);
  const Draws draws(17, "loss");
  const int count = 20000;
  int above = 0;
  Eigen::VectorXd z(4);
  for (std::int64_t k = 0; k < count; ++k) {
    draws.normals(k, z);
    if (loss.sampled(std::sqrt(variance) * z) > kLn2) ++above;
  }
  EXPECT_NEAR(above / static_cast<double>(count), 0.1, 4 * std::sqrt(0.09 / count));
}

TEST(PrivacyDp, TheTurningTargetsTable) {
  const FusionModel model = turning_target();
  const DpFusion design = design_dp_fusion(model, turn_settings());
  EXPECT_NEAR(design.sigma, 0.7371411, 5.1e-8);
  EXPECT_NEAR(design.q_total, 0.2581896, 5.1e-8);
  EXPECT_NEAR(design.condition[0], 31.25, 5.1e-3);
  EXPECT_NEAR(design.condition[1], 5.729, 5.1e-4);
  EXPECT_NEAR(design.compensated.P.trace(), 0.8632, 5.1e-5);
  EXPECT_NEAR(design.public_P.trace(), 1.0969, 5.1e-5);
  EXPECT_NEAR(design.Pc.topLeftCorner(4, 4).trace(), 182.7, 5.1e-2);
  EXPECT_NEAR(design.Pc.bottomRightCorner(4, 4).trace(), 5.824, 5.1e-4);
  EXPECT_NEAR(design.q_centre_enough, design.q_centre / 100, 1e-15);
  // What is public is what the nominal weights make of the messages.
  const MatrixXd fused = design.nominal.W * design.Pc * design.nominal.W.transpose();
  EXPECT_LE((fused - design.public_P).norm(), 1e-10);
}

TEST(PrivacyDp, AllNoiseAtOneSensor) {
  const FusionModel model = turning_target();
  DpSettings settings = turn_settings();
  settings.shares = {0, 1};
  const DpFusion second = design_dp_fusion(model, settings);
  EXPECT_NEAR(second.compensated.P.trace(), 0.1042, 5.1e-5);
  EXPECT_NEAR(second.public_P.trace(), 1.0969, 5.1e-5);
  EXPECT_NEAR(second.Pc.topLeftCorner(4, 4).trace(), 0.1074, 5.1e-5);
  EXPECT_NEAR(second.Pc.bottomRightCorner(4, 4).trace(), 11.55, 5.1e-3);
  EXPECT_TRUE(std::isinf(dp_views(second, settings).packets));
  settings.shares = {1, 0};
  EXPECT_NEAR(design_dp_fusion(model, settings).compensated.P.trace(), 0.0994, 5.1e-5);
}

TEST(PrivacyDp, LessNoiseForLongerMeansAndLaxerPrivacy) {
  struct Row {
    int kappa;
    double epsilon, open, compensated, digit;
  };
  for (const Row& row : {Row{5, kLn2, 2.130, 1.661, 5.1e-4}, Row{20, kLn2, 0.5805, 0.4645, 5.1e-5},
                         Row{40, kLn2, 0.3223, 0.2650, 5.1e-5}, Row{10, 0.3, 4.727, 3.666, 5.1e-4},
                         Row{10, 1, 0.6171, 0.4927, 5.1e-5}, Row{10, 2, 0.2458, 0.2059, 5.1e-5}}) {
    DpSettings settings = turn_settings();
    settings.kappa = row.kappa;
    settings.epsilon = row.epsilon;
    const DpFusion design = design_dp_fusion(turning_target(), settings);
    EXPECT_NEAR(design.public_P.trace(), row.open, row.digit);
    EXPECT_NEAR(design.compensated.P.trace(), row.compensated, row.digit);
  }
}

// Section 3.5, every row: mu, P(loss > ln 2) and epsilon at delta 0.1.
TEST(PrivacyDp, WhatTheGuaranteeCovers) {
  const DpSettings settings = turn_settings();
  const DpViews views = dp_views(design_dp_fusion(turning_target(), settings), settings);
  struct Row {
    double mu, expected, digit, probability, epsilon, epsilon_digit;
  };
  for (const Row& row :
       {Row{views.mean, 0.4588, 5.1e-5, 0.100, 0.231, 5.1e-4},
        Row{views.mean_worst, 0.632, 5.1e-4, 0.217, 0.483, 5.1e-4},
        Row{views.mean_difference, 1.026, 5.1e-4, 0.435, 1.21, 5.1e-3},
        Row{views.instant, 1.451, 5.1e-4, 0.598, 2.22, 5.1e-3}, Row{views.packets, 1.769, 5.1e-4, 0.689, 3.10, 5.1e-3},
        Row{views.fused_stream, 1.533, 5.1e-4, 0.623, 2.43, 5.1e-3},
        Row{views.packet_stream, 1.845, 5.1e-4, 0.708, 3.33, 5.1e-3},
        Row{views.sustained, 6.22, 5.1e-3, 0.999, 26.4, 5.1e-2}}) {
    EXPECT_NEAR(row.mu, row.expected, row.digit);
    EXPECT_NEAR(loss_probability(kLn2, row.mu), row.probability, 5.1e-4);
    EXPECT_NEAR(exact_epsilon(row.mu, 0.1), row.epsilon, row.epsilon_digit);
  }
  EXPECT_EQ(views.worst_lag, 5);
}

TEST(PrivacyDp, NothingToHideNeedsNoNoise) {
  DpSettings settings = turn_settings();
  settings.lambda = 0;
  const DpFusion design = design_dp_fusion(turning_target(), settings);
  EXPECT_EQ(design.q_total, 0);
  EXPECT_EQ(dp_views(design, settings).packet_stream, 0);
  EXPECT_LE((design.compensated.P - design.nominal.P).norm(), 1e-12);
}

TEST(PrivacyDp, RefusesSettingsOutOfRange) {
  const FusionModel model = turning_target();
  const auto refused = [&](auto change) {
    DpSettings settings = turn_settings();
    change(settings);
    EXPECT_THROW(design_dp_fusion(model, settings), InputError);
  };
  refused([](DpSettings& s) { s.kappa = 0; });
  refused([](DpSettings& s) { s.lambda = -1; });
  refused([](DpSettings& s) { s.H = Eigen::Vector4d(1, 0.5, 1, 0); });
  refused([](DpSettings& s) { s.H = Eigen::Vector3d(1, 0, 1); });
  refused([](DpSettings& s) { s.shares = {0.5, 0.4}; });
  refused([](DpSettings& s) { s.shares = {1.5, -0.5}; });
  refused([](DpSettings& s) { s.epsilon = 0; });
}

}  // namespace
}  // namespace vigil::privacy::dp_fusion_test
