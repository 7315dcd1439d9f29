// The sampled privacy loss of every view of sections 3.5 and 4.5 against its exact law, with the noise that the
// mechanisms draw in a run.
#include "engine/methods/privacy/loss_meter.hpp"

#include <gtest/gtest.h>

#include "engine/methods/privacy/two_step.hpp"
#include "tests/engine/methods/privacy/loss_rig.hpp"

namespace vigil::loss_meter_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using rig::Mechanism;
using rig::Sample;

const double kLn2 = std::log(2.0);
const std::vector<std::string> kOutputs{"1", "2", "fused"};
const Json kTurn = {{"H", {1, 0, 1, 0}}};

void expect_table(const std::map<std::string, Sample>& shares, const std::string& name, double table) {
  const Sample& mine = shares.at(name);
  EXPECT_NEAR(mine.mean(), table, 4 * std::hypot(mine.error(), 0.0035)) << name;  // the table's own standard error
}

TEST(PrivacyLossMeter, TwoStepNoise) {
  Mechanism mechanism(rig::knowledge_of_model(privacy::engine_model()), "two_step", Json::object());
  const auto shares = rig::sampled_losses(mechanism, kLn2, 150);
  rig::expect_exact_losses(shares, mechanism.protection().design(), kOutputs);
  EXPECT_EQ(shares.size(), 10U);
  expect_table(shares, "0/loss.single", 0.034);
  expect_table(shares, "0/loss.difference", 0.027);
  expect_table(shares, "0/loss.prefix", 0.060);
  expect_table(shares, "0/loss.stream", 0.481);
  expect_table(shares, "1/loss.single", 0.087);
  expect_table(shares, "1/loss.difference", 0.203);
  expect_table(shares, "1/loss.prefix", 0.267);
  expect_table(shares, "1/loss.stream", 0.431);
}

TEST(PrivacyLossMeter, NoiseAtTheSensors) {
  const Knowledge known = rig::knowledge_of_model(privacy::turning_target());
  Mechanism uniform(known, "dp_sensors", kTurn);
  const auto shares = rig::sampled_losses(uniform, kLn2, 100);
  rig::expect_exact_losses(shares, uniform.protection().design(), kOutputs);
  EXPECT_EQ(shares.size(), 8U);
  expect_table(shares, "2/loss.mean_difference", 0.4327);
  expect_table(shares, "2/loss.instant", 0.5963);
  Json one = kTurn;
  one["shares"] = {0, 1};
  Mechanism second(known, "dp_sensors", one);
  const auto some = rig::sampled_losses(second, kLn2, 50);
  rig::expect_exact_losses(some, second.protection().design(), kOutputs);
  EXPECT_EQ(some.size(), 6U);  // the packets of the sensor without noise are seen for certain
}

TEST(PrivacyLossMeter, NoiseAtTheCentre) {
  Json enough = kTurn;
  enough["as_printed"] = false;
  Mechanism mechanism(rig::knowledge_of_model(privacy::turning_target()), "dp_centre", enough);
  const auto shares = rig::sampled_losses(mechanism, kLn2, 100);
  rig::expect_exact_losses(shares, mechanism.protection().design(), kOutputs);
  EXPECT_EQ(shares.size(), 5U);
}

/// ln of how much likelier S has `noise` than `noise + shift`, by its definition.
double log_ratio(const VectorXd& noise, const VectorXd& shift, const MatrixXd& S) {
  const Eigen::LLT<MatrixXd> factor(S);
  const VectorXd moved = noise + shift;
  return 0.5 * (moved.dot(factor.solve(moved)) - noise.dot(factor.solve(noise)));
}

// The messages of estimates that are zero are the noise itself.
TEST(PrivacyLossMeter, TheLossIsThatOfTheMessagesSent) {
  const privacy::FusionModel model = privacy::engine_model();
  Mechanism mechanism(rig::knowledge_of_model(model), "two_step", Json::object());
  privacy::TwoStepSettings settings;
  settings.H = Eigen::Vector3d::Ones();
  const privacy::TwoStep design = privacy::design_two_step(model, settings);
  const privacy::TwoStepViews views = privacy::two_step_views(design, settings, 1);
  const MatrixXd second = 0.01 * design.Pi.bottomRightCorner(3, 3), unit = MatrixXd::Identity(3, 3);
  VectorXd before;
  for (int k = 0; k < 40; ++k) {
    mechanism.tick();
    const VectorXd message = mechanism.messages.col(1);
    const double single = mechanism.book().at("1/loss.single"), difference = mechanism.book().at("1/loss.difference");
    EXPECT_EQ(std::isnan(single), k < 4);
    EXPECT_EQ(std::isnan(difference), k < 5);
    if (k >= 4) {
      EXPECT_NEAR(single, log_ratio(message, views.single.shift(), design.Qphi[1]), 1e-10);
    }
    if (k >= 5) {
      const MatrixXd S = 2 * design.q_xi[1] * unit + 2 * second;
      EXPECT_NEAR(difference, log_ratio(message - before, views.difference.shift(), S), 1e-10);
    }
    before = message;
  }
}

// 60 messages before the difference and 60 after it, so that it is judged when the last of these has gone.
TEST(PrivacyLossMeter, AStreamIsJudgedWhenItsLastMessageHasGone) {
  const privacy::FusionModel model = privacy::engine_model();
  Mechanism mechanism(rig::knowledge_of_model(model), "two_step", Json::object());
  privacy::TwoStepSettings settings;
  settings.H = Eigen::Vector3d::Ones();
  const auto views = privacy::two_step_views(privacy::design_two_step(model, settings), settings, 0);
  VectorXd noise(0);
  for (int k = 0; k < 200; ++k) {
    mechanism.tick();
    EXPECT_EQ(std::isnan(mechanism.book().at("0/loss.prefix")), k < 4 + 60) << k;
    EXPECT_EQ(std::isnan(mechanism.book().at("0/loss.stream")), k < 4 + 120) << k;
    noise.conservativeResize(noise.size() + 3);
    noise.tail(3) = mechanism.messages.col(0);
  }
  EXPECT_NEAR(mechanism.book().at("0/loss.stream"), views.stream.sampled(noise.tail(363)), 1e-9);
  EXPECT_NEAR(mechanism.book().at("0/loss.prefix"), views.prefix.sampled(noise.tail(183)), 1e-9);
}

TEST(PrivacyLossMeter, CountsTheTicksAboveEpsilon) {
  Mechanism mechanism(rig::knowledge_of_model(privacy::turning_target()), "dp_sensors", kTurn);
  int above = 0;
  for (int k = 0; k < 300; ++k) {
    mechanism.tick();
    above += mechanism.book().at("2/loss.instant") > kLn2 ? 1 : 0;
  }
  for (const OwnMetric& metric : mechanism.protection().metrics()) {
    EXPECT_EQ(metric.name, "p_loss");
    EXPECT_EQ(metric.output, 2);
    if (metric.variant == "instant") {
      EXPECT_DOUBLE_EQ(metric.value, above / 300.0);
    }
  }
  EXPECT_EQ(mechanism.protection().metrics().size(), 8U);
}

// A band of correlated noise, and independent ones: the same as the general formula.
TEST(PrivacyLossMeter, SpecialNoisesAgreeWithTheGeneralOne) {
  MatrixXd S = MatrixXd::Zero(30, 30), D(30, 2);
  for (int r = 0; r < 30; ++r) {
    for (int c = 0; c < 30; ++c) S(r, c) = std::max(0.0, 3.0 - std::abs(r - c));
    D.row(r) << std::sin(r), std::cos(2 * r);
  }
  const privacy::PrivacyLoss general(D, S, 0.7), banded = privacy::PrivacyLoss::banded(D, S.sparseView(), 0.7);
  EXPECT_NEAR(banded.mu(), general.mu(), 1e-10);
  EXPECT_LE(
      (banded.weights() * banded.weights().transpose() - general.weights() * general.weights().transpose()).norm(),
      1e-9);
  const VectorXd variances = VectorXd::LinSpaced(30, 0.5, 2);
  const privacy::PrivacyLoss diagonal(D, MatrixXd(variances.asDiagonal()), 0.7);
  const auto white = privacy::PrivacyLoss::white(D, variances, 0.7);
  EXPECT_NEAR(white.mu(), diagonal.mu(), 1e-10);
  EXPECT_LE((white.shift() * white.shift().transpose() - diagonal.shift() * diagonal.shift().transpose()).norm(), 1e-9);
  EXPECT_TRUE(std::isinf(privacy::PrivacyLoss::white(D, VectorXd::Zero(30), 0.7).mu()));
  EXPECT_EQ(privacy::PrivacyLoss::white(D, VectorXd::Zero(30), 0).mu(), 0);
}

}  // namespace
}  // namespace vigil::loss_meter_test
