// Gains over HTTP: asked for alone, and by a run that waits for them.
#include "engine/linalg/sdp.hpp"
#include "engine/world/interconnected/examples.hpp"
#include "engine/world/interconnected/plant.hpp"
#include "tests/server/synthesis/scripts.hpp"

namespace vigil::api_test::designs_test {
namespace {

const Json kShort{{"time", {{"steps", 200}}}};

/// Of the pair's system, with one lane.
Json one_lane(const std::string& lane) {
  Json patch = kShort;
  for (const char* other : {"intermediate_fast", "intermediate_ref", "intermediate_printed"}) {
    if (lane != other) patch["lanes"][other] = nullptr;
  }
  return patch;
}

class DesignsTest : public ApiTest {
 protected:
  void SetUp() override { begin(VIGIL_EXECUTABLE); }
  void begin(const std::string& executable, const std::string& db = "vigil.db") {
    server_.reset();
    options_.front.port = 0;
    options_.db = folder_.file(db);
    options_.runs.design.executable = executable;
    server_ = std::make_unique<Server>(options_);
    server_->start();
    client_ = std::make_unique<Client>(server_->port());
  }
  std::string path(const std::string& id) const { return "/api/v1/runs/" + id; }
  Json run(const std::string& id) const { return client_->get(path(id)).json; }
  std::string start(const Json& patch = one_lane("intermediate_ref")) const {
    return client_->start({{"scenario", "observer-pair"}, {"patch", patch}});
  }
  /// The codes of its marks of type state, in order.
  std::vector<std::string> states(const std::string& id) const {
    std::vector<std::string> codes;
    const Answer marks = client_->get(path(id) + "/marks?type=state");
    for (const Json& mark : marks.json.at("items")) codes.push_back(mark.at("code"));
    return codes;
  }
  Json design(const std::string& key) const { return client_->get("/api/v1/designs/" + key).json; }
  Json settled(const std::string& key) const {
    EXPECT_TRUE(eventually([&] { return design(key).at("state") == "done" || design(key).at("state") == "refused"; }));
    return design(key);
  }
  std::string frames(const std::string& id) const {
    return client_->get(path(id) + "/samples", {{"Accept", "text/csv"}}).body;
  }
};

using Codes = std::vector<std::string>;

TEST_F(DesignsTest, AreAskedForAndTold) {
  const Answer asked = client_->post("/api/v1/designs", {{"scenario", "observer-single"}});
  ASSERT_EQ(asked.status, 202) << asked.body;
  ASSERT_EQ(asked.json.at("items").size(), 4u);
  std::vector<std::string> lanes;
  for (const Json& item : asked.json.at("items")) {
    lanes.push_back(item.at("lane"));
    EXPECT_EQ(item.at("key").get<std::string>().size(), 16u);
    EXPECT_EQ(item.at("limit"), 120);
    const Json told = settled(item.at("key"));
    ASSERT_EQ(told.at("state"), "done") << told.at("reason");
    EXPECT_TRUE(told.at("reason").is_null());
    EXPECT_EQ(told.at("record").at("key"), item.at("key"));
    EXPECT_EQ(told.at("record").at("holds"), true);
    EXPECT_GT(told.at("seconds"), 0);
  }
  EXPECT_EQ(lanes, (Codes{"intermediate_fast", "intermediate_ref", "classical_fast", "classical_ref"}));
  const std::string key = asked.json.at("items").at(1).at("key");
  EXPECT_NEAR(design(key).at("record").at("objective").get<double>(), 0.22963, 0.0023);
  const Answer again = client_->post("/api/v1/designs", {{"scenario", "observer-single"}});
  for (const Json& item : again.json.at("items")) EXPECT_EQ(item.at("state"), "done");

  const Answer text = client_->get("/api/v1/designs/" + key + "/sdpa");
  EXPECT_EQ(text.status, 200);
  EXPECT_EQ(text.header("Content-Type").rfind("text/plain", 0), 0u);
  EXPECT_EQ(content_hash(read_sdpa(text.body)), key);
  expect_problem(client_->get("/api/v1/designs/0123456789abcdef"), 404);
  expect_problem(client_->get("/api/v1/designs/0123456789abcdef/sdpa"), 404);
}

TEST_F(DesignsTest, OfOtherScenariosThereAreNone) {
  const Answer asked = client_->post("/api/v1/designs", {{"scenario", "consensus"}});
  EXPECT_EQ(asked.status, 202);
  EXPECT_EQ(asked.json.at("items"), Json::array());
}

TEST_F(DesignsTest, BadRequestsAndSystemsAreNamed) {
  expect_problem(client_->post("/api/v1/designs", {{"scenario", "observer-pair"}, {"steps", 3}}), 422, "/steps");
  expect_problem(client_->post("/api/v1/designs", Json::object()), 422, "/scenario");
  expect_problem(client_->post("/api/v1/designs", {{"scenario", "observer-pair"}, {"patch", 3}}), 422, "/patch");
  observer::Network network = observer::pair().network;
  network.subsystems[0].D.resize(4, 2);
  network.subsystems[0].D.setOnes();
  Json document = client_->get("/api/v1/scenarios/observer-pair").json;
  document["plant"] = {{"type", "interconnected"}, {"params", observer::write_network(network)}};
  for (const char* where : {"/api/v1/designs", "/api/v1/runs"}) {
    expect_problem(client_->post(where, {{"scenario", document}}), 422, "/scenario/plant/params/subsystems/1/D");
  }
}

TEST_F(DesignsTest, ARunWaitsForThemAndGoesOn) {
  begin(gated(folder_));
  const Answer made = client_->post("/api/v1/runs", {{"scenario", "observer-pair"}, {"patch", kShort}, {"seed", 3}});
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string id = made.json.at("id");
  EXPECT_EQ(made.json.at("state"), "designing");
  EXPECT_TRUE(made.json.at("started").is_null());
  EXPECT_EQ(made.json.at("progress").at("steps"), 200);
  EXPECT_EQ(made.json.at("designing").size(), 3u);
  EXPECT_EQ(made.json.at("designing").at(0).at("lane"), "intermediate_fast");
  EXPECT_EQ(client_->get("/api/v1/runs?q=state:designing").json.at("items").size(), 1u);
  EXPECT_EQ(client_->get("/api/v1/server").json.at("runs").at("designing"), 1);
  expect_problem(client_->patch(path(id), {{"state", "paused"}}), 409);
  expect_problem(client_->patch(path(id), {{"pace", 10}}), 409);
  expect_problem(client_->post(path(id) + "/attacks", {{"type", "bias"}, {"on", {"actuator:1"}}}), 409);
  expect_problem(client_->post(path(id) + "/fork", {{"k", 0}}), 409);
  expect_problem(client_->get(path(id) + "/stream"), 409);
  EXPECT_EQ(client_->patch(path(id), {{"note", "patience"}}).json.at("note"), "patience");
  open_gate(folder_);
  ASSERT_TRUE(client_->reaches(id, "finished")) << run(id);
  const Json over = run(id);
  EXPECT_EQ(over.at("designing"), Json::array());
  for (const char* lane : {"intermediate_fast", "intermediate_ref", "intermediate_printed"}) {
    EXPECT_EQ(over.at("design").at(lane).at("holds"), true) << lane;
  }
  EXPECT_EQ(over.at("progress").at("k"), 200);
  EXPECT_EQ(states(id), (Codes{"designing", "running", "finished"}));
  EXPECT_EQ(client_->get("/api/v1/server").json.at("runs").at("designing"), 0);
}

TEST_F(DesignsTest, OneThatIsKnownIsNotWaitedFor) {
  const std::string first = start();
  ASSERT_TRUE(client_->reaches(first, "finished")) << run(first);
  begin("/bin/false");
  const std::string second = start();
  ASSERT_TRUE(client_->reaches(second, "finished")) << run(second);
  EXPECT_EQ(states(second), (Codes{"running", "finished"}));
  EXPECT_EQ(run(second).at("design"), run(first).at("design"));
  EXPECT_EQ(frames(second), frames(first));
}

TEST_F(DesignsTest, ARunThatWaitsIsStoppedAndDeleted) {
  begin(silent(folder_));
  const std::string stopped = start(), deleted = start(one_lane("intermediate_fast"));
  const pid_t pid = child_of(folder_);
  const std::string key = run(stopped).at("designing").at(0).at("key");
  EXPECT_EQ(client_->patch(path(stopped), {{"state", "stopped"}}).json.at("state"), "stopped");
  EXPECT_TRUE(eventually([&] { return gone(pid); }));
  EXPECT_EQ(states(stopped), (Codes{"designing", "stopped"}));
  EXPECT_EQ(client_->get("/api/v1/designs/" + key).status, 404);
  expect_problem(client_->patch(path(stopped), {{"state", "stopped"}}), 409);
  EXPECT_EQ(client_->remove(path(deleted)).status, 204);
  EXPECT_EQ(client_->get(path(deleted)).status, 404);
  EXPECT_EQ(client_->get("/api/v1/server").json.at("runs").at("designing"), 0);
}

TEST_F(DesignsTest, AServerThatEndsInterruptsThem) {
  begin(silent(folder_));
  const std::string id = start();
  const pid_t pid = child_of(folder_);
  begin("/bin/false");
  EXPECT_TRUE(gone(pid));
  EXPECT_EQ(client_->state(id), "interrupted");
  EXPECT_EQ(states(id), (Codes{"designing", "interrupted"}));
}

TEST_F(DesignsTest, ALimitThatPassesFailsTheRunAndTheNextOneTriesAgain) {
  options_.runs.design.limit = 0.3;
  begin(silent(folder_));
  const std::string id = start();
  ASSERT_TRUE(client_->reaches(id, "failed"));
  EXPECT_NE(run(id).at("error").get<std::string>().find("no answer within 0.3 s"), std::string::npos)
      << run(id).at("error");
  EXPECT_EQ(client_->get("/healthz").status, 200);
  options_.runs.design.limit = 120;
  begin(VIGIL_EXECUTABLE);
  const std::string again = start();
  EXPECT_TRUE(client_->reaches(again, "finished")) << run(again);
}

TEST_F(DesignsTest, WhatCannotBeDesignedForFailsWithItsSentence) {
  observer::Network network;
  for (const double pole : {-1.0, 0.5}) {
    observer::Subsystem& s = network.subsystems.emplace_back();
    s.name = std::to_string(network.subsystems.size());
    s.A = Eigen::MatrixXd::Constant(1, 1, pole);
    s.C = Eigen::MatrixXd::Ones(1, 1);
    s.D = Eigen::MatrixXd::Ones(1, 1);
    observer::complete(s);
  }
  for (const int to : {0, 1}) network.couplings.push_back({to, 1 - to, Eigen::MatrixXd::Constant(1, 1, 1e5)});
  Json document = client_->get("/api/v1/scenarios/observer-single").json;
  document["id"] = "own";
  document["plant"] = {{"type", "interconnected"}, {"params", observer::write_network(network)}};
  document["nodes"] = Json::object();
  for (const int i : {1, 2}) {
    document["nodes"][std::to_string(i)] = {{"sensor", {{"type", "subsystem"}, {"params", {{"number", i}}}}}};
  }
  for (const char* section : {"adversary", "initial", "noise", "metrics"}) document[section] = Json::object();
  document["time"]["steps"] = 10;
  document["lanes"] = {{"mine", {{"method", "intermediate_observer"}, {"params", {{"preset", "ref"}}}}}};
  const Answer asked = client_->post("/api/v1/designs", {{"scenario", document}});
  ASSERT_EQ(asked.status, 202) << asked.body;
  const Json told = settled(asked.json.at("items").at(0).at("key"));
  EXPECT_EQ(told.at("state"), "refused");
  EXPECT_FALSE(told.at("reason").get<std::string>().empty());
  for (int life = 0; life < 2; ++life) {
    const std::string id = client_->start({{"scenario", document}});
    ASSERT_TRUE(client_->reaches(id, "failed"));
    EXPECT_NE(run(id).at("error").get<std::string>().find("no certified gains"), std::string::npos)
        << run(id).at("error");
    EXPECT_EQ(states(id), (Codes{"designing", "failed"}));
    begin("/bin/false");  // the next server knows it without asking a solver
  }
}

TEST_F(DesignsTest, GainsTravelWithBundlesAndForks) {
  const std::string first = start();
  ASSERT_TRUE(client_->reaches(first, "finished")) << run(first);
  const std::string original = frames(first);
  const Answer bundle = client_->get(path(first) + "/bundle");
  ASSERT_EQ(bundle.status, 200);
  EXPECT_EQ(bundle.json.at("designs").at("intermediate_ref").at("key"),
            run(first).at("design").at("intermediate_ref").at("key"));

  begin("/bin/false", "other.db");  // a server that can solve nothing and knows nothing
  const Answer imported = client_->send("POST", "/api/v1/runs/import", bundle.body);
  ASSERT_EQ(imported.status, 201) << imported.body;
  const std::string copy = imported.json.at("id");
  ASSERT_TRUE(client_->reaches(copy, "finished")) << run(copy);
  EXPECT_EQ(frames(copy), original);
  EXPECT_EQ(states(copy), (Codes{"running", "finished"}));

  const Answer forked = client_->post(path(copy) + "/fork", {{"k", 100}, {"patch", {{"time", {{"steps", 210}}}}}});
  ASSERT_EQ(forked.status, 201) << forked.body;
  const std::string fork = forked.json.at("id");
  ASSERT_TRUE(client_->reaches(fork, "finished")) << run(fork);
  EXPECT_EQ(frames(fork).rfind(original, 0), 0u);
  EXPECT_EQ(client_->tick(fork), 210);

  Json forged = bundle.json;
  forged["designs"]["intermediate_ref"]["L"][0][0][0] = 1e6;
  expect_problem(client_->post("/api/v1/runs/import", forged), 422, "/designs/intermediate_ref");
  forged["designs"]["intermediate_ref"]["L"] = "gains";
  expect_problem(client_->post("/api/v1/runs/import", forged), 422, "/designs/intermediate_ref");
  forged["designs"] = 3;
  expect_problem(client_->post("/api/v1/runs/import", forged), 422, "/designs");
  forged = bundle.json;
  forged["designs"]["intermediate_ref"]["key"] = "0123456789abcdef";  // of another problem: not taken
  const std::string lost = client_->post("/api/v1/runs/import", forged).json.at("id");
  EXPECT_TRUE(client_->reaches(lost, "failed"));
}

TEST_F(DesignsTest, ManyAreDescribedAndCounted) {
  const Json api = client_->get("/api/v1/openapi.json").json;
  for (const char* route : {"/api/v1/designs", "/api/v1/designs/{key}", "/api/v1/designs/{key}/sdpa"}) {
    EXPECT_TRUE(api.at("paths").contains(route)) << route;
  }
  EXPECT_NE(client_->get("/metrics").body.find("vigil_runs{state=\"designing\"} 0"), std::string::npos);
}

}  // namespace
}  // namespace vigil::api_test::designs_test
