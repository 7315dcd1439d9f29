// The tables of the specification (privacy) as runs, and what a run with a fusion centre promises.
#include <cmath>
#include <set>

#include "tests/engine/runs/privacy_rig.hpp"

namespace vigil::privacy_run_test {
namespace {

using test::expect_same;
using test::privacy;
using test::Told004;

constexpr const char* kScenarios[] = {"robot-linear", "robot-nonlinear", "turn", "engine"};

/// Equal to the digits that the specification prints.
void expect_printed(double ours, double printed, double half_digit) { EXPECT_NEAR(ours, printed, half_digit * 1.02); }

// Section 2.5.
TEST(PrivacyRun, LinearRobotHasTheTracesOfTheSpecification) {
  const Told004 told(privacy("robot-linear"));
  const auto trace = [&](const std::string& who, int k) { return told.at("lane.contamination." + who, k); };
  expect_printed(trace("optimal.trace", 100), .4348, 5e-5);
  expect_printed(trace("1.trace", 100), .7321, 5e-5);
  expect_printed(trace("2.trace", 100), .8032, 5e-5);
  expect_printed(trace("1.compensated_trace", 100), 1.948, 5e-4);
  expect_printed(trace("2.compensated_trace", 100), 3.021, 5e-4);
  expect_printed(trace("fused.trace", 100), .9477, 5e-5);
  expect_printed(trace("eve.fusing.trace", 10), 116.8, .05);
  expect_printed(trace("eve.fusing.trace", 20), 763.8, .05);
  expect_printed(trace("eve.fusing.trace", 100), 8.973e4, 5);
  EXPECT_NEAR(told.at("lane.contamination.ci", 100), std::log2(8.973e4 / .9477), 1e-3);
  EXPECT_EQ(told.at("lane.contamination.rank", 100), 4);
  EXPECT_EQ(told.at("lane.unprotected.ci", 100), 0);
  EXPECT_EQ(told.at("lane.unprotected.rank", 100), 0);
}

// Section 5, figure 2-3: which components are gone, and when.
TEST(PrivacyRun, LinearRobotContaminatesTheSetsOfTheFigure) {
  const Told004 told(privacy("robot-linear"));
  const auto gone = [&](int k) {
    std::set<int> set;
    for (int c = 0; c < 4; ++c) {
      const std::string name = std::to_string(c / 2 + 1) + ".contaminated." + (c % 2 == 0 ? "position" : "velocity");
      if (told.at("lane.contamination." + name, k) > 0) set.insert(c);
    }
    return set;
  };
  const std::set<int> first{1, 2, 3}, middle{0, 1, 3};
  for (int k = 1; k <= 100; ++k) EXPECT_EQ(gone(k), k >= 4 && k <= 28 ? middle : first) << k;
  expect_printed(told.at("lane.contamination.fused.trace", 20), 1.00, 5e-3);
  expect_printed(told.at("lane.contamination.1.compensated_trace", 20), 3.18, 5e-3);
  expect_printed(told.at("lane.contamination.2.compensated_trace", 20), 2.00, 5e-3);
}

TEST(PrivacyRun, LinearRobotWithOneComponentGone) {
  const Json one = {{"lanes", {{"contamination", {{"protection", {{"params", {{"m", 1}}}}}}}}}};
  const Told004 told(privacy("robot-linear", one));
  const auto trace = [&](const std::string& who) { return told.at("lane.contamination." + who, 100); };
  EXPECT_EQ(told.at("lane.contamination.2.contaminated.position", 100), 1);
  expect_printed(trace("1.trace"), .7321, 5e-5);
  expect_printed(trace("2.compensated_trace"), 1.393, 5e-4);
  expect_printed(trace("fused.trace"), .5841, 5e-5);
  expect_printed(trace("eve.fusing.trace"), 8.955e4, 5);
  const std::vector<std::string> warnings = told.run.warnings();
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
    return text.find("null_dim") != std::string::npos || text.find("exact zeros") != std::string::npos;
  }));
}

// Section 3.4.
TEST(PrivacyRun, TurningTargetHasTheTracesOfTheSpecification) {
  const Told004 told(privacy("turn"));
  const auto at = [&](const std::string& signal) { return told.at("lane." + signal, 100); };
  expect_printed(at("dp_uniform.optimal.trace"), .06415, 5e-6);
  expect_printed(at("dp_uniform.fused.trace"), .8632, 5e-5);
  expect_printed(at("dp_uniform.eve.fusing.trace"), 1.0969, 5e-5);
  expect_printed(at("dp_uniform.1.trace"), .1074, 5e-5);
  expect_printed(at("dp_uniform.2.trace"), .1023, 5e-5);
  expect_printed(at("dp_one_sensor.fused.trace"), .1042, 5e-5);
  expect_printed(at("dp_one_sensor.eve.fusing.trace"), 1.0969, 5e-5);
  const Json design = told.run.design();
  EXPECT_NEAR(design["dp_uniform"]["sigma"].get<double>(), .7371411, 5e-8);
  EXPECT_NEAR(design["dp_uniform"]["q_tot"].get<double>(), .2581896, 5e-8);
}

// Section 4.7: the table at tick 100 and the two-step eavesdropper on its way there.
TEST(PrivacyRun, EngineHasTheTableOfTheSpecification) {
  const Told004 told(privacy("engine"));
  const auto at = [&](const std::string& signal, int k) { return told.at("lane." + signal, k); };
  const double two_step[][2] = {{1, .02463}, {2, .03314}, {5, .03314}, {6, .04165}, {50, .18628}, {100, .35644}};
  for (const auto& [k, printed] : two_step)
    expect_printed(at("two_step.eve.differencing.trace", static_cast<int>(k)), printed, 5e-6);
  expect_printed(at("two_step.fused.trace", 100), .0127116, 5e-8);
  expect_printed(at("two_step.ci", 100), 4.81, 5e-3);
  EXPECT_EQ(at("two_step.rank", 100), 3);
  expect_printed(at("two_step.eve.window_mean.trace", 100), .0242, 1e-4);  // .024272: the digits round otherwise
  expect_printed(at("two_step.eve.window_mean.ci", 100), .93, 5e-3);
  const double user[][2] = {{1, .01714}, {2, .02681}, {5, .05499}, {10, .06897}, {20, .06989}, {100, .06943}};
  for (const auto& [k, printed] : user) {
    expect_printed(at("contamination.fused.trace", static_cast<int>(k)), printed, 5e-6);
    expect_printed(at("contamination.eve.fusing.trace", static_cast<int>(k)), .27385, 5e-6);
  }
  expect_printed(at("contamination.ci", 100), 1.98, 5e-3);
  EXPECT_EQ(at("contamination.rank", 100), 1);
  expect_printed(at("secrecy_code_l.eve.fusing.trace", 100), .26958, 5e-6);
  expect_printed(at("secrecy_code_l.ci", 100), 5.25, 5e-3);
  for (const char* lane : {"unprotected", "secrecy_code_a", "secrecy_code_l"})
    expect_printed(at(std::string(lane) + ".fused.trace", 100), .0071039, 5e-8);
  EXPECT_NEAR(told.run.design()["two_step"]["slope"].get<double>(), .003403, 5e-7);
}

// The table's code A is that of the steady state, which the exact trace reaches late: both start from a message that
// was heard.
TEST(PrivacyRun, CodeAReachesItsSteadyState) {
  const Told004 told(privacy("engine", {{"time", {{"steps", 800}}}}));
  expect_printed(told.at("lane.secrecy_code_a.eve.fusing.trace", 800), .08961, 5e-6);
  expect_printed(told.at("lane.secrecy_code_a.ci", 800), 3.66, 5e-3);
  EXPECT_NEAR(told.at("lane.secrecy_code_a.eve.fusing.trace", 100), .08961, 5e-4);
}

TEST(PrivacyRun, TheLawOfTracesHolds) {
  for (const char* which : kScenarios) {
    SCOPED_TRACE(which);
    const Told004 simulated(privacy(which), 7);
    const auto trace =
        std::make_shared<Trace>(Trace::from_csv(test::csv_of(simulated.run.catalogue(), simulated.capture.frames)));
    const Told004 replayed(privacy(which), 7, trace);
    expect_same(simulated.run, simulated.capture, replayed.run, replayed.capture, "lane.");
  }
}

TEST(PrivacyRun, ACopyGoesOnAsTheRunDoes) {
  for (const char* which : kScenarios) {
    SCOPED_TRACE(which);
    vigil::Run run(privacy(which), {3, nullptr, {}});
    test::Capture whole, rest, other;
    for (int k = 0; k <= 40; ++k) run.step(whole);
    vigil::Run fork = run;
    test::run_to_end(run, rest);
    test::run_to_end(fork, other);
    expect_same(run, rest, fork, other, "");
  }
}

TEST(PrivacyRun, LanesDoNotDependOnThoseBesideThem) {
  for (const char* which : kScenarios) {
    const Scenario scenario = privacy(which);
    const Told004 all(scenario, 5);
    for (const auto& [lane, entry] : scenario.document()["lanes"].items()) {
      SCOPED_TRACE(std::string(which) + " " + lane);
      Json alone = scenario.document();
      alone["lanes"] = {{lane, entry}};
      const Told004 one(Scenario::from_json(alone), 5);
      expect_same(one.run, one.capture, all.run, all.capture, "lane." + lane + ".");
    }
  }
}

TEST(PrivacyRun, TheUserDoesNotSeeHowMuchNoiseHidesIt) {
  const Json more = {{"lanes", {{"two_step", {{"protection", {{"params", {{"q_alpha", .04}}}}}}}}}};
  const Told004 told(privacy("engine"), 9), louder(privacy("engine", more), 9);
  for (int k = 0; k <= 200; ++k) {
    const double mine = told.at("lane.two_step.fused.estimate.x2", k);
    EXPECT_NEAR(louder.at("lane.two_step.fused.estimate.x2", k), mine, 1e-9);
  }
  const auto growth = [](const Told004& run) {
    return run.at("lane.two_step.eve.differencing.trace", 100) - run.at("lane.two_step.eve.differencing.trace", 1);
  };
  EXPECT_NEAR(growth(louder), 4 * growth(told), 1e-9);
}

TEST(PrivacyRun, NobodyHearsALaneThatIsSpared) {
  const Json spared = {{"lanes", {{"unprotected", {{"adversary", false}}}}}};
  const Told004 told(privacy("robot-linear", spared));
  EXPECT_EQ(told.at("link.1-fused.overheard", 50), 1);
  for (int k = 0; k <= 100; ++k) {  // the prior (0, 1), moved on by the model
    EXPECT_NEAR(told.at("lane.unprotected.eve.fusing.estimate.position", k), k, 1e-9);
    EXPECT_NEAR(told.at("lane.unprotected.eve.fusing.estimate.velocity", k), 1, 1e-9);
  }
}

TEST(PrivacyRun, AnEavesdropperKnowsWhatItHears) {
  Json some = {{"adversary", {{"eve", {{"on", Json::array({"link:1-fused"})}, {"from", 50}, {"to", 60}}}}}};
  const Told004 told(privacy("robot-linear", some));
  for (int k = 0; k <= 100; ++k) {
    EXPECT_EQ(told.at("link.1-fused.overheard", k), k >= 50 && k <= 60 ? 1 : 0) << k;
    EXPECT_EQ(told.at("link.2-fused.overheard", k), 0);
    if (k < 50) {
      EXPECT_NEAR(told.at("lane.unprotected.eve.fusing.estimate.velocity", k), 1, 1e-9);
    }
  }
  EXPECT_GT(std::abs(told.at("lane.unprotected.eve.fusing.estimate.velocity", 50) - 1), 1e-3);
  const auto believed = [&](int k) { return told.at("lane.unprotected.eve.fusing.estimate.position", k); };
  for (int k = 62; k <= 100; ++k)  // both messages moved on at their own constant speed, the weights settled
    EXPECT_NEAR(believed(k) - 2 * believed(k - 1) + believed(k - 2), 0, 1e-9) << k;
}

TEST(PrivacyRun, AJammedMessageIsPredicted) {
  const Json jam = {
      {"adversary",
       {{"jam", {{"type", "dos"}, {"on", Json::array({"link:1-fused"})}, {"params", {{"probability", 0.4}}}}}}}};
  for (const char* which : kScenarios) {
    SCOPED_TRACE(which);
    const Told004 told(privacy(which, jam));
    EXPECT_TRUE(told.run.faults().empty());
    int lost = 0;
    for (int k = 1; k <= 100; ++k) lost += told.at("link.1-fused.state", k) == 1 ? 1 : 0;
    EXPECT_GT(lost, 15);
    EXPECT_LT(lost, 65);
    double worse = 0;
    for (int k = 1; k <= 100; ++k) {
      const double user = told.at("lane.unprotected.fused.trace", k);
      ASSERT_TRUE(std::isfinite(user));
      worse += user - told.at("lane.unprotected.optimal.trace", k);
    }
    EXPECT_GT(worse, 0) << "less is known where a message is lost";
  }
}

TEST(PrivacyRun, NoiseOnLinksServesAnyLaneThatTalks) {
  const auto noisy = [](double variance) {
    return Json{
        {"lanes",
         {{"consensus", {{"protection", {{"type", "gaussian_noise"}, {"params", {{"variance", variance}}}}}}}}}};
  };
  const Scenario plain = Scenario::preset("consensus");
  const Told004 without(plain), none(plain.patched(noisy(0))), some(plain.patched(noisy(4)));
  expect_same(without.run, without.capture, none.run, none.capture, "lane.");
  EXPECT_NE(some.at("lane.consensus.1.estimate.x", 30), without.at("lane.consensus.1.estimate.x", 30));
  EXPECT_EQ(some.at("lane.clean.1.estimate.x", 30), without.at("lane.clean.1.estimate.x", 30));
}

TEST(PrivacyRun, RefusesWhatCannotBe) {
  Json consensus = Scenario::preset("consensus").document();
  consensus["lanes"]["consensus"]["protection"] = {{"type", "two_step"}};
  test::expect_refused(consensus, "/lanes/consensus/protection/params");  // not linear
  consensus["lanes"]["consensus"]["protection"] = {{"type", "contamination"}};
  test::expect_refused(consensus, "/lanes/consensus/protection/type");  // no centre
  consensus["lanes"]["consensus"]["protection"] = {{"type", "two_steps"}};
  test::expect_refused(consensus, "/lanes/consensus/protection/type");
  consensus["lanes"]["consensus"].erase("protection");
  consensus["lanes"]["isolated"]["protection"] = {{"type", "gaussian_noise"}};
  test::expect_refused(consensus, "/lanes/isolated/protection/type");
  Json engine = privacy("engine").document();
  const auto with = [&](const std::string& lane, const std::string& name, const Json& value) {
    Json changed = engine;
    changed["lanes"][lane]["protection"]["params"][name] = value;
    return changed;
  };
  test::expect_refused(with("two_step", "tq", 0), "/lanes/two_step/protection/params/tq");
  test::expect_refused(with("two_step", "epsilon", 0), "/lanes/two_step/protection/params/epsilon");
  test::expect_refused(with("two_step", "delta", .5), "/lanes/two_step/protection/params/delta");
  test::expect_refused(with("two_step", "zeta", -1), "/lanes/two_step/protection/params/zeta");
  test::expect_refused(with("two_step", "H", {1, 2, 1}), "/lanes/two_step/protection/params/H");
  test::expect_refused(with("two_step", "q_xi", {1}), "/lanes/two_step/protection/params/q_xi");
  test::expect_refused(with("contamination", "m", 7), "/lanes/contamination/protection/params/m");
  test::expect_refused(with("secrecy_code_a", "loss", 1.5), "/lanes/secrecy_code_a/protection/params/loss");
  Json blind = engine;
  blind["nodes"]["1"]["sensor"]["params"]["C"] = Json::array({Json::array({0, 0, 0})});
  blind["plant"]["params"]["A"][0][0] = 1.2;
  blind["initial"]["x0_random"] = false;
  test::expect_refused(blind, "/initial/estimates");
  Json none = engine;
  none["network"]["graph"] = "none";
  test::expect_refused(none, "/lanes/unprotected/params");
  Json turn = privacy("turn").document();
  turn["initial"]["x0_random"] = true;
  test::expect_refused(turn, "/initial/x0_random");
  turn["initial"]["x0_random"] = false;
  turn["lanes"]["dp_uniform"]["protection"]["params"]["shares"] = {.5, .6};
  test::expect_refused(turn, "/lanes/dp_uniform/protection/params/shares");
}

}  // namespace
}  // namespace vigil::privacy_run_test
