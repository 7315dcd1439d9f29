/// A campaign that is killed and goes on is the campaign that was never killed.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "db/maintenance.hpp"
#include "db/reader.hpp"
#include "engine/scenario/scenario.hpp"
#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::campaign_test {
namespace {

Json without_timing(const std::string& text) {
  Json json = Json::parse(text);
  json.erase("timing");
  return json;
}

/// Starts the command, kills it once `enough` trials more are committed; false where it was done before.
bool kill_in_the_middle(std::vector<std::string> words, const std::string& db, std::int64_t enough) {
  words.insert(words.begin(), VIGIL_EXECUTABLE);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(126);
  }
  bool over = false;
  const auto enough_there = [&] {
    over = waitpid(child, nullptr, WNOHANG) != 0;
    if (over) return true;
    try {
      const auto rows = LogReader(db).campaigns();
      return !rows.empty() && rows.front().done >= enough;
    } catch (const LogError&) {
      return false;  // not made yet
    }
  };
  for (int patience = 0; patience < 20 && !eventually(enough_there); ++patience) {
  }
  if (over) return false;
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status);
}

void survives(std::int64_t runs, const char* sweep) {
  const TemporaryFolder folder;
  std::vector<std::string> words{"campaign", "consensus", "--runs", std::to_string(runs), "--json", "-"};
  if (sweep != nullptr) words.insert(words.end(), {"--sweep", sweep});
  const auto with = [&words](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const std::string db = folder.file("a.db");
  const std::int64_t all = sweep != nullptr ? 2 * runs : runs;
  for (int round = 1; round <= 3; ++round)
    ASSERT_TRUE(kill_in_the_middle(with({"--db", db, "--threads", "2"}), db, round * all / 5)) << round;
  EXPECT_TRUE(check_log(db).ok);
  std::int64_t there = 0;
  {
    const LogReader reader(db);
    ASSERT_EQ(reader.campaigns().size(), 1u) << "each went on with the first";
    const auto trials = reader.trials(1);
    there = static_cast<std::int64_t>(trials.size());
    for (std::int64_t i = 0; i < there; ++i) ASSERT_EQ(trials[static_cast<std::size_t>(i)].index, i);
  }
  EXPECT_GE(there, 3 * all / 5);
  EXPECT_LT(there, all);
  const Outcome last = vigil_command(with({"--db", db, "--threads", "2"}));
  ASSERT_EQ(last.code, 0) << last.error;
  EXPECT_NE(last.error.find("campaign 1 goes on, " + std::to_string(there) + " of "), std::string::npos) << last.error;
  const Outcome one = vigil_command(with({"--threads", "1"}));
  ASSERT_EQ(one.code, 0) << one.error;
  EXPECT_EQ(without_timing(last.output).dump(), without_timing(one.output).dump());
  EXPECT_EQ(LogReader(db).campaign(1)->state, "finished");
}

TEST(CampaignCommand, SurvivesThreeKillsWithTheSameBytes) { survives(150, "adversary.links.params.pdos=0.1,0.4"); }

TEST(CampaignCommand, TenThousandTrialsSurviveThreeKills) {
  if (std::getenv("VIGIL_FULL") == nullptr) GTEST_SKIP() << "the long one: set VIGIL_FULL";
  survives(10'000, nullptr);
}

/// Every trial is one run, whole, tagged with the campaign; nothing else is in the log.
void expect_a_run_each(const LogReader& reader, std::int64_t trials) {
  EXPECT_EQ(reader.count(Query::parse("", 0)), trials);
  const auto rows = reader.trials(1);
  ASSERT_EQ(static_cast<std::int64_t>(rows.size()), trials);
  std::set<RunId> runs;
  for (const TrialRow& row : rows) {
    ASSERT_TRUE(row.run) << row.index;
    runs.insert(*row.run);
    const auto run = reader.run(*row.run);
    ASSERT_TRUE(run) << row.index;
    EXPECT_EQ(run->state, "finished");
    EXPECT_EQ(run->seed, row.seed);
    EXPECT_EQ(run->k, 20);
    EXPECT_EQ(run->tags, std::vector<std::string>{"campaign:1"});
  }
  EXPECT_EQ(static_cast<std::int64_t>(runs.size()), trials) << "no two trials have the same run";
}

TEST(CampaignCommand, WithSamplesEveryTrialIsOneRunWhateverKillsIt) {
  const TemporaryFolder folder;
  const std::string db = folder.file("a.db");
  const std::vector<std::string> words{"campaign", "consensus", "--runs", "60", "--steps",   "20", "--db",
                                       db,         "--samples", "--json", "-",  "--threads", "2"};
  for (const std::int64_t enough : {5, 20}) ASSERT_TRUE(kill_in_the_middle(words, db, enough)) << enough;
  const Outcome last = vigil_command(words);
  ASSERT_EQ(last.code, 0) << last.error;
  EXPECT_TRUE(check_log(db).ok);
  const LogReader reader(db);
  expect_a_run_each(reader, 60);
  const Outcome plain = vigil_command({"campaign", "consensus", "--runs", "60", "--steps", "20", "--json", "-"});
  EXPECT_EQ(without_timing(last.output).dump(), without_timing(plain.output).dump());
}

TEST(CampaignCommand, ABundleBringsItsTraceIntoTheLog) {
  const TemporaryFolder folder;
  const std::string frames = folder.file("frames.csv"), bundle = folder.file("bundle.json"), db = folder.file("a.db");
  ASSERT_EQ(vigil_command({"run", "consensus", "--steps", "20", "--frames", frames}).code, 0);
  Json whole{{"vigil_bundle", 1}, {"version", std::string(version())}, {"cpu", ""}, {"scenario", "consensus"}};
  whole["seed"] = 1;
  whole["state"] = "finished";
  whole["k"] = 20;
  whole["document"] = Scenario::preset("consensus").with("time.steps", 20).document();
  whole["commands"] = Json::array();
  std::ostringstream text;
  text << std::ifstream(frames).rdbuf();
  whole["trace"] = text.str();
  std::ofstream(bundle) << whole.dump();
  const Outcome logged = vigil_command({"campaign", bundle, "--runs", "3", "--db", db, "--json", "-"});
  ASSERT_EQ(logged.code, 0) << logged.error;
  const LogReader reader(db);
  ASSERT_EQ(reader.traces().size(), 1u);
  EXPECT_EQ(reader.trace_csv(reader.traces().front().id), text.str());
  EXPECT_EQ(reader.campaign(1)->request.at("trace"), reader.traces().front().id);
  const Outcome plain = vigil_command({"campaign", bundle, "--runs", "3", "--json", "-"});
  ASSERT_EQ(plain.code, 0) << plain.error;
  EXPECT_EQ(without_timing(logged.output).dump(), without_timing(plain.output).dump());
}

TEST(CampaignCommand, WhatCannotGoOnIsSaid) {
  const TemporaryFolder folder;
  const std::string db = folder.file("a.db");
  ASSERT_EQ(vigil_command({"campaign", "consensus", "--runs", "1", "--db", db}).code, 0);
  for (const auto& [words, part] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"campaign", "--db", db, "--resume", "1"}, "it is over"},
           {{"campaign", "--db", db, "--resume", "9"}, "no such campaign"},
           {{"campaign", "--resume", "1"}, "--db"},
           {{"campaign", "consensus", "--runs", "1", "--samples"}, "--db"},
           {{"campaign", "--runs", "1"}, "SCENARIO"}}) {
    const Outcome outcome = vigil_command(words);
    EXPECT_EQ(outcome.code, 2) << part;
    EXPECT_NE(outcome.error.find(part), std::string::npos) << outcome.error;
  }
}

}  // namespace
}  // namespace vigil::api_test::campaign_test
