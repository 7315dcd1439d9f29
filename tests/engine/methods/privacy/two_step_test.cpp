#include "engine/methods/privacy/two_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/gaussian_mechanism.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy::two_step_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TwoStepSettings engine_settings() {
  TwoStepSettings settings;
  settings.H = Eigen::Vector3d::Ones();
  return settings;
}

// Section 4.7.
TEST(PrivacyTwoStep, TheEnginesDesign) {
  const TwoStepSettings settings = engine_settings();
  const TwoStep design = design_two_step(engine_model(), settings);
  EXPECT_NEAR(design.q_xi[0], 0.0021801, 5.1e-8);
  EXPECT_NEAR(design.q_xi[1], 0.0043045, 5.1e-8);
  EXPECT_NEAR(design.compensated.P.trace(), 0.0127116, 5.1e-8);
  EXPECT_NEAR(design.leak, 0.0085080, 5.1e-8);
  EXPECT_NEAR(design.slope, 0.003403, 5.1e-7);
  EXPECT_NEAR(differencing_trace(design, 1, 5), 0.02463, 5.1e-6);
  for (int t = 2; t <= 5; ++t) EXPECT_NEAR(differencing_trace(design, t, 5), 0.03314, 5.1e-6);
  EXPECT_NEAR(differencing_trace(design, 6, 5), 0.04165, 5.1e-6);
  EXPECT_NEAR(differencing_trace(design, 50, 5), 0.18628, 5.1e-6);
  EXPECT_NEAR(differencing_trace(design, 100, 5), 0.35644, 5.1e-6);
  EXPECT_NEAR(window_mean_trace(engine_model(), design, settings), 0.0242, 1e-4);  // 0.024272; sampled below
  EXPECT_EQ(design.private_enough, (std::vector<bool>{true, true}));
}

TEST(PrivacyTwoStep, CountsTheNoisesTheDifferencesCarry) {
  const std::int64_t five[] = {0, 1, 2, 2, 2, 2, 3, 4, 4, 4, 4, 5};
  for (int t = 0; t <= 11; ++t) EXPECT_EQ(noises_carried(t, 5), five[t]) << t;
  for (int t = 1; t <= 11; ++t) EXPECT_EQ(noises_carried(t, 1), 1);
}

// xf(t) = Wc xp(t) whatever the noise, and xw(t) carries c(t) noises: their signs are counted with unit vectors.
TEST(PrivacyTwoStep, TheLegitimateUserSeesNoNullSpaceNoise) {
  const TwoStep design = design_two_step(engine_model(), engine_settings());
  const Draws draws(23, "two_step");
  for (const int window : {1, 2, 5}) {
    TwoStepSender loud(window), quiet(window);
    TwoStepReceiver user(design.compensated.W, window), other(design.compensated.W, window);
    for (std::int64_t t = 0; t < 1203; ++t) {
      VectorXd z(12);
      draws.normals(t, z);
      const VectorXd xp = z.head(6), hidden = 0.1 * design.Pi * z.tail(6);
      const VectorXd seen = user.receive(loud.send(xp, hidden)), alike = other.receive(quiet.send(xp, 2 * hidden));
      ASSERT_LE((seen - design.compensated.W * xp).norm(), 1e-10);
      ASSERT_LE((seen - alike).norm(), 1e-10);
    }
  }
}

TEST(PrivacyTwoStep, TheDifferencingEavesdropperGathersNoise) {
  for (const int window : {1, 2, 5}) {
    const int last = 40;
    TwoStepSender sender(window);
    TwoStepReceiver receiver(MatrixXd::Identity(last + 1, last + 1), window);
    for (int t = 0; t <= last; ++t) {  // noise t is the unit vector t
      const VectorXd carried = receiver.receive(sender.send(VectorXd::Zero(last + 1), VectorXd::Unit(last + 1, t)));
      EXPECT_NEAR(carried.squaredNorm(), static_cast<double>(noises_carried(t, window)), 1e-12) << window << " " << t;
    }
  }
}

// Section 4.5.
TEST(PrivacyTwoStep, WhatAnObserverOfTheMessagesLearns) {
  const TwoStepSettings settings = engine_settings();
  const TwoStep design = design_two_step(engine_model(), settings);
  const TwoStepViews first = two_step_views(design, settings, 0), second = two_step_views(design, settings, 1);
  EXPECT_NEAR(first.single.mu(), 0.345, 5.1e-4);
  EXPECT_NEAR(first.difference.mu(), 0.331, 5.1e-4);
  EXPECT_NEAR(first.prefix.mu(), 0.396, 5.1e-4);
  EXPECT_NEAR(first.stream.mu(), 1.131, 5.1e-4);
  EXPECT_NEAR(second.single.mu(), 0.441, 5.1e-4);
  EXPECT_NEAR(second.difference.mu(), 0.615, 5.1e-4);
  EXPECT_NEAR(second.prefix.mu(), 0.709, 5.1e-4);
  EXPECT_NEAR(second.stream.mu(), 1.011, 5.1e-4);
  EXPECT_NEAR(first.single_worst.mu(), 0.899, 5.1e-4);
  EXPECT_NEAR(second.single_worst.mu(), 0.766, 5.1e-4);
  EXPECT_EQ(first.worst_lag, 4);
  EXPECT_EQ(second.worst_lag, 4);
  EXPECT_NEAR(exact_epsilon(first.stream.mu(), 0.1), 1.44, 5.1e-3);
  EXPECT_NEAR(exact_epsilon(second.stream.mu(), 0.1), 1.18, 5.1e-3);
  EXPECT_NEAR(exact_epsilon(first.single_worst.mu(), 0.1), 0.957, 5.1e-4);
  EXPECT_NEAR(exact_epsilon(second.difference.mu(), 0.1), 0.456, 5.1e-4);
  EXPECT_NEAR(exact_epsilon(second.prefix.mu(), 0.1), 0.610, 5.1e-4);
}

/// Mean and standard error of the squared errors of the window mean and of the legitimate user, 240 chains through
/// filters, sender and receiver, each from zero and counted once that is forgotten.
struct Sampled {
  Eigen::Array2d mean = Eigen::Array2d::Zero(), error = Eigen::Array2d::Zero();
};
Sampled sample(const FusionModel& model, const TwoStep& design, int window) {
  const int chains = 240, first = 400, last = 1200;
  const MatrixXd root = model.Q.cwiseSqrt();
  Eigen::Array2d square = Eigen::Array2d::Zero();
  Sampled sampled;
  for (int chain = 0; chain < chains; ++chain) {
    const Draws draws(static_cast<std::uint64_t>(chain), "plant");
    VectorXd x = VectorXd::Zero(3), xhat = VectorXd::Zero(6), xp(6), z(16);
    TwoStepSender sender(window);
    TwoStepReceiver user(design.compensated.W, window);
    Eigen::Array2d mean = Eigen::Array2d::Zero();
    for (int t = 0; t < last; ++t) {
      draws.normals(t, z);
      x = model.A * x + model.B * (root * z.head(2));
      for (int i = 0; i < 2; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const SensorModel& sensor = model.sensors[at];
        const VectorXd ahead = model.A * xhat.segment(3 * i, 3);
        const VectorXd y = sensor.C * x + sensor.R.cwiseSqrt() * z.segment(2 + i, 1);
        xhat.segment(3 * i, 3) = ahead + design.filters.gains[at].K * (y - sensor.C * ahead);
        xp.segment(3 * i, 3) = xhat.segment(3 * i, 3) + std::sqrt(design.q_xi[at]) * z.segment(4 + 3 * i, 3);
      }
      const VectorXd message = sender.send(xp, 0.1 * design.Pi * z.tail(6));  // q_alpha = 0.01
      const VectorXd fused = user.receive(message);
      if (t < first) continue;
      mean[0] += (x - design.nominal.W * message / window).squaredNorm() / (last - first);
      mean[1] += (x - fused).squaredNorm() / (last - first);
    }
    sampled.mean += mean / chains;
    square += mean.square() / chains;
  }
  sampled.error = ((square - sampled.mean.square()) / (chains - 1)).sqrt();
  return sampled;
}

TEST(PrivacyTwoStep, SampledErrorsAgreeWithTheCovariances) {
  const TwoStepSettings settings = engine_settings();
  const TwoStep design = design_two_step(engine_model(), settings);
  const Sampled sampled = sample(engine_model(), design, settings.window);
  EXPECT_NEAR(sampled.mean[0], window_mean_trace(engine_model(), design, settings), 4 * sampled.error[0]);
  EXPECT_NEAR(sampled.mean[1], design.compensated.P.trace(), 4 * sampled.error[1]);
  EXPECT_LE(sampled.error[0], 0.01 * sampled.mean[0]);
}

TEST(PrivacyTwoStep, WithoutTheFirstNoiseNothingLeaks) {
  TwoStepSettings settings = engine_settings();
  settings.q_xi = {0, 0};
  const TwoStep design = design_two_step(engine_model(), settings);
  EXPECT_LE(std::abs(design.leak), 1e-12 * design.nominal.P.trace());
  EXPECT_EQ(design.private_enough, (std::vector<bool>{false, false}));
}

TEST(PrivacyTwoStep, RefusesSettingsOutOfRange) {
  const auto refused = [](auto change) {
    TwoStepSettings settings = engine_settings();
    change(settings);
    EXPECT_THROW(design_two_step(engine_model(), settings), InputError);
  };
  refused([](TwoStepSettings& s) { s.window = 0; });
  refused([](TwoStepSettings& s) { s.zeta = -1; });
  refused([](TwoStepSettings& s) { s.q_alpha = -1; });
  refused([](TwoStepSettings& s) { s.H = Eigen::Vector3d(1, 2, 1); });
  refused([](TwoStepSettings& s) { s.q_xi = {0.1}; });
  refused([](TwoStepSettings& s) { s.Rg = {MatrixXd::Identity(3, 3), MatrixXd::Zero(3, 3)}; });
}

}  // namespace
}  // namespace vigil::privacy::two_step_test
