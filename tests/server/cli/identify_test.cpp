// `vigil identify` and `vigil trace table`: from a file to a scored run.
#include <fstream>
#include <random>
#include <sstream>

#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::identify_test {
namespace {

/// A tank under a pump, on hours 300 to 319 its reading 3 too high where `attacked`.
std::string recording(int rows, bool attacked) {
  std::mt19937 engine(5);
  std::normal_distribution<double> noise(0, 0.1);
  std::ostringstream text;
  text << "DATE, LEVEL, PUMP, FLAG\n";
  double level = 2;
  for (int k = 0; k < rows; ++k) {
    const int pump = (k / 7) % 3 == 0 ? 1 : 0;
    const bool now = attacked && k >= 300 && k < 320;
    text << "day " << k << "," << level + (now ? 3 : 0) << "," << pump << "," << (now ? 1 : -999) << "\n";
    level = 0.9 * level + 0.5 * pump + noise(engine);
  }
  return text.str();
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void expect_bad(const std::vector<std::string>& arguments, const std::string& words) {
  const Outcome outcome = vigil_command(arguments);
  EXPECT_EQ(outcome.code, 2) << outcome.error;
  EXPECT_NE(outcome.error.find(words), std::string::npos) << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
}

double metric(const Json& result, const std::string& lane, const std::string& name) {
  for (const Json& each : result.at("metrics")) {
    if (each.at("lane") == lane && each.at("name") == name && each.at("node").is_null()) return each.at("value");
  }
  ADD_FAILURE() << lane << " has no " << name;
  return -1;
}

TEST(IdentifyCommand, LeadsFromAFileToAScoredRun) {
  const TemporaryFolder folder;
  const std::string clean = folder.file("clean.csv"), later = folder.file("later.csv");
  const std::string scenario = folder.file("My Tank.json"), trace = folder.file("trace.csv");
  std::ofstream(clean) << recording(1200, false);
  std::ofstream(later) << recording(500, true);
  const Outcome made =
      vigil_command({"identify", clean, "--outputs", "LEVEL", "--inputs", "PUMP", "--label", "FLAG", "--dt", "3600",
                     "--out", scenario, "--trace-out", folder.file("clean-trace.csv")});
  ASSERT_EQ(made.code, 0) << made.error;
  for (const char* word : {"order", "Spectral radius 0.", "Ljung-Box", "R2", "LEVEL"})
    EXPECT_NE(made.output.find(word), std::string::npos) << word << "\n" << made.output;
  EXPECT_EQ(Json::parse(text_of(scenario)).at("id"), "my-tank");
  ASSERT_EQ(vigil_command({"trace", "table", later, "--scenario", scenario, "--out", trace}).code, 0);
  const Outcome run = vigil_command({"run", scenario, "--trace", trace, "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.error;
  const Json result = Json::parse(run.output);
  // A step of 3 is 30 standard deviations of the noise: seen in the hour it begins, by all that look at single ticks.
  EXPECT_EQ(metric(result, "all_chi_square", "delay"), 0);
  EXPECT_EQ(metric(result, "all_cusum", "delay"), 0);
  EXPECT_GE(metric(result, "all_chi_square", "tpr"), 1.0 / 20);
  EXPECT_LE(metric(result, "all_chi_square", "fpr"), 0.05);
}

TEST(IdentifyCommand, TakesColumnsFromAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("clean.csv")) << recording(600, false);
  std::ofstream(folder.file("map.json")) << R"({"outputs":["LEVEL"],"inputs":["PUMP"],"label":"FLAG","dt":60})";
  const std::string scenario = folder.file("tank.json");
  const Outcome made =
      vigil_command({"identify", folder.file("clean.csv"), "--map", folder.file("map.json"), "--out", scenario});
  ASSERT_EQ(made.code, 0) << made.error;
  const Json document = Json::parse(text_of(scenario));
  EXPECT_EQ(document.at("time").at("dt"), 60);
  std::ofstream(folder.file("mapping.json")) << document.at("view").at("mapping").dump();
  const auto trace = [&](const char* option, const std::string& file) {
    return vigil_command({"trace", "table", folder.file("clean.csv"), option, file, "--out", "-"}).output;
  };
  EXPECT_EQ(trace("--map", folder.file("mapping.json")), trace("--scenario", scenario));
}

TEST(IdentifyCommand, BadInputIsOneSentenceAndCodeTwo) {
  const TemporaryFolder folder;
  const std::string out = folder.file("x.json"), clean = folder.file("clean.csv");
  std::ofstream(clean) << recording(600, false);
  std::ofstream(folder.file("broken.csv")) << "LEVEL,PUMP\n1,0\n2,high\n";
  std::ofstream(folder.file("short.csv")) << "LEVEL,PUMP\n1,0\n2,1\n";
  std::ofstream(folder.file("map.json")) << R"({"output":["LEVEL"]})";
  std::ofstream(folder.file("none.json")) << "{}";
  expect_bad({"identify", folder.file("absent.csv"), "--outputs", "LEVEL", "--out", out}, "absent.csv");
  expect_bad({"identify", clean, "--out", out}, "--outputs");
  expect_bad({"identify", clean, "--outputs", "LEVL", "--out", out}, "the nearest is \"LEVEL\"");
  expect_bad({"identify", clean, "--outputs", "LEVEL", "--map", folder.file("map.json"), "--out", out}, "\"output\"");
  expect_bad({"identify", clean, "--outputs", "LEVEL", "--holdout", "2", "--out", out}, "--holdout");
  expect_bad({"identify", folder.file("broken.csv"), "--outputs", "LEVEL", "--inputs", "PUMP", "--out", out},
             "line 3: column 2 (PUMP) is \"high\"");
  expect_bad({"identify", folder.file("short.csv"), "--outputs", "LEVEL", "--out", out}, "rows");
  expect_bad({"trace", "table", clean, "--out", "-"}, "no mapping");
  expect_bad({"trace", "table", clean, "--scenario", folder.file("none.json"), "--out", "-"}, "view.mapping");
  expect_bad({"trace", "table", clean, "--map", folder.file("none.json"), "--out", "-"}, "columns");
}

}  // namespace
}  // namespace vigil::api_test::identify_test
