/// Campaigns over HTTP: started, paused, ended, interrupted; their trials run alone.
#include <algorithm>

#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::campaigns_test {
namespace {

class Campaigns : public ApiTest {
 protected:
  std::string begin_campaign(const Json& body) const {
    const Answer answer = client_->post("/api/v1/campaigns", body);
    EXPECT_EQ(answer.status, 202) << answer.body;
    if (answer.status != 202) return "0";
    const std::string id = answer.json.at("id");
    EXPECT_EQ(answer.header("Location"), "/api/v1/campaigns/" + id);
    return id;
  }
  Json look(const std::string& id) const { return client_->get("/api/v1/campaigns/" + id).json; }
  bool reaches(const std::string& id, const std::string& state) const {
    return eventually([&] { return look(id).at("state") == state; });
  }
  std::int64_t done(const std::string& id) const { return look(id).at("progress").at("done"); }
  /// More than is there before anybody pauses it.
  static Json long_one() { return {{"scenario", "consensus"}, {"runs", 100'000}, {"threads", 2}}; }
};

TEST_F(Campaigns, AGridIsRunAndItsResultsAreThere) {
  const std::string id = begin_campaign({{"scenario", "consensus"},
                                         {"patch", {{"time", {{"steps", 5}}}}},
                                         {"runs", 4},
                                         {"first_seed", 11},
                                         {"sweep", {{"lanes.consensus.params.tau", {0.01, 0.02}}}},
                                         {"note", "two"}});
  ASSERT_TRUE(reaches(id, "finished"));
  const Json campaign = look(id);
  EXPECT_EQ(campaign.at("cells").size(), 2u);
  EXPECT_EQ(campaign.at("cells").at(1).at("sweep").at("lanes.consensus.params.tau"), 0.02);
  EXPECT_EQ(campaign.at("trials").at("finished"), 8);
  EXPECT_EQ(campaign.at("note"), "two");
  EXPECT_EQ(campaign.at("metrics").at(0).at("n"), 4);
  const Json cell = client_->get("/api/v1/campaigns/" + id + "/cells/1").json.at("result");
  EXPECT_FALSE(cell.at("paired").empty());
  EXPECT_TRUE(cell.contains("detection"));
  const Answer csv = client_->get("/api/v1/campaigns/" + id, {{"Accept", "text/csv"}});
  EXPECT_TRUE(csv.body.starts_with("cell,lanes.consensus.params.tau,lane,node,name,variant,mean,se,")) << csv.body;
  const Answer list = client_->get("/api/v1/campaigns?limit=1");
  EXPECT_EQ(list.json.at("items").at(0).at("id"), id);
  EXPECT_EQ(client_->remove("/api/v1/campaigns/" + id).status, 204);
  expect_problem(client_->get("/api/v1/campaigns/" + id), 404);
}

// The trial says how to repeat it; the run that comes of it has its metrics, bit for bit.
TEST_F(Campaigns, ATrialIsRunAloneWithTheSameMetrics) {
  const std::string id = begin_campaign(
      {{"scenario", "consensus"}, {"runs", 5}, {"sweep", {{"adversary.links.params.pdos", {0.1, 0.4}}}}});
  ASSERT_TRUE(reaches(id, "finished"));
  const std::string trials = "/api/v1/campaigns/" + id + "/trials";
  const Json outliers = client_->get(trials + "?cell=1&metric=consensus.rmse_position&sort=outlier&limit=2").json;
  ASSERT_EQ(outliers.at("items").size(), 2u);
  EXPECT_EQ(outliers.at("next"), "2");
  const Json falling = client_->get(trials + "?cell=1&metric=consensus.rmse_position&sort=-value").json.at("items");
  ASSERT_EQ(falling.size(), 5u);
  for (std::size_t i = 1; i < falling.size(); ++i) EXPECT_GE(falling[i - 1].at("value"), falling[i].at("value"));
  const std::int64_t index = outliers.at("items").at(0).at("index");
  const Json trial = client_->get(trials + "/" + std::to_string(index)).json;
  const std::string run = client_->start(trial.at("request"));
  ASSERT_TRUE(client_->reaches(run, "finished"));
  EXPECT_EQ(client_->get("/api/v1/runs/" + run).json.at("metrics").dump(), trial.at("metrics").dump());
  EXPECT_NE(trial.at("command").get<std::string>().find("--seed " + std::to_string(trial.at("seed").get<int>())),
            std::string::npos);
  expect_problem(client_->get(trials + "?metric=nosuch"), 400, "/metric");
  expect_problem(client_->get(trials + "?cell=7"), 404);
  expect_problem(client_->get(trials + "/10"), 404);
}

TEST_F(Campaigns, PausesGoesOnAndIsCancelled) {
  const std::string id = begin_campaign(long_one()), path = "/api/v1/campaigns/" + id;
  ASSERT_TRUE(eventually([&] { return done(id) > 0; }));
  EXPECT_EQ(client_->patch(path, {{"state", "paused"}}).json.at("state"), "paused");
  const std::int64_t there = done(id);
  EXPECT_LT(there, 100'000);
  EXPECT_GT(client_->get(path + "/cells/0").json.at("result").at("metrics").size(), 0u) << "what is merged so far";
  EXPECT_EQ(client_->patch(path, {{"state", "running"}}).status, 200);
  ASSERT_TRUE(eventually([&] { return done(id) > there; }));
  EXPECT_EQ(client_->patch(path, {{"state", "cancelled"}}).json.at("state"), "cancelled");
  expect_problem(client_->patch(path, {{"state", "running"}}), 409);
  expect_problem(client_->patch(path, {{"state", "nosuch"}}), 422, "/state");
}

TEST_F(Campaigns, AServerThatComesBackGoesOnWithWhatWasInterruptedAndNotWithWhatIsPaused) {
  const std::string paused = begin_campaign(long_one());
  ASSERT_TRUE(eventually([&] { return done(paused) > 0; }));
  client_->patch("/api/v1/campaigns/" + paused, {{"state", "paused"}});
  const std::string id = begin_campaign(long_one());
  ASSERT_TRUE(eventually([&] { return done(id) > 0; }));
  server_.reset();
  std::int64_t there = 0;
  {
    const LogReader reader(options_.db);
    const auto row = reader.campaign(std::stoll(id));
    EXPECT_EQ(row->state, "interrupted");
    there = row->done;
    EXPECT_GT(there, 0);
  }
  begin();
  ASSERT_TRUE(eventually([&] { return done(id) > there; }));
  EXPECT_EQ(look(paused).at("state"), "paused");
  client_->patch("/api/v1/campaigns/" + id, {{"state", "cancelled"}});
}

TEST_F(Campaigns, SamplesAreKeptAsRuns) {
  const std::string id = begin_campaign(
      {{"scenario", "consensus"}, {"patch", {{"time", {{"steps", 6}}}}}, {"runs", 3}, {"samples", true}});
  ASSERT_TRUE(reaches(id, "finished"));
  const Json runs = client_->get("/api/v1/runs?q=tag:%22campaign:" + id + "%22").json.at("items");
  ASSERT_EQ(runs.size(), 3u);
  const Json trials = client_->get("/api/v1/campaigns/" + id + "/trials").json.at("items");
  const std::string run = trials.at(2).at("run");
  const Json kept = client_->get("/api/v1/runs/" + run).json;
  EXPECT_EQ(kept.at("seed"), trials.at(2).at("seed"));
  EXPECT_EQ(kept.at("state"), "finished");
  EXPECT_EQ(client_->get("/api/v1/runs/" + run + "/samples?signals=truth.*").json.at("k").size(), 7u);
}

// A document may be valid and still not runnable: nobody hears anybody without a network.
TEST_F(Campaigns, ATrialThatCannotBeRunIsKeptWithItsReason) {
  const std::string id = begin_campaign({{"scenario", "privacy-turn"},
                                         {"patch", {{"time", {{"steps", 5}}}}},
                                         {"runs", 2},
                                         {"sweep", {{"network.graph", {"centre", "none"}}}}});
  ASSERT_TRUE(reaches(id, "finished"));
  const Json trials{{"finished", 2}, {"stopped", 0}, {"failed", 2}};
  EXPECT_EQ(look(id).at("trials"), trials);
  EXPECT_EQ(look(id).at("progress").at("failed"), 2);
  const std::string path = "/api/v1/campaigns/" + id + "/trials";
  const Json failed = client_->get(path + "?cell=1&state=failed").json.at("items");
  ASSERT_EQ(failed.size(), 2u);
  EXPECT_FALSE(failed.at(0).at("error").get<std::string>().empty());
  const Json alone = client_->get(path + "/2").json.at("request");
  const Answer refused = client_->post("/api/v1/runs", alone);
  EXPECT_EQ(refused.status, 422);
  EXPECT_NE(refused.body.find("network"), std::string::npos) << refused.body;
}

TEST_F(Campaigns, TheGlobalStreamTellsProgressAndTheEnd) {
  httplib::Client viewer("127.0.0.1", client_->port());
  viewer.set_read_timeout(60);
  std::string seen, id;
  viewer.Get("/api/v1/stream", [&](const char* data, std::size_t size) {
    seen.append(data, size);
    if (id.empty())
      id = begin_campaign({{"scenario", "consensus"}, {"patch", {{"time", {{"steps", 5}}}}}, {"runs", 40}});
    return seen.find("\"state\":\"finished\"") == std::string::npos;
  });
  std::vector<Json> notes;
  for (std::size_t at = seen.find("event: campaign"); at != std::string::npos;
       at = seen.find("event: campaign", at + 1)) {
    const std::size_t from = seen.find("data: ", at) + 6;
    notes.push_back(Json::parse(seen.substr(from, seen.find('\n', from) - from)));
  }
  ASSERT_GE(notes.size(), 2u) << seen;
  for (const Json& note : notes) EXPECT_EQ(note.at("id"), id);
  const Json& last = notes.back();
  EXPECT_EQ(last.at("state"), "finished");
  EXPECT_EQ(last.at("done"), 40);
  EXPECT_EQ(last.at("trials"), 40);
  EXPECT_EQ(last.at("failed"), 0);
  EXPECT_GT(last.at("trials_per_second"), 0);
  const auto running = [](const Json& note) { return note.at("state") == "running"; };
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), running));
}

TEST_F(Campaigns, TheSameKeyStartsNoSecondOne) {
  const Json body{{"scenario", "consensus"}, {"runs", 1}};
  const Answer first = client_->post("/api/v1/campaigns", body, {{"Idempotency-Key", "k"}});
  const Answer second = client_->post("/api/v1/campaigns", body, {{"Idempotency-Key", "k"}});
  EXPECT_EQ(first.json.at("id"), second.json.at("id"));
  EXPECT_EQ(second.header("Idempotency-Replayed"), "true");
  const Json other{{"scenario", "consensus"}, {"runs", 2}};
  expect_problem(client_->post("/api/v1/campaigns", other, {{"Idempotency-Key", "k"}}), 422);
}

TEST_F(Campaigns, BadOnesAreRefusedWhereTheyAreBad) {
  const auto refused = [&](const Json& change, const char* pointer) {
    Json body{{"scenario", "consensus"}, {"runs", 1}};
    body.merge_patch(change);
    expect_problem(client_->post("/api/v1/campaigns", body), 422, pointer);
  };
  refused({{"runs", 0}}, "/runs");
  refused({{"runs", nullptr}}, "/runs");
  refused({{"sweep", {{"a", 3}}}}, "/sweep");
  refused({{"sweep", {{"a", Json::array()}}}}, "/sweep");
  refused({{"samples", 1}}, "/samples");
  refused({{"input", {{"trace", 99}}}}, "/input/trace");
  const Json endless{{"scenario", "consensus"}, {"runs", 1}, {"patch", {{"time", {{"steps", nullptr}}}}}};
  expect_problem(client_->post("/api/v1/campaigns", endless), 422, "/time/steps");
  expect_problem(client_->post("/api/v1/campaigns",
                               {{"scenario", "consensus"}, {"runs", 1}, {"sweep", {{"lanes.nosuch.params.tau", {1}}}}}),
                 422);
}

}  // namespace
}  // namespace vigil::api_test::campaigns_test
