// `vigil check`: as text, as JSON, refusals.
#include <fstream>

#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::check_test {
namespace {

const Json kOwn{{"vigil", 1},
                {"id", "mine"},
                {"time", {{"dt", 0.1}, {"steps", 20}}},
                {"plant", {{"type", "linear"}, {"params", {{"A", {{1.1, 0}, {0, 0.5}}}, {"B", {{1}, {0}}}}}}},
                {"nodes",
                 {{"1", {{"sensor", {{"type", "linear"}, {"params", {{"C", {{1, 0}}}}}}}}},
                  {"2", {{"sensor", {{"type", "linear"}, {"params", {{"C", {{0, 1}}}}}}}}}}},
                {"network", {{"graph", "path"}}},
                {"lanes", {{"all", {{"method", "centralized_ekf"}}}}}};

std::string file_of(const TemporaryFolder& folder, const Json& document) {
  const std::string file = folder.file("mine.json");
  std::ofstream(file) << document;
  return file;
}

TEST(CheckCommand, PrintsWhatAPersonReads) {
  const TemporaryFolder folder;
  const Outcome outcome = vigil_command({"check", file_of(folder, kOwn)});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(outcome.error, "");
  for (const char* words :
       {"mine: plant linear, discrete, 2 states, 1 input, a tick of 0.1 s", "node      rank  observable  detectable",
        "node 2 does not see the mode 1.1 (which grows): its own readings alone cannot follow the plant",
        "good: all nodes together see every mode of the plant", "methods that fit\n  centralized_ekf\n",
        "  mixed_filter: this method watches one sensor; the scenario has 2 nodes"})
    EXPECT_NE(outcome.output.find(words), std::string::npos) << words << "\n" << outcome.output;
}

TEST(CheckCommand, WritesJson) {
  const TemporaryFolder folder;
  const std::string scenario = file_of(folder, kOwn), report = folder.file("report.json");
  const Outcome printed = vigil_command({"check", scenario, "--json", "-"});
  ASSERT_EQ(printed.code, 0) << printed.error;
  const Json told = Json::parse(printed.output);
  EXPECT_EQ(told.at("scenario"), "mine");
  EXPECT_EQ(told.at("nodes").at(1).at("detectable"), false);
  const Outcome written = vigil_command({"check", scenario, "--json", report, "--set", "time.dt=0.2"});
  ASSERT_EQ(written.code, 0) << written.error;
  EXPECT_NE(written.output.find("a tick of 0.2 s"), std::string::npos) << "the text all the same";
  std::ifstream file(report);
  EXPECT_EQ(Json::parse(file).at("plant").at("dt"), 0.2);
}

TEST(CheckCommand, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  Json document = kOwn;
  document["nodes"]["2"]["sensor"]["params"]["C"] = {{1, 2, 3}};
  const Outcome sizes = vigil_command({"check", file_of(folder, document)});
  EXPECT_EQ(sizes.code, 2);
  EXPECT_NE(sizes.error.find("C has 3 columns; the plant has 2 states"), std::string::npos) << sizes.error;
  EXPECT_NE(vigil_command({"check", "nothing"}).error.find("expected a preset"), std::string::npos);
  const Outcome trace = vigil_command({"check", "mrclam"});
  EXPECT_EQ(trace.code, 2);
  EXPECT_NE(trace.error.find("trace"), std::string::npos) << trace.error;
}

}  // namespace
}  // namespace vigil::api_test::check_test
