#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::control_test {
namespace {

const Json kEndless{{"scenario", "consensus"}, {"pace", 50}, {"patch", {{"time", {{"steps", nullptr}}}}}};

class ControlTest : public ApiTest {
 protected:
  std::string endless() {
    const std::string id = client_->start(kEndless);
    EXPECT_TRUE(eventually([&] { return client_->tick(id) >= 2; }));
    return id;
  }
  std::string path(const std::string& id) const { return "/api/v1/runs/" + id; }
};

TEST_F(ControlTest, PauseStepResumeStop) {
  const std::string id = endless();
  const Answer paused = client_->patch(path(id), {{"state", "paused"}});
  ASSERT_EQ(paused.status, 200) << paused.body;
  EXPECT_EQ(paused.json.at("state"), "paused");
  const std::int64_t k = client_->tick(id);
  const Answer stepped = client_->patch(path(id), {{"step", 3}});
  EXPECT_EQ(stepped.status, 200) << stepped.body;
  EXPECT_TRUE(eventually([&] { return client_->tick(id) == k + 3; }));
  EXPECT_EQ(client_->state(id), "paused");
  EXPECT_EQ(client_->get("/api/v1/runs?q=state:paused").json.at("items").size(), 1u);
  EXPECT_EQ(client_->patch(path(id), {{"state", "running"}}).json.at("state"), "running");
  EXPECT_TRUE(eventually([&] { return client_->tick(id) > k + 5; }));
  expect_problem(client_->patch(path(id), {{"step", 1}}), 409);
  const Answer stopped = client_->patch(path(id), {{"state", "stopped"}, {"note", "enough"}});
  EXPECT_EQ(stopped.json.at("state"), "stopped");
  EXPECT_EQ(stopped.json.at("note"), "enough");
  EXPECT_FALSE(stopped.json.at("metrics").empty());
  expect_problem(client_->patch(path(id), {{"state", "running"}}), 409);
  expect_problem(client_->patch(path(id), {{"params", {{"lanes.consensus.params.tau", 0.02}}}}), 409);
  expect_problem(client_->post(path(id) + "/attacks", {{"type", "dos"}, {"on", {"link:*"}}}), 409);
  EXPECT_EQ(client_->patch(path(id), {{"tags", {"kept"}}}).json.at("tags"), Json({"kept"}));
}

TEST_F(ControlTest, LiveParametersAreCommittedCommands) {
  const std::string id = endless();
  const Answer changed = client_->patch(path(id), {{"params", {{"lanes.consensus.params.tau", 0.02}}}, {"pace", 40}});
  ASSERT_EQ(changed.status, 200) << changed.body;
  EXPECT_EQ(changed.json.at("pace"), 40.0);
  ASSERT_EQ(changed.json.at("commands").size(), 1u);
  const Json listed = client_->get("/api/v1/runs?q=id:" + id).json.at("items").at(0);
  EXPECT_EQ(listed.at("changes"), 1);
  EXPECT_EQ(listed.at("document_hash"), changed.json.at("document_hash"));
  EXPECT_EQ(changed.json.at("commands")[0].at("body").at("params").at("lanes.consensus.params.tau"), 0.02);
  EXPECT_TRUE(eventually([&] { return !client_->get(path(id) + "/marks?type=command").json.at("items").empty(); }));
}

TEST_F(ControlTest, ParametersOfAPausedRunActOnTheNextTick) {
  const std::string id = endless();
  client_->patch(path(id), {{"state", "paused"}});
  const std::int64_t k = client_->tick(id);
  const Answer changed = client_->patch(path(id), {{"params", {{"lanes.consensus.params.tau", 0.03}}}});
  ASSERT_EQ(changed.status, 200) << changed.body;
  EXPECT_EQ(changed.json.at("commands")[0].at("k"), k + 1);
  EXPECT_EQ(client_->tick(id), k);
}

TEST_F(ControlTest, AttacksStartAndEnd) {
  const std::string id = endless();
  const Answer started =
      client_->post(path(id) + "/attacks", {{"type", "dos"}, {"on", {"link:1-2"}}, {"params", {{"probability", 1}}}});
  ASSERT_EQ(started.status, 201) << started.body;
  const std::string attack = started.json.at("id");
  EXPECT_GT(started.json.at("k").get<std::int64_t>(), 0);
  EXPECT_EQ(started.header("Location"), path(id) + "/attacks/" + attack);
  EXPECT_TRUE(eventually([&] { return !client_->get(path(id) + "/marks?type=attack").json.at("items").empty(); }));
  EXPECT_EQ(client_->remove(path(id) + "/attacks/" + attack).status, 200);
  expect_problem(client_->remove(path(id) + "/attacks/nosuch"), 404);
  EXPECT_EQ(client_->get(path(id)).json.at("commands").size(), 2u);
}

TEST_F(ControlTest, AnAttackByHandMayHaveASchedule) {
  const std::string id = endless();
  client_->patch(path(id), {{"state", "paused"}});
  const Json asked{{"type", "dos"}, {"on", {"link:1-2"}}, {"schedule", {{"every", 4}, {"for", 1}, {"budget", 2}}}};
  const Answer started = client_->post(path(id) + "/attacks", asked);
  ASSERT_EQ(started.status, 201) << started.body;
  const std::int64_t from = started.json.at("k");
  client_->patch(path(id), {{"step", 12}});
  ASSERT_TRUE(eventually([&] { return client_->tick(id) == from + 11; }));
  Json ticks = Json::array();
  ASSERT_TRUE(eventually([&] {
    ticks = Json::array();
    const Answer marks = client_->get(path(id) + "/marks?type=attack");
    for (const Json& mark : marks.json.at("items")) {
      if (mark.at("id") == started.json.at("id")) ticks.push_back(mark.at("k").get<std::int64_t>() - from);
    }
    return ticks.size() == 4;
  })) << ticks;
  EXPECT_EQ(ticks, Json({0, 1, 4, 5}));
  Json wrong = asked;
  wrong["schedule"]["for"] = 9;
  expect_problem(client_->post(path(id) + "/attacks", wrong), 422, "/schedule/for");
}

TEST_F(ControlTest, BadChangesChangeNothing) {
  const std::string id = endless();
  client_->patch(path(id), {{"state", "paused"}});
  struct Bad {
    const char* body;
    int status;
    const char* pointer;
  };
  for (const Bad& bad :
       {Bad{"{", 400, ""}, Bad{"[1]", 400, ""}, Bad{R"({"stat":"paused"})", 422, "/stat"},
        Bad{R"({"state":"finished"})", 422, "/state"}, Bad{R"({"state":3})", 422, "/state"},
        Bad{R"({"pace":-1})", 422, "/pace"}, Bad{R"({"step":0})", 422, "/step"}, Bad{R"({"step":1e9})", 422, "/step"},
        Bad{R"({"step":true})", 422, "/step"}, Bad{R"({"params":[]})", 422, "/params"},
        Bad{R"({"params":{}})", 422, "/params"}, Bad{R"({"params":{"no.such":1}})", 422, ""},
        Bad{R"({"params":{"lanes.consensus.params.tau":-1}})", 422, ""},
        Bad{R"({"params":{"lanes.consensus.params.tau":"x"}})", 422, ""},
        Bad{R"({"params":{"plant.params.b":1}})", 422, ""},
        Bad{R"({"params":{"lanes.consensus.params.tau":1e999}})", 400, ""}, Bad{R"({"tags":{}})", 422, "/tags"},
        Bad{R"({"note":[]})", 422, "/note"}, Bad{R"({"state":"running","step":2})", 422, "/step"}}) {
    SCOPED_TRACE(bad.body);
    expect_problem(client_->send("PATCH", path(id), bad.body), bad.status, bad.pointer);
  }
  for (const char* body :
       {R"({})", R"({"type":"nosuch","on":["link:*"]})", R"({"type":"dos","on":["link:1-99"]})",
        R"({"type":"dos","on":"link:*"})", R"({"type":"dos","on":["link:*"],"params":{"probability":2}})",
        R"({"type":"dos","on":["link:*"],"params":{"q":1}})", R"({"type":"dos","on":["link:*"],"extra":1})",
        R"({"type":"dos","on":["link:*"],"from":"x"})"}) {
    SCOPED_TRACE(body);
    expect_problem(client_->send("POST", path(id) + "/attacks", body), 422);
  }
  expect_problem(
      client_->post(path(id) + "/attacks", {{"type", "dos"}, {"on", {"link:*"}}, {"params", {{"probability", 2}}}}),
      422, "/params/probability");
  const Json run = client_->get(path(id)).json;
  EXPECT_TRUE(run.at("commands").empty());
  EXPECT_EQ(run.at("state"), "paused");
}

TEST_F(ControlTest, MoreRunsThanAllowedWait) {
  server_.reset();
  options_.runs.max_runs = 1;
  options_.runs.max_queue = 2;
  begin();
  const std::string first = endless();
  const std::string second = client_->start(kEndless);
  const std::string third = client_->start({{"scenario", "consensus"}});
  EXPECT_EQ(client_->state(second), "queued");
  EXPECT_EQ(client_->state(third), "queued");
  EXPECT_EQ(client_->get("/api/v1/server").json.at("runs").at("queued"), 2);
  expect_problem(client_->post("/api/v1/runs", kEndless), 503);
  const Answer early = client_->patch(path(second), {{"params", {{"lanes.consensus.params.tau", 0.02}}}});
  EXPECT_EQ(early.status, 200) << early.body;
  EXPECT_EQ(early.json.at("commands")[0].at("k"), 0);
  EXPECT_EQ(client_->patch(path(second), {{"state", "stopped"}}).json.at("state"), "stopped");
  EXPECT_EQ(client_->patch(path(first), {{"state", "stopped"}}).json.at("state"), "stopped");
  EXPECT_TRUE(client_->reaches(third, "finished"));
}

TEST_F(ControlTest, TheDemoSleepsUntilSomebodyWatches) {
  server_.reset();
  options_.demo = true;
  begin();
  const std::string id = client_->get("/api/v1/server").json.at("demo");
  const Json run = client_->get(path(id)).json;
  EXPECT_EQ(run.at("tags"), Json({"demo"}));
  EXPECT_EQ(run.at("pace"), 20.0);
  EXPECT_TRUE(run.at("progress").at("steps").is_null());
  ASSERT_TRUE(eventually([&] { return client_->get(path(id)).json.at("idle") == true; }));
  const std::int64_t asleep = client_->tick(id);
  httplib::Client viewer("127.0.0.1", client_->port());
  viewer.set_read_timeout(60);
  std::string seen;
  viewer.Get((path(id) + "/stream").c_str(), [&](const char* data, std::size_t size) {
    seen.append(data, size);
    return seen.find("\"k\":" + std::to_string(asleep + 3) + ",") == std::string::npos;
  });
  EXPECT_NE(seen.find("event: frame"), std::string::npos);
  EXPECT_GE(client_->tick(id), asleep + 3);
}

TEST_F(ControlTest, AtMostOneEarlierDemoIsKept) {
  server_.reset();
  options_.demo = true;
  for (int i = 0; i < 3; ++i) {
    begin();
    if (i < 2) server_.reset();
  }
  EXPECT_EQ(client_->get("/api/v1/runs?q=tag:demo").json.at("items").size(), 2u);
}

}  // namespace
}  // namespace vigil::api_test::control_test
