// A trace in place of the world: the law of the contract, lanes computed elsewhere, refusals.
#include "tests/engine/runs/capture.hpp"

namespace vigil::traces_test {
namespace {

using test::Capture;
using test::expect_same;
using test::metric;
using test::run_to_end;

Scenario consensus() { return Scenario::preset("consensus"); }

/// The law of the contract, section 3: run -> frames -> trace -> the same lanes, bit for bit.
void expect_trace_law(const Scenario& scenario, std::uint64_t seed, const std::vector<Command>& commands) {
  vigil::Run simulated(scenario, {seed, nullptr, commands});
  Capture first;
  run_to_end(simulated, first);
  auto trace = std::make_shared<Trace>(Trace::from_csv(test::csv_of(simulated.catalogue(), first.frames)));
  std::vector<Command> tuning;  // what the adversary did is in the trace; what lanes were told is not
  for (const Command& command : commands) {
    if (command.body.contains("params")) tuning.push_back(command);
  }
  vigil::Run replayed(scenario, {seed, trace, tuning});
  Capture second;
  run_to_end(replayed, second);
  expect_same(simulated, first, replayed, second, "lane.");
  EXPECT_EQ(metric(simulated.metrics(), "consensus", "rmse_position"),
            metric(replayed.metrics(), "consensus", "rmse_position"));
}

TEST(TraceLaw, HoldsForTheDefaultAndTheCompass) {
  expect_trace_law(Scenario::preset("consensus"), 11, {});
  expect_trace_law(Scenario::preset("consensus-compass"), 12, {});
}

TEST(TraceLaw, HoldsForAttacksOnSensorsAndByHand) {
  const Json sensors = {
      {"adversary",
       {{"glare",
         {{"type", "bias"}, {"on", {"sensor:4"}}, {"from", 3}, {"to", 9}, {"params", {{"vector", {30, 12}}}}}}}}};
  const std::vector<Command> commands = {{6,
                                          {{"attack",
                                            {{"id", "a1"},
                                             {"type", "bias"},
                                             {"on", {"link:*"}},
                                             {"params", {{"vector", {3, -2, 1}}, {"probability", 0.5}}}}}}},
                                         {8, {{"params", {{"lanes.consensus.params.tau", 0.02}}}}},
                                         {15, {{"end_attack", "a1"}}}};
  expect_trace_law(Scenario::preset("consensus").patched(sensors), 13, commands);
}

TEST(RecordedLane, IsScoredAmongOurs) {
  vigil::Run run(consensus(), {8, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  std::string csv = test::csv_of(run.catalogue(), capture.frames);
  for (std::size_t at = csv.find("lane.isolated."); at != std::string::npos; at = csv.find("lane.isolated.", at))
    csv.replace(at, 14, "lane.elsewhere.");
  vigil::Run scored(consensus(), {8, std::make_shared<Trace>(Trace::from_csv(csv)), {}});
  Capture again;
  run_to_end(scored, again);
  EXPECT_EQ(metric(scored.metrics(), "elsewhere", "rmse_position"), metric(run.metrics(), "isolated", "rmse_position"));
  EXPECT_EQ(metric(scored.metrics(), "elsewhere", "rmse_position", "5"),
            metric(run.metrics(), "isolated", "rmse_position", "5"));
}

TEST(TraceInput, IsRefusedWithAReason) {
  const auto refuse = [](const std::string& csv, const std::string& pointer, const char* preset) {
    try {
      const vigil::Run run(Scenario::preset(preset),
                           {1, csv.empty() ? nullptr : std::make_shared<Trace>(Trace::from_csv(csv)), {}});
      ADD_FAILURE() << csv;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, pointer) << error.what();
    }
  };
  refuse("", "/nodes/6/sensor/params/position", "mrclam");
  refuse("k,t,truth.x\n0,0,1\n1,1,2\n", "/input/trace", "consensus");
  refuse("k,t,sensor.1.p\n0,0,\n1,0.5,2\n", "/time/dt", "consensus");
  refuse("k,t,sensor.1.p\n3,3,\n4,4,2\n", "/input/trace", "consensus");
}

}  // namespace
}  // namespace vigil::traces_test
