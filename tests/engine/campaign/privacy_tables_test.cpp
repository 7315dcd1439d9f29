/// Monte Carlo of seed 004's scenarios: mean squared errors over runs beside the covariances, and the figures of the
/// specification (privacy), sections 2.5, 2.6, 2.8, 3.5 and 4.5, within four standard errors.
#include <cmath>
#include <map>

#include "tests/engine/campaign/section12.hpp"
#include "tests/engine/runs/privacy_rig.hpp"

namespace vigil::privacy_tables_test {
namespace {

using section12::Results;
using test::privacy;
using test::Told004;

int runs() { return section12::runs(100, 1000); }

void expect_mean(const MetricSummary& row, double exact, const std::string& what) {
  EXPECT_LT(std::abs(row.mean - exact), 4 * row.se + 1e-9 * exact)
      << what << ": " << row.mean << " +- " << row.se << ", exactly " << exact;
}

void expect_traces(const char* which) {
  const Scenario scenario = privacy(which);
  const Results table(scenario, runs());
  const Told004 one(scenario);
  const auto last = static_cast<int>(*one.run.steps());
  int compared = 0;
  for (const auto& [lane, entry] : scenario.document()["lanes"].items()) {
    const auto compare = [&](const std::string& metric, const std::string& node, const std::string& variant,
                             const std::string& signal) {
      const double trace = one.at("lane." + lane + "." + signal, last);
      if (!std::isfinite(trace)) return;
      expect_mean(table.row(lane, metric, node, variant), trace, lane + " " + metric + " " + node + variant);
      ++compared;
    };
    compare("mse_legitimate", "", "", "fused.trace");
    compare("mse_optimal", "", "", "optimal.trace");
    for (const char* variant : {"fusing", "differencing", "window_mean", "zero"}) {
      if (one.run.catalogue().find("lane." + lane + ".eve." + variant + ".trace") < 0) continue;
      compare("mse_eavesdropper", "", variant, std::string("eve.") + variant + ".trace");
    }
    for (const char* node : {"1", "2"}) {
      compare("mse_local", node, "", std::string(node) + ".trace");
      compare("mse_compensated", node, "", std::string(node) + ".compensated_trace");
    }
  }
  EXPECT_GE(compared, 12);
}

TEST(PrivacyTables, LinearRobotAgreesWithItsCovariances) { expect_traces("robot-linear"); }
TEST(PrivacyTables, TurningTargetAgreesWithItsCovariances) { expect_traces("turn"); }
TEST(PrivacyTables, EngineAgreesWithItsCovariances) { expect_traces("engine"); }

// Section 2.5: time averages over [81, 100].
TEST(PrivacyTables, LinearRobotOverTheLastFifth) {
  const Results table(privacy("robot-linear"), 100);
  EXPECT_NEAR(table.row("contamination", "mse_optimal_mean").mean, .4348, .12 * .4348);
  EXPECT_NEAR(table.row("contamination", "mse_legitimate_mean").mean, .9477, .12 * .9477);
  EXPECT_NEAR(table.row("contamination", "mse_eavesdropper", "", "fusing").mean, 8.973e4, .45 * 8.973e4);
  EXPECT_NEAR(table.row("contamination", "mse_eavesdropper_mean", "", "fusing").mean, 6.76e4, .45 * 6.76e4);
}

// A pooled log-ratio is that of the pooled errors.
TEST(PrivacyTables, TheIndexIsPooledAsItsErrorsAre) {
  const Results table(privacy("engine"), 40);
  for (const char* lane : {"two_step", "contamination", "secrecy_code_a"}) {
    const std::string variant = std::string(lane) == "two_step" ? "differencing" : "fusing";
    const MetricSummary& pooled = table.row(lane, "ci_mse", "", variant);
    const double above = table.row(lane, "mse_eavesdropper_mean", "", variant).mean;
    EXPECT_NEAR(pooled.mean, std::log2(above / table.row(lane, "mse_legitimate_mean").mean), 1e-12);
    EXPECT_GT(pooled.se, 0);
  }
}

// Section 2.6: means over t = 11..100.
TEST(PrivacyTables, NonlinearRobotHasTheErrorsOfTheSpecification) {
  const int count = 100;
  std::map<std::string, double> mean;
  for (int seed = 1; seed <= count; ++seed) {
    const Told004 told(privacy("robot-nonlinear"), static_cast<std::uint64_t>(seed));
    for (const char* who :
         {"optimal.square", "fused.square", "eve.fusing.square", "1.compensated_square", "2.compensated_square"}) {
      for (int k = 11; k <= 100; ++k) mean[who] += told.at(std::string("lane.contamination.") + who, k) / (90. * count);
    }
  }
  EXPECT_NEAR(mean["optimal.square"], .042, .004);
  EXPECT_NEAR(mean["fused.square"], .13, .03);
  EXPECT_NEAR(mean["1.compensated_square"], .15, .03);
  EXPECT_NEAR(mean["2.compensated_square"], .14, .03);
  EXPECT_NEAR(mean["eve.fusing.square"], 660, 60);
}

// What (2-52) and (4-12) do as they are printed.
TEST(PrivacyTables, ThePrintedDerivativeMakesTheFusedErrorSeventeenTimesLarger) {
  const Json printed = {{"params", {{"printed_jacobian", true}}}};
  const Json patch = {{"lanes", {{"unprotected", printed}, {"contamination", printed}}}};
  const int count = 60;
  double optimal = 0, user = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const Told004 told(privacy("robot-nonlinear", patch), static_cast<std::uint64_t>(seed));
    for (int k = 11; k <= 100; ++k) {
      optimal += told.at("lane.contamination.optimal.square", k) / (90. * count);
      user += told.at("lane.contamination.fused.square", k) / (90. * count);
    }
  }
  EXPECT_GT(optimal, .5);
  EXPECT_LT(optimal, 1.1);
  EXPECT_GT(user, 10) << "useless";
}

TEST(PrivacyTables, ThePrintedSumsDoNotTelescope) {
  const Json patch = {{"lanes", {{"two_step", {{"protection", {{"params", {{"sum", "printed"}}}}}}}}}};
  const int count = 300;
  std::map<int, double> mean;
  for (int seed = 1; seed <= count; ++seed) {
    const Told004 told(privacy("engine", patch), static_cast<std::uint64_t>(seed));
    for (const int k : {5, 6, 200}) mean[k] += told.at("lane.two_step.fused.square", k) / count;
    EXPECT_TRUE(std::isfinite(told.at("lane.two_step.fused.trace", 5)));
    EXPECT_TRUE(std::isnan(told.at("lane.two_step.fused.trace", 6)));
  }
  EXPECT_NEAR(mean[5], .0127, .003);
  EXPECT_NEAR(mean[6], .27, .09);
  EXPECT_NEAR(mean[200], .675, .2);
}

Json channel(const char* kind, double power) {
  return {{"lanes",
           {{"contamination", nullptr},
            {"unprotected", nullptr},
            {"complex_noise", {{"protection", {{"params", {{"channel", kind}, {"power", power}}}}}}}}}};
}

// Section 2.8, at t = 100.
TEST(PrivacyTables, ComplexNoiseHasTheErrorsOfTheSpecification) {
  const auto eve = [](const char* kind, double power, int count) {
    return Results(privacy("robot-linear", channel(kind, power)), count)
        .row("complex_noise", "mse_eavesdropper", "", "fusing")
        .mean;
  };
  EXPECT_NEAR(eve("fading", 1, 1000), 1.9, .5);
  EXPECT_NEAR(eve("fading", 5.6097, 1000), 46, 20);
  EXPECT_NEAR(eve("static", 1, 1000), .43, .05);
  EXPECT_NEAR(eve("static", 5.6097, 1000), 3.3e5, .45e5);
}

// Sections 3.5 and 4.5: what the runs' own noise lost, beside the exact probability.
void expect_losses(const char* which, const std::string& lane, int least) {
  const Results table(privacy(which), runs());
  const Told004 one(privacy(which));
  int compared = 0;
  const Json design = one.run.design();
  for (const auto& [view, nodes] : design[lane]["views"].items()) {
    for (const auto& [node, facts] : nodes.items()) {
      if (facts["mu"].is_null()) continue;
      expect_mean(table.row(lane, "p_loss", node, view), facts["p_loss"].get<double>(), lane + " " + view + " " + node);
      ++compared;
    }
  }
  EXPECT_GE(compared, least);
}

TEST(PrivacyTables, TwoStepLosesWhatItsViewsSay) { expect_losses("engine", "two_step", 8); }
TEST(PrivacyTables, DifferentialPrivacyLosesWhatItsViewsSay) { expect_losses("turn", "dp_uniform", 5); }

}  // namespace
}  // namespace vigil::privacy_tables_test
