#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::runs_test {
namespace {

using RunsTest = ApiTest;

TEST_F(RunsTest, ARunFinishesAndIsFoundAgain) {
  const Answer made =
      client_->post("/api/v1/runs", {{"scenario", "consensus"}, {"seed", 7}, {"tags", {"a", "b"}}, {"note", "first"}});
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string id = made.json.at("id");
  EXPECT_EQ(made.header("Location"), "/api/v1/runs/" + id);
  ASSERT_TRUE(client_->reaches(id, "finished"));
  const Json run = client_->get("/api/v1/runs/" + id).json;
  EXPECT_EQ(run.at("seed"), 7);
  EXPECT_EQ(run.at("pace"), "max");
  EXPECT_EQ(run.at("input"), "simulate");
  EXPECT_EQ(run.at("tags"), Json({"a", "b"}));
  EXPECT_EQ(run.at("progress").at("k"), 30);
  EXPECT_EQ(run.at("progress").at("steps"), 30);
  EXPECT_FALSE(run.at("metrics").empty());
  EXPECT_FALSE(run.at("world").at("links").empty());
  EXPECT_TRUE(run.at("design").is_object());
  EXPECT_TRUE(run.at("error").is_null());
  EXPECT_FALSE(run.at("ended").is_null());
  const Json list = client_->get("/api/v1/runs?q=seed:7").json;
  ASSERT_EQ(list.at("items").size(), 1u);
  EXPECT_EQ(list.at("items")[0].at("id"), id);
  for (const Json& metric : list.at("items")[0].at("metrics")) EXPECT_TRUE(metric.at("node").is_null());
  EXPECT_FALSE(list.at("items")[0].contains("document"));
}

// Of a fusion lane the design says where covariances stand: at the end of a run at its last tick, in the answer and in
// the log.
TEST_F(RunsTest, AFinishedRunsDesignIsThatOfItsLastTick) {
  const std::string id = client_->start({{"scenario", "privacy-engine"}, {"patch", {{"time", {{"steps", 100}}}}}});
  ASSERT_TRUE(client_->reaches(id, "finished"));
  const Json design = client_->get("/api/v1/runs/" + id).json.at("design").at("two_step");
  EXPECT_NEAR(design.at("trace_legitimate").get<double>(), .0127116, 5e-8);
  EXPECT_NEAR(design.at("trace_eavesdropper").at("differencing").get<double>(), .35644, 5e-6);
}

TEST_F(RunsTest, APatchAndAWholeDocumentAreTaken) {
  const std::string id = client_->start({{"scenario", "consensus"}, {"patch", {{"time", {{"steps", 5}}}}}});
  ASSERT_TRUE(client_->reaches(id, "finished"));
  const Json document = client_->get("/api/v1/runs/" + id).json.at("document");
  EXPECT_EQ(document.at("time").at("steps"), 5);
  const std::string again = client_->start({{"scenario", document}});
  ASSERT_TRUE(client_->reaches(again, "finished"));
  EXPECT_EQ(client_->tick(again), 5);
}

struct Bad {
  const char* body;
  int status;
  const char* pointer;
};

TEST_F(RunsTest, BadBodiesGetOneClearProblem) {
  const Bad all[] = {
      {"{", 400, ""},
      {"[]", 400, ""},
      {"", 400, ""},
      {"null", 400, ""},
      {R"({"scenario":"consensus","scenario":"consensus"})", 400, ""},
      {R"({"scenario":"consensus","seed":1e999})", 400, ""},
      {R"({"scenario":"consensus","seed":NaN})", 400, ""},
      {"{\"scenario\":\"\xff\xfe\"}", 400, ""},
      {"{}", 422, "/scenario"},
      {R"({"scenario":"consensu"})", 422, "/scenario"},
      {R"({"scenario":5})", 422, "/scenario"},
      {R"({"scenario":null})", 422, "/scenario"},
      {R"({"scenario":{}})", 422, ""},
      {R"({"scenario":"consensus","sed":1})", 422, "/sed"},
      {R"({"scenario":"consensus","seed":-1})", 422, "/seed"},
      {R"({"scenario":"consensus","seed":1.5})", 422, "/seed"},
      {R"({"scenario":"consensus","seed":"1"})", 422, "/seed"},
      {R"({"scenario":"consensus","seed":18446744073709551615})", 422, "/seed"},
      {R"({"scenario":"consensus","pace":0})", 422, "/pace"},
      {R"({"scenario":"consensus","pace":"fast"})", 422, "/pace"},
      {R"({"scenario":"consensus","pace":1e300})", 422, "/pace"},
      {R"({"scenario":"consensus","pace":null})", 422, "/pace"},
      {R"({"scenario":"consensus","tags":"a"})", 422, "/tags"},
      {R"({"scenario":"consensus","tags":[1]})", 422, "/tags"},
      {R"({"scenario":"consensus","tags":[""]})", 422, "/tags"},
      {R"({"scenario":"consensus","note":5})", 422, "/note"},
      {R"({"scenario":"consensus","patch":[]})", 422, "/patch"},
      {R"({"scenario":"consensus","patch":{"lane":{}}})", 422, "/patch/lane"},
      {R"({"scenario":"consensus","patch":{"time":{"steps":-3}}})", 422, "/patch/time/steps"},
      {R"({"scenario":"consensus","patch":{"lanes":{"consensus":{"params":{"tau":"x"}}}}})", 422,
       "/patch/lanes/consensus/params/tau"},
      {R"({"scenario":"consensus","webhook":"http://localhost/"})", 422, "/webhook"},
      {R"({"scenario":"consensus","input":{"trace":"99"}})", 422, "/input/trace"},
      {R"({"scenario":"consensus","input":{"trace":-1}})", 422, "/input/trace"},
      {R"({"scenario":"consensus","input":{"track":1}})", 422, "/input"},
  };
  for (const Bad& bad : all) {
    SCOPED_TRACE(bad.body);
    expect_problem(client_->send("POST", "/api/v1/runs", bad.body), bad.status, bad.pointer);
  }
  EXPECT_TRUE(client_->get("/api/v1/runs").json.at("items").empty());
}

TEST_F(RunsTest, DeepAndLargeBodiesAreRefused) {
  expect_problem(client_->send("POST", "/api/v1/runs", std::string(50'000, '[')), 400);
  std::string deep = R"({"scenario":"consensus","patch":)";
  for (int i = 0; i < 90; ++i) deep += R"({"a":)";
  deep += "1" + std::string(90, '}') + "}";
  const Answer answer = client_->send("POST", "/api/v1/runs", deep);
  EXPECT_TRUE(answer.status == 400 || answer.status == 422) << answer.status;
  expect_problem(client_->send("POST", "/api/v1/runs", std::string(20u << 20, ' ')), 413);
  expect_problem(client_->send("POST", "/api/v1/runs", R"({"scenario":"consensus"})", "text/plain"), 415);
  const std::string longest(5000, 'x');
  expect_problem(client_->post("/api/v1/runs", {{"scenario", "consensus"}, {"note", longest}}), 422);
  expect_problem(client_->post("/api/v1/runs", {{"scenario", "consensus"}, {"tags", {longest}}}), 422);
}

TEST_F(RunsTest, UnknownRunsAndPathsAreNotFound) {
  for (const char* path :
       {"/api/v1/runs/99", "/api/v1/runs/abc", "/api/v1/runs/-1", "/api/v1/runs/99999999999999999999999",
        "/api/v1/runs/99/signals", "/api/v1/runs/99/samples", "/api/v1/runs/99/marks", "/api/v1/runs/99/bundle",
        "/api/v1/runs/99/stream", "/api/v1/nothing", "/api/v2/runs"}) {
    SCOPED_TRACE(path);
    expect_problem(client_->get(path), 404);
  }
  expect_problem(client_->remove("/api/v1/runs/99"), 404);
  expect_problem(client_->patch("/api/v1/runs/99", {{"note", "x"}}), 404);
  expect_problem(client_->patch("/api/v1/runs/99", {{"state", "paused"}}), 404);
  expect_problem(client_->post("/api/v1/runs/99/fork", {{"k", 1}}), 404);
  expect_problem(client_->post("/api/v1/runs/99/attacks", {{"type", "dos"}}), 404);
  expect_problem(client_->send("PUT", "/api/v1/runs", "{}"), 405);
}

TEST_F(RunsTest, TheSameKeyStartsOneRun) {
  const Json body{{"scenario", "consensus"}, {"seed", 3}};
  const Answer first = client_->post("/api/v1/runs", body, {{"Idempotency-Key", "k1"}});
  ASSERT_EQ(first.status, 201) << first.body;
  const Answer second = client_->post("/api/v1/runs", body, {{"Idempotency-Key", "k1"}});
  EXPECT_EQ(second.status, 201);
  EXPECT_EQ(second.json.at("id"), first.json.at("id"));
  EXPECT_EQ(second.header("Idempotency-Replayed"), "true");
  expect_problem(client_->post("/api/v1/runs", {{"scenario", "consensus"}, {"seed", 4}}, {{"Idempotency-Key", "k1"}}),
                 422);
  expect_problem(client_->post("/api/v1/runs", body, {{"Idempotency-Key", std::string(300, 'k')}}), 400);
  EXPECT_EQ(client_->get("/api/v1/runs").json.at("items").size(), 1u);
}

TEST_F(RunsTest, ListsArePagedSortedAndFiltered) {
  for (int seed = 1; seed <= 5; ++seed) {
    const std::string id =
        client_->start({{"scenario", "consensus"}, {"seed", seed}, {"patch", {{"time", {{"steps", 2}}}}}});
    ASSERT_TRUE(client_->reaches(id, "finished"));
  }
  std::vector<int> seeds;
  std::string cursor;
  do {
    const Json page = client_->get("/api/v1/runs?limit=2&sort=seed" + (cursor.empty() ? "" : "&cursor=" + cursor)).json;
    for (const Json& item : page.at("items")) seeds.push_back(item.at("seed"));
    cursor = page.at("next").is_null() ? "" : page.at("next").get<std::string>();
  } while (!cursor.empty());
  EXPECT_EQ(seeds, (std::vector<int>{1, 2, 3, 4, 5}));
  EXPECT_EQ(client_->get("/api/v1/runs").json.at("items")[0].at("seed"), 5);
  EXPECT_EQ(client_->get("/api/v1/runs?q=seed:2..3%20OR%20seed:5").json.at("items").size(), 3u);
  EXPECT_EQ(client_->get("/api/v1/runs?q=state:finished%20AND%20seed%3E4").json.at("items").size(), 1u);
  for (const char* query :
       {"q=seed:", "q=(", "q=nosuchfield:1", "limit=0", "limit=x", "limit=100000", "cursor=zzz", "sort=nosuch"}) {
    SCOPED_TRACE(query);
    expect_problem(client_->get(std::string("/api/v1/runs?") + query), 400);
  }
}

TEST_F(RunsTest, ADeletedRunIsGone) {
  const std::string done = client_->start({{"scenario", "consensus"}});
  ASSERT_TRUE(client_->reaches(done, "finished"));
  EXPECT_EQ(client_->remove("/api/v1/runs/" + done).status, 204);
  EXPECT_EQ(client_->get("/api/v1/runs/" + done).status, 404);
  const std::string live = client_->start({{"scenario", "consensus"}, {"pace", 1}});
  ASSERT_TRUE(client_->reaches(live, "running"));
  EXPECT_EQ(client_->remove("/api/v1/runs/" + live).status, 204);
  EXPECT_EQ(client_->get("/api/v1/runs/" + live).status, 404);
  EXPECT_TRUE(eventually([&] { return client_->get("/api/v1/server").json.at("runs").at("running") == 0; }));
}

}  // namespace
}  // namespace vigil::api_test::runs_test
