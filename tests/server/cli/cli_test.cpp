#include <fstream>
#include <sstream>

#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::cli_test {
namespace {

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Exit code 2 and one sentence that holds the words.
void expect_bad(const std::vector<std::string>& arguments, const std::string& words) {
  const Outcome outcome = vigil_command(arguments);
  EXPECT_EQ(outcome.code, 2) << outcome.error;
  EXPECT_NE(outcome.error.find(words), std::string::npos) << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
}

TEST(CommandLine, RunPrintsATableAndJson) {
  const TemporaryFolder folder;
  const Outcome table =
      vigil_command({"run", "consensus", "--seed", "3", "--steps", "10", "--json", folder.file("run.json")});
  ASSERT_EQ(table.code, 0) << table.error;
  EXPECT_NE(table.output.find("rmse_position"), std::string::npos);
  EXPECT_NE(table.output.find("infeasible_28"), std::string::npos);
  const Json result = Json::parse(text_of(folder.file("run.json")));
  EXPECT_EQ(result.at("scenario"), "consensus");
  EXPECT_EQ(result.at("seed"), 3);
  EXPECT_EQ(result.at("steps"), 10);
  EXPECT_EQ(result.at("state"), "finished");
  EXPECT_FALSE(result.at("metrics").empty());
  EXPECT_TRUE(result.at("timing").at("run").contains("ticks_per_second"));
  Json bare = Json::parse(vigil_command({"run", "consensus", "--seed", "3", "--steps", "10", "--json", "-"}).output);
  bare.erase("timing");
  Json again = result;
  again.erase("timing");
  EXPECT_EQ(bare.dump(), again.dump());
}

TEST(CommandLine, SetsPatchesAndFilesAreApplied) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("patch.json")) << R"({"time":{"steps":6}})";
  const Outcome patched = vigil_command({"run", "consensus", "--patch", folder.file("patch.json"), "--set",
                                         "lanes.consensus.params.tau=0.02", "--set", "adversary.links.params.pdos=0.9",
                                         "--set", "adversary.links.params.pfdi=0.05", "--json", "-"});
  ASSERT_EQ(patched.code, 0) << patched.error;
  EXPECT_EQ(Json::parse(patched.output).at("steps"), 6);
  std::ofstream(folder.file("own.json")) << vigil_command({"scenarios", "consensus"}).output;
  EXPECT_EQ(vigil_command({"run", folder.file("own.json"), "--steps", "2"}).code, 0);
}

TEST(CommandLine, ARunIsLoggedAndItsFramesAreATrace) {
  const TemporaryFolder folder;
  const std::string db = folder.file("log.db"), frames = folder.file("frames.csv"), again = folder.file("again.csv");
  ASSERT_EQ(vigil_command({"run", "consensus", "--steps", "8", "--db", db, "--frames", frames}).code, 0);
  const Outcome check = vigil_command({"db", "check", "--db", db});
  EXPECT_EQ(check.code, 0) << check.error;
  const LogReader reader(db);
  const RunPage page = reader.list({}, "", 10, "");
  ASSERT_EQ(page.items.size(), 1u);
  EXPECT_EQ(page.items[0].state, "finished");
  EXPECT_EQ(page.items[0].k, 8);
  ASSERT_EQ(vigil_command({"run", "consensus", "--steps", "8", "--trace", frames, "--frames", again}).code, 0);
  EXPECT_EQ(text_of(again).substr(0, 4), "k,t,");
}

TEST(CommandLine, ListsAreComplete) {
  EXPECT_EQ(Json::parse(vigil_command({"scenarios", "--json"}).output).size(), Scenario::preset_ids().size());
  EXPECT_EQ(Json::parse(vigil_command({"scenarios", "mrclam"}).output).at("id"), "mrclam");
  EXPECT_NE(vigil_command({"scenarios"}).output.find("consensus-compass"), std::string::npos);
  EXPECT_TRUE(Json::parse(vigil_command({"methods", "--json"}).output).contains("methods"));
  EXPECT_NE(vigil_command({"methods"}).output.find("consensus_ekf"), std::string::npos);
  EXPECT_EQ(vigil_command({"--version"}).code, 0);
  EXPECT_EQ(vigil_command({"run", "--help"}).code, 0);
}

TEST(CommandLine, BadInputIsOneSentenceAndCodeTwo) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("broken.json")) << "{";
  std::ofstream(folder.file("infinite.json")) << R"({"vigil":1e999})";
  std::ofstream(folder.file("other.db"))
      << "this is no database, but it is long enough to be looked at as one by a careless reader";
  expect_bad({}, "subcommand");
  expect_bad({"nosuch", "consensus"}, "no command");
  expect_bad({"run"}, "SCENARIO");
  expect_bad({"run", "nosuch"}, "nosuch");
  expect_bad({"run", folder.file("broken.json")}, "not JSON");
  expect_bad({"run", folder.file("infinite.json")}, "not finite");
  expect_bad({"run", "consensus", "--seed", "-1"}, "--seed");
  expect_bad({"run", "consensus", "--seed", "x"}, "--seed");
  expect_bad({"run", "consensus", "--steps", "0"}, "--steps");
  expect_bad({"run", "consensus", "--set", "lanes.consensus.params.tau"}, "PATH=JSON");
  expect_bad({"run", "consensus", "--set", "lanes.consensus.params.tau=1e999"}, "JSON");
  expect_bad({"run", "consensus", "--set", "lanes.consensus.params.tau=-1"}, "/lanes/consensus/params/tau");
  expect_bad({"run", "consensus", "--set", "lanes.nosuch.params.tau=1"}, "nosuch");
  expect_bad({"run", "consensus", "--set", "time.steps=null"}, "--steps");
  expect_bad({"run", "consensus", "--patch", folder.file("missing.json")}, "cannot be read");
  expect_bad({"run", "consensus", "--trace", folder.file("broken.json")}, "");
  expect_bad({"run", "consensus", "--frames", "/nosuch/folder/x.csv"}, "cannot be written");
  expect_bad({"run", "consensus", "--db", folder.file("other.db")}, "other.db");
  expect_bad({"run", "consensus", "--mqtt", "x"}, "--mqtt");
  expect_bad({"run", "mrclam"}, "trace");
  expect_bad({"campaign", "consensus"}, "--runs");
  expect_bad({"campaign", "consensus", "--runs", "0"}, "--runs");
  expect_bad({"campaign", "consensus", "--runs", "1", "--sweep", "nosuch=1,2"}, "nosuch");
  expect_bad({"scenarios", "nosuch"}, "nosuch");
  expect_bad({"db", "check", "--db", folder.file("missing.db")}, "missing.db");
  expect_bad({"db", "check", "--db", folder.file("other.db")}, "other.db");
  expect_bad({"trace", "mrclam", "/nosuch", "--robot", "3", "--dt", "0.1", "--out", "-"}, "/nosuch");
  expect_bad({"serve", "--port", "70000"}, "--port");
  expect_bad({"serve", "--host", "0.0.0.0", "--db", folder.file("x.db")}, "--token-file");
  expect_bad({"serve", "--keep-days", "nan", "--db", folder.file("x.db")}, "--keep-days");
  expect_bad({"serve", "--db", folder.file("other.db"), "--port", "0"}, "other.db");
  expect_bad({"serve", "--web", folder.file("nosuch"), "--port", "0"}, "--web");
}

TEST(CommandLine, ACampaignDoesNotDependOnItsThreads) {
  const auto campaign = [](const char* threads) {
    const Outcome outcome =
        vigil_command({"campaign", "consensus", "--runs", "7", "--threads", threads, "--set", "time.steps=10",
                       "--sweep", "lanes.consensus.params.tau=0.01,0.02", "--json", "-"});
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    Json result = Json::parse(outcome.output);
    result.erase("timing");
    return result;
  };
  const Json one = campaign("1"), two = campaign("2"), many = campaign("5");
  EXPECT_EQ(one.dump(), two.dump());
  EXPECT_EQ(one.dump(), many.dump());
  EXPECT_EQ(one.at("runs"), 7);
  std::set<std::string> sweeps;
  for (const Json& metric : one.at("metrics")) {
    sweeps.insert(metric.at("sweep").dump());
    EXPECT_TRUE(metric.contains("se"));
  }
  EXPECT_EQ(sweeps.size(), 2u);
}

TEST(CommandLine, ACampaignIsLogged) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      vigil_command({"campaign", "consensus", "--runs", "3", "--set", "time.steps=4", "--db", folder.file("log.db")})
          .code,
      0);
  const LogReader reader(folder.file("log.db"));
  const auto campaigns = reader.campaigns();
  ASSERT_EQ(campaigns.size(), 1u);
  EXPECT_EQ(campaigns[0].state, "finished");
  EXPECT_EQ(campaigns[0].done, 3);
}

TEST(CommandLine, TheLogIsBackedUpPrunedAndShrunk) {
  const TemporaryFolder folder;
  const std::string db = folder.file("log.db"), copy = folder.file("copy.db");
  ASSERT_EQ(vigil_command({"run", "consensus", "--steps", "3", "--db", db}).code, 0);
  EXPECT_EQ(vigil_command({"db", "backup", copy, "--db", db}).code, 0);
  EXPECT_EQ(vigil_command({"db", "check", "--db", copy}).code, 0);
  expect_bad({"db", "backup", copy, "--db", db}, "copy.db");
  EXPECT_EQ(vigil_command({"db", "prune", "--older-than", "0", "--db", copy}).code, 0);
  EXPECT_EQ(vigil_command({"db", "vacuum", "--db", copy}).code, 0);
  EXPECT_EQ(LogReader(copy).count({}), 0);
  EXPECT_EQ(LogReader(db).count({}), 1);
}

}  // namespace
}  // namespace vigil::api_test::cli_test
