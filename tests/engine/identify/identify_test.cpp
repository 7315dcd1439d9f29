// From a table to a scenario and a trace that run together.
#include "engine/identify/identify.hpp"

#include <fmt/format.h>

#include "engine/identify/calibrate.hpp"
#include "tests/engine/identify/systems.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::identify::identify_test {
namespace {

using test::two_tanks;

/// Two tanks, two pumps, a column that never moves, and a label on the last fifth.
std::string recording(const Arx& truth, Eigen::Index rows) {
  const Records records = test::recorded(truth, rows, 0.05, 11);
  std::string text = "time, level 1,level 2,pump1,pump2,spare,flag\n";
  for (Eigen::Index k = 0; k < rows; ++k)
    text += fmt::format("hour {},{},{},{},{},3,{}\n", k, records.outputs(k, 0), records.outputs(k, 1),
                        records.inputs(k, 0), records.inputs(k, 1), k >= rows * 4 / 5 ? "1" : "-999");
  return text;
}

Task both_tanks() {
  Task task;
  task.outputs = {"level*"};
  task.inputs = {"pump*", "spare"};
  task.label = "flag";
  task.dt = 60;
  return task;
}

TEST(Identify, WritesAScenarioThatRunsOnItsTrace) {
  const std::string text = recording(two_tanks(1), 2000);
  const Identified found = identify(text, both_tanks());
  EXPECT_EQ(found.flat, std::vector<std::string>{"spare"});
  EXPECT_EQ(found.nodes, (std::vector<std::string>{"level_1", "level_2"}));
  EXPECT_EQ(found.mapping.input_lag, 1);
  const Scenario scenario = Scenario::from_json(scenario_of(found, both_tanks()));
  const auto trace = std::make_shared<Trace>(Trace::from_csv(table_to_trace(text, found.mapping)));
  EXPECT_EQ(trace->dt(), 60);
  EXPECT_EQ(trace->at(7, trace->find("input.u3")), 1) << "the constant";
  EXPECT_EQ(trace->at(1599, trace->find("sensor.level_2.state")), 0);
  EXPECT_EQ(trace->at(1600, trace->find("sensor.level_2.state")), 2);
  vigil::Run run(scenario, {1, trace, {}});
  test::Capture capture;
  test::run_to_end(run, capture);
  // Innovations as large as the model says: mean of 2 x 2000 squares with unit mean and variance 2, five errors.
  EXPECT_NEAR(test::metric(run.metrics(), "all_chi_square", "nis_mean"), 2, 5 * 2 / std::sqrt(2000.0));
  EXPECT_NEAR(test::metric(run.metrics(), "all_chi_square", "fpr"), 0.01, 5 * std::sqrt(0.01 * 0.99 / 1550));
  EXPECT_NEAR(test::metric(run.metrics(), "all_chi_square", "tpr"), 0.01, 5 * std::sqrt(0.01 * 0.99 / 400))
      << "the label is there, an attack is not";
  EXPECT_TRUE(run.faults().empty());
}

TEST(Identify, LearnsThresholdsFromCleanRows) {
  const std::string text = recording(two_tanks(), 2000);
  const Identified found = identify(text, both_tanks());
  const auto trace = std::make_shared<Trace>(Trace::from_csv(table_to_trace(text, found.mapping)));
  const Scenario learned = calibrated(Scenario::from_json(scenario_of(found, both_tanks())), trace, 0.05);
  vigil::Run run(learned, {1, trace, {}});
  test::Capture capture;
  test::run_to_end(run, capture);
  EXPECT_NEAR(test::metric(run.metrics(), "all_fixed", "fpr"), 0.05, 2.0 / 1550) << "the quantile of the same rows";
  EXPECT_LE(test::metric(run.metrics(), "all_cusum", "fpr"), 0.05) << "a sum that restarts is below one that does not";
  EXPECT_GT(test::metric(run.metrics(), "all_cusum", "fpr"), 0);
}

TEST(Identify, NodesHaveLegalIds) {
  std::string text = "fused,a very long name of a tank,a very long name of another\n";
  const Records records = test::recorded(two_tanks(), 300, 0.05, 1);
  for (Eigen::Index k = 0; k < 300; ++k)
    text += fmt::format("{},{},{}\n", records.outputs(k, 0), records.outputs(k, 1), records.inputs(k, 0));
  Task other;
  other.outputs = {"*"};
  const Identified found = identify(text, other);
  EXPECT_EQ(found.nodes, (std::vector<std::string>{"y1", "a_very_long_name", "y3"}));
  EXPECT_NO_THROW(Scenario::from_json(scenario_of(found, other)));
}

TEST(Identify, RefusesWhatCannotBeARun) {
  const std::string text = recording(two_tanks(), 300);
  const auto refused = [&](auto change) {
    Task other = both_tanks();
    change(other);
    EXPECT_THROW(identify(text, other), InputError);
  };
  refused([](Task& t) { t.outputs = {"nothing"}; });
  refused([](Task& t) { t.inputs = {"level 1"}; });
  refused([](Task& t) { t.label = "pump1"; });
  refused([](Task& t) { t.label = "flags"; });
  refused([](Task& t) { t.inputs = {"time"}; });
  try {
    Task other = both_tanks();
    other.outputs = {"spare"};
    other.inputs = {};
    identify(text, other);
    ADD_FAILURE() << "it never changes";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("output \"spare\" never changes"), std::string::npos) << error.what();
  }
  std::string wide = "y";
  for (int c = 1; c <= 12; ++c) wide += fmt::format(",u{}", c);
  for (int k = 0; k < 200; ++k) {
    wide += fmt::format("\n{}", k % 7);
    for (int c = 1; c <= 12; ++c) wide += fmt::format(",{}", (k * c) % 13);
  }
  Task many;
  many.outputs = {"y"};
  many.inputs = {"u*"};
  EXPECT_THROW(identify(wide, many), InputError);
}

TEST(Mapping, ReadsWhatItWrites) {
  const Json written = Json::parse(R"({"dt":60.0,"columns":{"sensor.1.y1":"level","input.u1":"pump"},
      "constants":{"input.u2":1.0},"input_lag":1,"label":{"column":"flag","nodes":["1"]}})");
  const Mapping mapping = read_mapping(written, "");
  EXPECT_EQ(to_json(mapping), written);
  EXPECT_EQ(table_to_trace("level,pump,flag\n5,1,0\n,0,1\n7,0,\n", mapping),
            "k,t,sensor.1.y1,input.u1,input.u2,sensor.1.state\n0,0,5,,1,0\n1,60,,1,1,2\n2,120,7,0,1,0\n");
}

TEST(Mapping, RefusesByName) {
  const auto refused = [](const char* text, const char* pointer) {
    try {
      read_mapping(Json::parse(text), "/view/mapping");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, std::string("/view/mapping") + pointer) << error.what();
    }
  };
  refused("[]", "");
  refused(R"({"columns":{}})", "/columns");
  refused(R"({"columns":{"input.u1":4}})", "/columns/input.u1");
  refused(R"({"columns":{"a b":"x"}})", "/columns/a b");
  refused(R"({"columns":{"a":"x"},"dt":0})", "/dt");
  refused(R"({"columns":{"a":"x"},"input_lag":2})", "/input_lag");
  refused(R"({"columns":{"a":"x"},"constants":{"b":"x"}})", "/constants/b");
  refused(R"({"columns":{"a":"x"},"label":"flag"})", "/label");
  refused(R"({"columns":{"a":"x"},"lable":{}})", "/lable");
}

}  // namespace
}  // namespace vigil::identify::identify_test
