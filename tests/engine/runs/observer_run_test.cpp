/// Observers as lanes of a run: beside the same equations without a run, beside the specification's table, on traces,
/// under attacks by hand. Gains here are given: what is solved for belongs to whoever has a solver.
#include "engine/methods/observer/printed_gains.hpp"
#include "engine/run/design.hpp"
#include "tests/engine/methods/observer/networks.hpp"
#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::observer_run_test {
namespace {

using test::Told;

/// A preset with the printed gains alone.
Scenario printed(const Json& patch = Json::object()) {
  Json document = Scenario::preset("observer-pair").document();
  document["lanes"] = {{"intermediate_printed", document["lanes"]["intermediate_printed"]}};
  document.merge_patch(patch);
  return Scenario::from_json(document);
}

/// Gains that are given run by their problem's key.
RunOptions options(const Scenario& scenario) {
  RunOptions made;
  for (const DesignTask& task : design_tasks(scenario)) made.designs[task.lane] = {{"key", task.key}};
  return made;
}

Json steps(int count) { return {{"time", {{"steps", count}}}}; }

double figure(const vigil::Run& run, const std::string& name, const std::string& node) {
  return test::metric(run.metrics(), "intermediate_printed", name, node);
}

TEST(ObserverRun, GivesTheSpecificationsTableForThePrintedGains) {
  const Scenario scenario = printed();
  const Told told(scenario, options(scenario));
  EXPECT_NEAR(figure(told.run, "rms_attack_error", "1"), 0.698, 0.0005);
  EXPECT_NEAR(figure(told.run, "rms_attack_error", "2"), 0.801, 0.0005);
  EXPECT_NEAR(figure(told.run, "rms_fault_error", "1"), 0.013, 0.0005);
  EXPECT_NEAR(figure(told.run, "rms_fault_error", "2"), 0.054, 0.0005);
  EXPECT_NEAR(figure(told.run, "rms_state_error", "1"), 0.0181, 0.00005);
  EXPECT_NEAR(figure(told.run, "rms_state_error", "2"), 0.1194, 0.00005);
}

TEST(ObserverRun, IsTheStackedDifferentialEquation) {
  const Scenario scenario = printed(steps(3000));
  const Told told(scenario, options(scenario));
  observer::Example example = observer::pair();
  example.horizon = 3;
  const auto lane = observer::NetworkSimulation::intermediate(example.network, observer::printed_gains());
  observer::run_lane(lane, example, [&](double t, int i, const observer::Snapshot& s) {
    const auto k = static_cast<std::int64_t>(std::lround(t / example.dt));
    const std::string node = std::to_string(i + 1), own = "lane.intermediate_printed." + node;
    for (int c = 0; c < s.x.size(); ++c) {
      const std::string name = "x" + node + "_" + std::to_string(c + 1);
      ASSERT_NEAR(told.at(k, "truth." + name), s.x[c], 1e-9) << name << " at " << k;
      ASSERT_NEAR(told.at(k, own + ".estimate." + name), s.xhat[c], 1e-6) << name << " at " << k;
    }
    for (int c = 0; c < s.y.size(); ++c)
      ASSERT_NEAR(told.at(k, "sensor." + node + ".y" + std::to_string(c + 1)), s.y[c], 1e-9) << k;
    ASSERT_NEAR(told.at(k, own + ".attack.w1"), s.what[0], 1e-6) << k;
    ASSERT_NEAR(told.at(k, own + ".fault.f1"), s.fhat[0], 1e-6) << k;
    ASSERT_NEAR(told.at(k, own + ".innovation"), s.innovation.norm(), 1e-6) << k;
    ASSERT_EQ(told.at(k, "actuator." + node + ".w1.injected"), s.w[0]) << k;
    ASSERT_EQ(told.at(k, "fault." + node + ".f1"), s.f[0]) << k;
    ASSERT_EQ(told.at(k, "disturbance." + node + ".d1"), s.d[0]) << k;
  });
}

TEST(ObserverRun, OnATraceItHearsReadingsInBetween) {
  const Scenario scenario = printed(steps(2000));
  const Told told(scenario, options(scenario));
  RunOptions traced = options(scenario);
  traced.trace =
      std::make_shared<const Trace>(Trace::from_csv(test::csv_of(told.run.catalogue(), told.capture.frames)));
  const Told again(scenario, traced);
  double worst = 0;
  for (std::int64_t k = 0; k <= 2000; k += 10) {
    for (const std::string what : {".1.attack.w1", ".2.attack.w1", ".1.estimate.x1_1", ".2.fault.f1"}) {
      const std::string name = "lane.intermediate_printed" + what;
      worst = std::max(worst, std::abs(told.at(k, name) - again.at(k, name)));
    }
  }
  // The specification, section 8.1: linear interpolation of 1 ms samples differs by up to 2e-4 at the start.
  EXPECT_LT(worst, 2e-4);
  EXPECT_GT(worst, 0) << "the trace was not read";
}

TEST(ObserverRun, ALaneThatIsSparedHasAPlantThatNoAttackReaches) {
  const Scenario scenario =
      printed({{"time", {{"steps", 3000}}},
               {"lanes",
                {{"spared",
                  {{"method", "intermediate_observer"}, {"adversary", false}, {"params", {{"gains", "printed"}}}}}}}});
  const Told told(scenario, options(scenario));
  const Scenario quiet = printed({{"time", {{"steps", 3000}}}, {"adversary", {{"w1", nullptr}, {"w2", nullptr}}}});
  const Told calm(quiet, options(quiet));
  double apart = 0;
  for (std::int64_t k = 0; k <= 3000; k += 100) {
    for (const std::string what : {"1.estimate.x1_1", "2.attack.w1"}) {
      ASSERT_NEAR(told.at(k, "lane.spared." + what), calm.at(k, "lane.intermediate_printed." + what), 1e-12) << k;
      apart = std::max(apart,
                       std::abs(told.at(k, "lane.spared." + what) - told.at(k, "lane.intermediate_printed." + what)));
    }
  }
  EXPECT_GT(apart, 0.01) << "the attack made no difference";
}

TEST(ObserverRun, ForksAndRepeatsBitForBit) {
  const Scenario scenario = printed(steps(400));
  vigil::Run run(scenario, options(scenario));
  test::Capture whole, first;
  for (int k = 0; k <= 150; ++k) run.step(first);
  vigil::Run fork(run);
  test::run_to_end(run, first);
  const Told again(scenario, options(scenario));
  test::expect_same(run, first, again.run, again.capture, "");
  test::run_to_end(fork, whole);
  ASSERT_EQ(whole.frames.size(), 250U);
  for (std::size_t k = 0; k < whole.frames.size(); ++k) {
    for (std::size_t s = 0; s < whole.frames[k].values.size(); ++s)
      ASSERT_TRUE(test::same_bits(whole.frames[k].values[s], first.frames[k + 151].values[s])) << k << " " << s;
  }
}

TEST(ObserverRun, AttacksByHandReachActuatorsAndSensors) {
  const Scenario scenario = printed(steps(300));
  vigil::Run run(scenario, options(scenario));
  test::Capture capture;
  for (int k = 0; k <= 100; ++k) run.step(capture);
  const Json push = {{"attack", {{"type", "bias"}, {"on", {"actuator:2"}}, {"params", {{"vector", {0.5}}}}}}};
  run.apply(run.prepare(push));
  const Json tamper = {{"attack", {{"type", "bias"}, {"on", {"sensor:1.y2"}}, {"params", {{"vector", {0.1}}}}}}};
  run.apply(run.prepare(tamper));
  test::run_to_end(run, capture);
  const auto at = [&](int k, const char* name) {
    return capture.frames[static_cast<std::size_t>(k)].values[static_cast<std::size_t>(run.catalogue().find(name))];
  };
  EXPECT_EQ(at(100, "actuator.2.w1.injected"), 0);
  EXPECT_EQ(at(101, "actuator.2.w1.injected"), 0.5);
  EXPECT_EQ(at(101, "sensor.1.y2.injected"), 0.1);
  EXPECT_NEAR(at(101, "sensor.1.y2") - at(101, "sensor.1.y2.sent"), 0.1, 1e-12);
  const Told untouched(scenario, options(scenario));
  EXPECT_GT(std::abs(at(300, "lane.intermediate_printed.1.estimate.x1_2") -
                     untouched.at(300, "lane.intermediate_printed.1.estimate.x1_2")),
            1e-3);
  EXPECT_THROW(run.prepare({{"attack", {{"type", "dos"}, {"on", {"actuator:1"}}}}}), InputError);
}

TEST(ObserverRun, ALaneWhoseStateGrowsWithoutBoundStopsAndSaysWhy) {
  Eigen::MatrixXd unstable = Eigen::MatrixXd::Zero(11, 6);
  unstable.block(0, 0, 6, 3).setConstant(-1e6);
  Json rows = Json::array();
  for (const auto& row : unstable.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  const Scenario scenario =
      printed({{"time", {{"steps", 200}}},
               {"lanes", {{"intermediate_printed", {{"params", {{"gains", "given"}, {"L", rows}}}}}}}});
  const Told told(scenario, options(scenario));
  ASSERT_EQ(told.run.faults().size(), 1U);
  EXPECT_EQ(told.run.faults()[0].code, "diverged");
  EXPECT_TRUE(told.run.faults()[0].stopped);
  EXPECT_NE(told.run.faults()[0].detail.find("time.dt"), std::string::npos);
  const std::int64_t last = told.run.tick();
  EXPECT_LT(last, 200) << "no lane was left";
  EXPECT_TRUE(std::isfinite(told.at(last, "truth.x1_1"))) << "the plant is none the worse";
  EXPECT_TRUE(std::isnan(told.at(last, "lane.intermediate_printed.1.attack.w1")));
}

TEST(ObserverRun, IsRefusedWithoutGainsOrWithThoseOfAnotherProblem) {
  const Scenario scenario = printed();
  EXPECT_EQ(test::refusal(scenario).problems()[0].pointer, "/lanes/intermediate_printed/params");
  RunOptions wrong;
  wrong.designs["intermediate_printed"] = {{"key", "0123456789abcdef"}};
  const InputError other = test::refusal(scenario, wrong);
  EXPECT_NE(other.problems()[0].detail.find("another problem"), std::string::npos);
  const Scenario designed = Scenario::preset("observer-single");
  RunOptions refused;
  for (const DesignTask& task : design_tasks(designed))
    refused.designs[task.lane] = {{"key", task.key}, {"holds", false}, {"reason", "no gains were found"}};
  EXPECT_NE(test::refusal(designed, refused).problems()[0].detail.find("no gains were found"), std::string::npos);
}

struct Refused {
  const char* name;
  Json patch;
  const char* pointer;
  const char* word;
};
void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.name; }

class ObserverRefuses : public testing::TestWithParam<Refused> {};

TEST_P(ObserverRefuses, WithTheFieldAndTheReason) {
  try {
    const Scenario scenario = printed(GetParam().patch);
    const vigil::Run run(scenario, options(scenario));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems()[0].pointer, GetParam().pointer) << error.problems()[0].detail;
    EXPECT_NE(error.problems()[0].detail.find(GetParam().word), std::string::npos) << error.problems()[0].detail;
  }
}

Json own(const Json& subsystems, const Json& couplings = Json::object()) {
  const Json params = {{"subsystems", subsystems}, {"couplings", couplings}, {"phi", nullptr}};
  return {{"plant", {{"type", "interconnected"}, {"params", params}}}};
}
const Json kScalar = {{"A", Json::array({Json::array({-1})})}, {"C", Json::array({Json::array({1})})}};

const Json kSingle = {{"plant", {{"type", "single"}}},
                      {"nodes", {{"2", nullptr}}},
                      {"initial", {{"truth", nullptr}}},
                      {"adversary", {{"w2", nullptr}}}};

INSTANTIATE_TEST_SUITE_P(
    BadInput, ObserverRefuses,
    testing::Values(
        Refused{"undetectable",
                own({{"1",
                      {{"A", {{-1, 1}, {0, -2}}},
                       {"C", Json::array({Json::array({0, 1})})},
                       {"D", Json::array({Json::array({1}), Json::array({0})})}}},
                     {"2", kScalar}}),
                "/plant/params/subsystems/1/D", "not observable"},
        Refused{"shape",
                own({{"1", {{"A", {{-1, 1}, {0, -2}}}, {"C", Json::array({Json::array({1})})}}}, {"2", kScalar}}),
                "/plant/params/subsystems/1/C", "C is 1 x 1"},
        Refused{"no_matrix", own({{"1", {{"A", "many"}, {"C", Json::array({Json::array({1})})}}}, {"2", kScalar}}),
                "/plant/params/subsystems/1/A", "matrix"},
        Refused{"missing", own({{"1", {{"A", Json::array({Json::array({1})})}}}, {"2", kScalar}}),
                "/plant/params/subsystems/1/C", "missing"},
        Refused{"coupling", own({{"1", kScalar}, {"2", kScalar}}, {{"1-3", Json::array({Json::array({1})})}}),
                "/plant/params/couplings/1-3", "no coupling"},
        Refused{"size_of_h", own({{"1", kScalar}, {"2", kScalar}}, {{"1-2", Json::array({Json::array({1, 2})})}}),
                "/plant/params/couplings/1-2", "1 x 2"},
        Refused{
            "signal",
            {{"nodes",
              {{"1",
                {{"signals", {{"f7", {{"type", "waveform"}, {"params", {{"pieces", {{1, 0, 0, 0, 0, 0, 0}}}}}}}}}}}}}},
            "/nodes/1/signals/f7",
            "no signal"},
        Refused{
            "pieces",
            {{"nodes",
              {{"1", {{"signals", {{"f1", {{"type", "waveform"}, {"params", {{"pieces", {{1, 0}, {2, 0}}}}}}}}}}}}}},
            "/nodes/1/signals/f1/params/pieces",
            "7 numbers"},
        Refused{"actuator", {{"adversary", {{"w1", {{"on", {"actuator:1.w2"}}}}}}}, "/adversary/w1/on/0", "no channel"},
        Refused{"controller", {{"controller", {{"type", "lqg"}}}}, "/controller/type", "continuous"},
        Refused{"printed", kSingle, "/lanes/intermediate_printed/params/gains", "example 3.1"}),
    [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace vigil::observer_run_test
