// Rows pushed into a live run over real sockets.
#include "tests/server/api/fixture.hpp"
#include "tests/server/api/measured.hpp"

namespace vigil::api_test::ingest_test {
namespace {

constexpr const char* kLines = "application/x-ndjson";

class IngestTest : public ApiTest {
 protected:
  std::string begin_run(Json input = "ingest", Json more = Json::object()) {
    Json body{{"scenario", "consensus"}, {"seed", 5}, {"input", std::move(input)}};
    body.update(more);
    return client_->start(body);
  }
  Answer push(const std::string& id, const std::string& body, const std::string& type = kLines) {
    return client_->send("POST", "/api/v1/ingest/" + id, body, type);
  }
  std::string frames(const std::string& id, const std::string& query = "?signals=lane.*") const {
    return client_->get("/api/v1/runs/" + id + "/samples" + query, {{"Accept", "text/csv"}}).body;
  }
  std::string traced(const Measured& rows) {
    const Answer trace = client_->send("POST", "/api/v1/traces", rows.csv(0, rows.cells.size()), "text/csv");
    EXPECT_EQ(trace.status, 201) << trace.body;
    const std::string id = begin_run({{"trace", trace.json.at("id")}});
    EXPECT_TRUE(client_->reaches(id, "finished"));
    return id;
  }
};

TEST_F(IngestTest, TheSameRowsGiveTheSameSamplesAsTheirTrace) {
  const Measured rows(31);
  const std::string expected = frames(traced(rows));
  ASSERT_GT(expected.size(), 1000u);

  const std::string by_csv = begin_run();
  EXPECT_EQ(client_->get("/api/v1/runs/" + by_csv).json.at("input"), "ingest");
  for (std::size_t k = 0; k < rows.cells.size(); k += 7) {
    const Answer answer = push(by_csv, rows.csv(k, std::min(k + 7, rows.cells.size())), "text/csv");
    ASSERT_EQ(answer.status, 200) << answer.body;
  }
  ASSERT_TRUE(client_->reaches(by_csv, "finished"));
  EXPECT_EQ(frames(by_csv), expected);

  const std::string by_node = begin_run();
  for (std::size_t k = 0; k < rows.cells.size();
       k += 3) {  // three ticks a call, the nodes in any order, the truth first
    std::string body;
    const std::size_t end = std::min(k + 3, rows.cells.size());
    for (std::size_t at = k; at < end; ++at) body += rows.line(at, -1).dump() + "\n";
    for (int node = static_cast<int>(rows.nodes.size()) - 1; node >= 0; --node) {
      for (std::size_t at = end; at-- > k;) body += rows.line(at, node).dump() + "\n";
    }
    const Answer answer = push(by_node, body);
    ASSERT_EQ(answer.status, 200) << answer.body;
    ASSERT_EQ(answer.json.at("closed"), end - 1);
  }
  ASSERT_TRUE(client_->reaches(by_node, "finished"));
  EXPECT_EQ(frames(by_node), expected);
}

TEST_F(IngestTest, TheAnswerTellsWhatBecameOfTheRows) {
  const Measured rows(32);
  const std::string id = begin_run({{"ingest", {{"deadline", 3600}, {"columns", Json::array()}}}});
  Answer answer = push(id, rows.line(0, 0).dump(), "application/json");
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(answer.json,
            (Json{{"accepted", 1}, {"duplicate", 0}, {"late", 0}, {"beyond", 0}, {"open", {0}}, {"closed", -1}}));
  answer = push(id, rows.line(0, 0).dump() + "\n" + rows.line(1, 1).dump());
  EXPECT_EQ(answer.json.at("duplicate"), 1);
  EXPECT_EQ(answer.json.at("accepted"), 1);
  EXPECT_EQ(answer.json.at("open"), (Json{0, 1}));
  push(id, rows.csv(0, 2), "text/csv");
  answer = push(id, rows.line(1, 0).dump() + "\n" + R"({"k":31,"values":{}})");
  EXPECT_EQ(answer.json.at("late"), 1);
  EXPECT_EQ(answer.json.at("beyond"), 1);
  EXPECT_EQ(answer.json.at("closed"), 1);
  EXPECT_TRUE(eventually([&] { return client_->tick(id) == 1; }));
  EXPECT_EQ(client_->state(id), "running");
  const Json status = client_->get("/api/v1/ingest/" + id).json;
  EXPECT_EQ(status.at("columns"), Json(rows.names));
  EXPECT_EQ(status.at("late"), 1);
  EXPECT_EQ(status.at("waiting"), 0);
}

TEST_F(IngestTest, WhatIsMissingStaysMissingAfterTheDeadline) {
  const Measured rows(33);
  const std::string id = begin_run({{"ingest", {{"deadline", 0.05}}}});
  push(id, rows.csv(0, 2), "text/csv");
  push(id, rows.line(2, 0).dump());
  ASSERT_TRUE(eventually([&] { return client_->tick(id) == 2; }));
  EXPECT_EQ(push(id, rows.line(2, 1).dump()).json.at("late"), 1);
  ASSERT_EQ(client_->patch("/api/v1/runs/" + id, {{"state", "stopped"}}).json.at("state"), "stopped");
  const std::string other =
      rows.names[static_cast<std::size_t>(std::find(rows.node.begin(), rows.node.end(), 1) - rows.node.begin())];
  const Json samples = client_->get("/api/v1/runs/" + id + "/samples?from=2&signals=" + other).json;
  EXPECT_TRUE(samples.at("series").at(0).at("v").at(0).is_null()) << samples.dump();
}

TEST_F(IngestTest, GarbageIsNamedAndChangesNothing) {
  const Measured rows(34);
  const std::string id = begin_run();
  expect_problem(push(id, ""), 400);
  expect_problem(push(id, "nonsense"), 400);
  expect_problem(push(id, R"({"k":0,"values":{"truth.x":NaN}})"), 400);
  expect_problem(push(id, "{\"k\":0,\"values\":{\"truth.x\":\"\xff\"}}"), 400);
  expect_problem(push(id, rows.line(0, 0).dump() + "\n" + R"({"k":0,"values":{"nosuch":1}})"), 422, "/1/values/nosuch");
  expect_problem(push(id, "k,truth.x\n0,inf\n", "text/csv"), 422, "/0/truth.x");
  expect_problem(push(id, "{}", "text/plain"), 415);
  expect_problem(push(id, std::string(9u << 20, ' ')), 413);
  const Json status = client_->get("/api/v1/ingest/" + id).json;
  EXPECT_EQ(status.at("accepted"), 0);
  EXPECT_EQ(status.at("closed"), -1);
  EXPECT_EQ(client_->tick(id), -1);
  EXPECT_EQ(push(id, R"({"k":0,"values":{"truth.x":1e308,"truth.y":-1e308,"truth.theta":0}})").status, 200);
}

TEST_F(IngestTest, OnlyARunThatIsFedTakesRows) {
  const Measured rows(35);
  expect_problem(push("99", rows.line(0, 0).dump()), 404);
  expect_problem(client_->get("/api/v1/ingest/99"), 404);
  const std::string simulated = client_->start({{"scenario", "consensus"}});
  ASSERT_TRUE(client_->reaches(simulated, "finished"));
  expect_problem(push(simulated, rows.line(0, 0).dump()), 409);
  const std::string live = client_->start({{"scenario", "consensus"}, {"pace", 0.01}});
  expect_problem(push(live, rows.line(0, 0).dump()), 409);
  const std::string fed = begin_run();
  push(fed, rows.csv(0, rows.cells.size()), "text/csv");
  ASSERT_TRUE(client_->reaches(fed, "finished"));
  expect_problem(push(fed, rows.line(0, 0).dump()), 409);
}

TEST_F(IngestTest, BadInputsAreNamed) {
  const auto refused = [&](const Json& input, const std::string& pointer) {
    SCOPED_TRACE(input.dump());
    expect_problem(client_->post("/api/v1/runs", {{"scenario", "consensus"}, {"input", input}}), 422, pointer);
  };
  refused("ingestion", "/input");
  refused({{"ingest", 5}}, "/input");
  refused({{"ingest", Json::object()}, {"trace", 1}}, "/input");
  refused({{"ingest", {{"deadline", 0}}}}, "/input/ingest/deadline");
  refused({{"ingest", {{"deadline", "1"}}}}, "/input/ingest/deadline");
  refused({{"ingest", {{"dead", 1}}}}, "/input/ingest/dead");
  refused({{"ingest", {{"columns", "x"}}}}, "/input/ingest/columns");
  refused({{"ingest", {{"columns", {1}}}}}, "/input/ingest/columns/0");
  refused({{"ingest", {{"columns", {"nosuch"}}}}}, "/input/ingest/columns");
}

TEST_F(IngestTest, APausedRunFillsItsRoomAndThenSaysSo) {
  const std::string id = begin_run("ingest", {{"patch", {{"time", {{"steps", nullptr}}}}}});
  ASSERT_EQ(client_->patch("/api/v1/runs/" + id, {{"state", "paused"}}).json.at("state"), "paused");
  const std::int64_t room = client_->get("/api/v1/ingest/" + id).json.at("room");
  std::int64_t k = 0;
  Answer answer;
  for (int call = 0; call < 10; ++call) {
    std::string body;
    for (std::int64_t end = k + room / 2; k < end; ++k)
      body += "{\"k\":" + std::to_string(k) + ",\"values\":{\"truth.x\":1,\"truth.y\":1,\"truth.theta\":0}}\n";
    answer = push(id, body);
    if (answer.status != 200) break;
  }
  expect_problem(answer, 429);
  EXPECT_EQ(answer.header("Retry-After"), "1");
  ASSERT_EQ(client_->patch("/api/v1/runs/" + id, {{"state", "running"}}).json.at("state"), "running");
  EXPECT_TRUE(eventually([&] { return push(id, R"({"k":0,"values":{}})").status == 200; }));
  expect_problem(push(id, R"({"k":5000000,"values":{}})"), 422, "/0/k");
  EXPECT_EQ(client_->patch("/api/v1/runs/" + id, {{"state", "stopped"}}).json.at("state"), "stopped");
}

TEST_F(IngestTest, ItsBundleAndItsForkRepeatItOnItsRows) {
  const Measured rows(36);
  const std::string id = begin_run();
  push(id, rows.csv(0, 10), "text/csv");
  ASSERT_TRUE(eventually([&] { return client_->tick(id) == 9; }));
  ASSERT_EQ(client_
                ->post("/api/v1/runs/" + id + "/attacks",
                       {{"id", "shift"}, {"type", "bias"}, {"on", {"sensor:4"}}, {"params", {{"vector", {30, 12}}}}})
                .status,
            201);
  push(id, rows.csv(10, 25), "text/csv");
  ASSERT_TRUE(eventually([&] { return client_->tick(id) == 24; }));
  ASSERT_EQ(client_->patch("/api/v1/runs/" + id, {{"state", "stopped"}}).json.at("state"), "stopped");
  EXPECT_EQ(client_->get("/api/v1/runs/" + id).json.at("reproducible"), false);

  const Answer bundle = client_->get("/api/v1/runs/" + id + "/bundle");
  ASSERT_EQ(bundle.status, 200) << bundle.body;
  const Answer imported = client_->send("POST", "/api/v1/runs/import", bundle.body);
  ASSERT_EQ(imported.status, 201) << imported.body;
  const std::string copy = imported.json.at("id");
  ASSERT_TRUE(client_->reaches(copy, "stopped"));
  EXPECT_EQ(frames(copy, ""), frames(id, ""));

  const Answer forked = client_->post("/api/v1/runs/" + id + "/fork", {{"k", 8}, {"pace", "max"}});
  ASSERT_EQ(forked.status, 201) << forked.body;
  const std::string branch = forked.json.at("id");
  ASSERT_TRUE(client_->reaches(branch, "finished"));
  EXPECT_EQ(frames(branch, "?signals=lane.*&to=8"), frames(id, "?signals=lane.*&to=8"));
  EXPECT_NE(frames(branch), frames(id)) << "the attack by hand was after the fork";
  EXPECT_EQ(client_->tick(branch), 24);
}

TEST_F(IngestTest, AfterARestartTheRunIsInterruptedOrStoppedAndItsRowsAreThere) {
  const Measured rows(37);
  const std::string id = begin_run();
  push(id, rows.csv(0, 12), "text/csv");
  ASSERT_TRUE(eventually([&] { return client_->tick(id) == 11; }));
  server_.reset();
  begin();
  EXPECT_EQ(client_->state(id), "stopped");
  expect_problem(push(id, rows.line(12, 0).dump()), 409);
  const Answer bundle = client_->get("/api/v1/runs/" + id + "/bundle?frames=false");
  ASSERT_EQ(bundle.status, 200) << bundle.body;
  EXPECT_EQ(bundle.json.at("trace"), rows.csv(0, 12));
}

}  // namespace
}  // namespace vigil::api_test::ingest_test
