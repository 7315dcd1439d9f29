#include <fstream>

#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::compare_test {
namespace {

Json json_of(const Outcome& outcome) {
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  return Json::parse(outcome.output, nullptr, false);
}

void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) {
  const Outcome outcome = vigil_command(arguments);
  EXPECT_EQ(outcome.code, 2) << outcome.error;
  EXPECT_NE(outcome.error.find(words), std::string::npos) << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
}

TEST(CompareCommand, ALogAndFrameFilesGiveTheSameVerdicts) {
  const TemporaryFolder folder;
  const std::string db = folder.file("log.db"), one = folder.file("one.csv"), two = folder.file("two.csv");
  ASSERT_EQ(vigil_command({"run", "consensus", "--seed", "1", "--db", db, "--frames", one}).code, 0);
  ASSERT_EQ(vigil_command({"run", "consensus", "--seed", "2", "--db", db, "--frames", two}).code, 0);
  const std::vector<std::string> asked{
      "--signals", "lane.consensus.*,link.*.state", "--rel", "0.1", "--shift", "1", "--align", "attack", "--json", "-"};
  std::vector<std::string> logged{"compare", "1", "2", "--db", db}, framed{"compare", one, two};
  logged.insert(logged.end(), asked.begin(), asked.end());
  framed.insert(framed.end(), asked.begin(), asked.end());
  expect_refusal(logged, "at most 64");
  for (auto* arguments : {&logged, &framed}) *(arguments->end() - 9) = "lane.consensus.*.error,link.1-*.state";
  Json a = json_of(vigil_command(logged)), b = json_of(vigil_command(framed));
  ASSERT_FALSE(a.at("verdicts").empty());
  ASSERT_EQ(a.at("verdicts").size(), b.at("verdicts").size());
  for (std::size_t i = 0; i < a["verdicts"].size(); ++i) {
    for (const char* key : {"signal", "ticks", "inside", "first", "worst", "outside"})
      EXPECT_EQ(a["verdicts"][i].at(key), b["verdicts"][i].at(key)) << a["verdicts"][i];
  }
  EXPECT_EQ(a.at("paired")[0].at("mean"), b.at("paired")[0].at("mean"));
  EXPECT_FALSE(a.at("metrics").empty());
  EXPECT_TRUE(b.at("metrics").empty());
}

TEST(CompareCommand, PrintsTablesAndIsDoneWhateverTheVerdict) {
  const TemporaryFolder folder;
  const std::string db = folder.file("log.db");
  ASSERT_EQ(vigil_command({"run", "consensus", "--db", db}).code, 0);
  ASSERT_EQ(vigil_command({"run", "consensus", "--db", db}).code, 0);
  ASSERT_EQ(vigil_command({"run", "consensus", "--db", db, "--set", "lanes.consensus.params.tau=0.02"}).code, 0);
  const Outcome same = vigil_command({"compare", "1", "2", "--db", db});
  EXPECT_EQ(same.code, 0) << same.error;
  EXPECT_NE(same.output.find("within"), std::string::npos);
  EXPECT_EQ(same.output.find("  outside"), std::string::npos) << same.output;
  EXPECT_EQ(same.output.find("parameters that differ"), std::string::npos);
  const Outcome other = vigil_command(
      {"compare", "1", "3", "--db", db, "--signals", "lane.consensus.*.error", "--json", folder.file("c.json")});
  EXPECT_EQ(other.code, 0) << other.error;
  EXPECT_NE(other.output.find("lanes.consensus.params.tau"), std::string::npos) << other.output;
  EXPECT_NE(other.output.find("outside"), std::string::npos) << other.output;
  EXPECT_NE(other.output.find("rmse_position"), std::string::npos);
  EXPECT_TRUE(Json::parse(std::ifstream(folder.file("c.json"))).contains("verdicts"));
}

TEST(CompareCommand, RefusesWithOneSentence) {
  const TemporaryFolder folder;
  const std::string db = folder.file("log.db");
  ASSERT_EQ(vigil_command({"run", "consensus", "--steps", "3", "--db", db}).code, 0);
  std::ofstream(folder.file("bad.csv")) << "k,t,x\n0,0,hello\n";
  expect_refusal({"compare", "1", "--db", db}, "2 to 10");
  expect_refusal({"compare", "1", "77", "--db", db}, "no such run");
  expect_refusal({"compare", "1", "1", "--db", db}, "twice");
  expect_refusal({"compare", "1", folder.file("no.csv"), "--db", db}, "no.csv");
  expect_refusal({"compare", "1", folder.file("bad.csv"), "--db", db}, "neither an id nor a frame file");
  expect_refusal({"compare", "1", "2", "--db", folder.file("none.db")}, "none.db");
  expect_refusal({"compare", "1", "2", "--abs", "-1"}, "abs");
}

}  // namespace
}  // namespace vigil::api_test::compare_test
