/// A campaign that is killed and goes on is the campaign that was never killed.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "db/maintenance.hpp"
#include "db/reader.hpp"
#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test {
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
}  // namespace vigil::api_test
