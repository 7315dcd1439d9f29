/// Campaigns over a real broker: the same bytes as in one process, whoever dies in between.
#include <csignal>
#include <fstream>
#include <map>
#include <mutex>

#include "db/reader.hpp"
#include "server/crew/broker.hpp"
#include "tests/server/cli/command.hpp"
#include "tests/server/nats/processes.hpp"

namespace vigil::api_test::campaign_test {
namespace {

using Words = std::vector<std::string>;

/// Of a campaign's JSON, all but what the clock decides.
std::string untimed(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return "no JSON: " + text.substr(0, 500);
  json.erase("timing");
  return json.dump();
}

std::string read(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Every row of a log's campaign, as texts.
Words rows_of(const std::string& db) {
  const LogReader reader(db);
  Words rows;
  for (const TrialRow& row : reader.trials(1))
    rows.push_back(std::to_string(row.index) + " " + std::to_string(row.seed) + " " + row.state + " " + row.numbers +
                   " " + std::to_string(row.ticks) + row.faults.dump() + row.warnings.dump() + row.error);
  for (const CampaignCellRow& row : reader.campaign_cells(1))
    rows.push_back(row.sweep.dump() + row.design.dump() + row.columns.dump() + row.result.dump());
  return rows;
}

std::int64_t committed(const std::string& db) {
  try {
    const auto rows = LogReader(db).campaigns();
    return rows.empty() ? 0 : rows.front().done;
  } catch (const LogError&) {
    return 0;  // not made yet
  }
}

bool reaches(const std::string& db, std::int64_t enough) {
  for (int patience = 0; patience < 4; ++patience) {
    if (eventually([&] { return committed(db) >= enough; })) return true;
  }
  return false;
}

class OverNats : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = BrokerProcess::missing(); !why.empty()) GTEST_SKIP() << why;
    broker_ = std::make_unique<BrokerProcess>();
  }
  Words nats() const { return {"--nats", broker_->url()}; }
  void hire(int count, const Words& environment = {}) {
    for (int i = 0; i < count; ++i)
      workers_.push_back(start_worker(*broker_, "worker" + std::to_string(workers_.size()), environment));
  }
  /// The command in the background, its JSON to a file.
  std::unique_ptr<BackgroundProcess> start(const Words& words, const std::string& json) const {
    return std::make_unique<BackgroundProcess>(Words{VIGIL_EXECUTABLE} + words + nats() + Words{"--json", json},
                                               broker_->folder().file("campaign.log"));
  }
  /// What everybody said, where something goes wrong.
  std::string said(const BackgroundProcess& campaign) const {
    std::string all = campaign.output() + "\nbroker:\n" + broker_->output();
    for (const auto& worker : workers_) all += "\nworker:\n" + worker->output();
    return all;
  }
  std::string file(const std::string& name) const { return broker_->folder().file(name); }

  std::unique_ptr<BrokerProcess> broker_;
  std::vector<std::unique_ptr<BackgroundProcess>> workers_;
};

TEST_F(OverNats, ThreeWorkersGiveTheBytesOfOneProcess) {
  hire(3);
  const Words words{"campaign", "consensus", "--runs", "40", "--sweep", "adversary.links.params.pdos=0.1,0.4",
                    "--json",   "-"};
  const Outcome here = vigil_command(words + Words{"--threads", "2", "--db", file("here.db")});
  ASSERT_EQ(here.code, 0) << here.error;
  const Outcome there = vigil_command(words + nats());
  ASSERT_EQ(there.code, 0) << there.error;
  EXPECT_EQ(untimed(there.output), untimed(here.output));
  EXPECT_EQ(Json::parse(there.output)["timing"]["workers"].size(), 3U);
  const Outcome logged = vigil_command(words + nats() + Words{"--db", file("there.db")});
  ASSERT_EQ(logged.code, 0) << logged.error;
  EXPECT_EQ(untimed(logged.output), untimed(here.output));
  EXPECT_EQ(rows_of(file("there.db")), rows_of(file("here.db")));
}

// Pooled ratios and counts of detectors go through the broker, too; so do a trace and gains.
TEST_F(OverNats, EveryFamilyGivesTheBytesOfOneProcess) {
  hire(2);
  ASSERT_EQ(vigil_command({"run", "consensus", "--frames", file("trace.csv")}).code, 0);
  for (const Words& words : {Words{"privacy-turn", "--runs", "6"}, Words{"replay-nongaussian", "--runs", "6"},
                             Words{"observer-single", "--runs", "2", "--steps", "200"},
                             Words{"consensus", "--runs", "3", "--trace", file("trace.csv")}}) {
    const Words all = Words{"campaign"} + words + Words{"--json", "-"};
    const Outcome here = vigil_command(all), there = vigil_command(all + nats());
    EXPECT_EQ(there.code, here.code) << there.error;
    EXPECT_EQ(untimed(there.output), untimed(here.output)) << words.front();
  }
}

// Workers twice, the broker twice, and the campaign's own process.
TEST_F(OverNats, FiveKillsAndEveryTrialCountsOnce) {
  const Words slow{"VIGIL_TRIAL_SLEEP_MS=10"};
  hire(3, slow);
  const Words words{"campaign", "consensus", "--runs", "1200", "--db", file("a.db")};
  auto campaign = start(words, file("a.json"));
  ASSERT_TRUE(reaches(file("a.db"), 150)) << said(*campaign);
  EXPECT_EQ(workers_[0]->end(SIGKILL), 128 + SIGKILL);
  ASSERT_TRUE(reaches(file("a.db"), 300)) << said(*campaign);
  broker_->kill();
  broker_->start();
  ASSERT_TRUE(reaches(file("a.db"), 500)) << said(*campaign);
  hire(1, slow);
  EXPECT_EQ(workers_[1]->end(SIGKILL), 128 + SIGKILL);
  ASSERT_TRUE(reaches(file("a.db"), 700)) << said(*campaign);
  EXPECT_EQ(campaign->end(SIGKILL), 128 + SIGKILL);
  campaign = start(words, file("a.json"));
  ASSERT_TRUE(reaches(file("a.db"), 900)) << said(*campaign);
  broker_->kill();
  broker_->start(false);  // and what it had stored is gone
  ASSERT_EQ(campaign->wait(), 0) << said(*campaign);
  EXPECT_NE(campaign->output().find("goes on"), std::string::npos) << said(*campaign);
  const Outcome here = vigil_command({"campaign", "consensus", "--runs", "1200", "--db", file("b.db"), "--json", "-"});
  EXPECT_EQ(untimed(read(file("a.json"))), untimed(here.output));
  EXPECT_EQ(rows_of(file("a.db")), rows_of(file("b.db")));
}

TEST_F(OverNats, ATrialThatKillsItsWorkersFailsAndTheOthersCount) {
  const Words deadly{"VIGIL_DEADLY_TRIAL=5"};
  hire(1, deadly);
  auto campaign = start({"campaign", "consensus", "--runs", "8"}, file("a.json"));
  for (int patience = 0; patience < 8 && campaign->running(); ++patience) {
    eventually([&] {
      if (!workers_.back()->running()) hire(1, deadly);
      return !campaign->running();
    });
  }
  EXPECT_EQ(campaign->wait(), 3) << campaign->output();
  const Json result = Json::parse(read(file("a.json")));
  EXPECT_EQ(result["trials"]["failed"], 1);
  EXPECT_EQ(result["trials"]["finished"], 7);
  EXPECT_GE(workers_.size(), 6U);
}

TEST_F(OverNats, NothingIsLeftAtTheBroker) {
  const auto streams = [&] {
    int count = 0;
    std::error_code gone;  // while the broker deletes them
    for (std::filesystem::recursive_directory_iterator each(file("store"), gone), end; !gone && each != end;
         each.increment(gone))
      count += each->path().filename().string().starts_with("VIGIL_") ? 1 : 0;
    return count;
  };
  auto campaign = start({"campaign", "consensus", "--runs", "3"}, file("a.json"));
  ASSERT_TRUE(eventually([&] { return streams() > 0; })) << campaign->output();
  ASSERT_TRUE(eventually([&] { return campaign->output().find("no worker takes part yet") != std::string::npos; }));
  hire(1);
  ASSERT_EQ(campaign->wait(), 0) << campaign->output();
  EXPECT_TRUE(eventually([&] { return streams() == 0; }));
}

TEST_F(OverNats, AWorkerThatDiffersIsRefused) {
  hire(1);
  WorkerOptions other;
  other.name = "elsewhere";
  other.nats.url = broker_->url();
  other.fingerprint = own_fingerprint();
  other.fingerprint["processor"] = "x86-64 of 2004";
  std::mutex mutex;
  std::string said;
  other.nats.say = [&](const std::string& sentence) {
    const std::lock_guard lock(mutex);
    said += sentence + "\n";
  };
  std::atomic<bool> stop{false};
  std::thread worker([&] { run_nats_worker(other, stop); });
  auto campaign = start({"campaign", "consensus", "--runs", "3000"}, file("a.json"));
  const auto has = [&](const std::string& text) {
    return text.find("its processor is \"x86-64 of 2004\", the campaign's is \"") != std::string::npos;
  };
  EXPECT_TRUE(eventually([&] { return has(campaign->output()); })) << campaign->output();
  EXPECT_EQ(campaign->wait(), 0) << campaign->output();
  stop = true;
  worker.join();
  EXPECT_TRUE(has(said)) << said;
  EXPECT_EQ(said.find("its processor"), said.rfind("its processor")) << "said once\n" << said;
  std::map<std::string, Json> refused;
  const Json workers = Json::parse(read(file("a.json")))["timing"]["workers"];
  for (const Json& member : workers) refused[member["name"]] = member["refused"];
  EXPECT_TRUE(refused["worker0"].is_null());
  EXPECT_TRUE(refused["elsewhere"].is_string() && has(refused["elsewhere"])) << workers.dump();
}

TEST_F(OverNats, CredentialsComeFromAFile) {
  broker_ = std::make_unique<BrokerProcess>("authorization { user: vigil, password: secret }");
  std::ofstream(file("good.json")) << R"({"user":"vigil","password":"secret"})";
  std::ofstream(file("bad.json")) << R"({"user":"vigil","password":"wrong"})";
  const BackgroundProcess worker(
      {VIGIL_EXECUTABLE, "worker", "--nats", broker_->url(), "--nats-credentials", file("good.json")}, file("w.log"));
  const Words words = Words{"campaign", "consensus", "--runs", "2", "--json", "-"} + nats();
  EXPECT_EQ(vigil_command(words + Words{"--nats-credentials", file("good.json")}).code, 0) << worker.output();
  for (const Words& credentials : {Words{}, Words{"--nats-credentials", file("bad.json")}}) {
    const Outcome refused = vigil_command(words + credentials);
    EXPECT_EQ(refused.code, 2) << refused.error;
    EXPECT_NE(refused.error.find("refused"), std::string::npos) << refused.error;
  }
}

TEST_F(OverNats, WhatCannotBeIsSaid) {
  const Words campaign{"campaign", "consensus", "--runs", "1"};
  for (const auto& [words, part] : std::vector<std::pair<Words, std::string>>{
           {campaign + Words{"--nats", "http://x"}, "nats://HOST:PORT"},
           {campaign + nats() + Words{"--threads", "2"}, "--threads"},
           {campaign + nats() + Words{"--samples", "--db", file("a.db")}, "--samples"},
           {campaign + nats() + Words{"--nats-credentials", file("none")}, "cannot be read"},
           {{"worker"}, "--nats"},
           {{"worker", "--nats", "tls://"}, "nats://HOST:PORT"},
           {{"serve", "--port", "0", "--db", file("s.db"), "--nats", "nowhere"}, "nats://HOST:PORT"}}) {
    const Outcome outcome = vigil_command(words);
    EXPECT_EQ(outcome.code, 2) << part << outcome.error;
    EXPECT_NE(outcome.error.find(part), std::string::npos) << outcome.error;
  }
}

}  // namespace
}  // namespace vigil::api_test::campaign_test
