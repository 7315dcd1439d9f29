#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::scenarios_test {
namespace {

using ScenariosTest = ApiTest;

TEST_F(ScenariosTest, PresetsAreListedReadAndDescribed) {
  const Json list = client_->get("/api/v1/scenarios").json;
  ASSERT_GE(list.at("items").size(), 4u);
  for (const Json& item : list.at("items")) {
    SCOPED_TRACE(item.dump());
    EXPECT_TRUE(item.at("preset").get<bool>());
    const std::string path = "/api/v1/scenarios/" + item.at("id").get<std::string>();
    const Json document = client_->get(path).json;
    EXPECT_EQ(document.at("id"), item.at("id"));
    const Json schema = client_->get(path + "/schema").json;
    EXPECT_TRUE(schema.at("properties").contains("lanes"));
  }
  const Json registry = client_->get("/api/v1/methods").json;
  EXPECT_FALSE(registry.at("methods").empty());
  EXPECT_FALSE(registry.at("attacks").empty());
}

TEST_F(ScenariosTest, AScenarioOfOnesOwnIsStoredRunAndDeleted) {
  Json document = client_->get("/api/v1/scenarios/consensus").json;
  document["time"]["steps"] = 4;
  const Answer stored = client_->send("PUT", "/api/v1/scenarios/my-own", document.dump());
  ASSERT_EQ(stored.status, 201) << stored.body;
  EXPECT_EQ(stored.json.at("id"), "my-own");
  EXPECT_EQ(client_->send("PUT", "/api/v1/scenarios/my-own", document.dump()).status, 200);
  EXPECT_EQ(client_->get("/api/v1/scenarios/my-own").json.at("time").at("steps"), 4);
  EXPECT_EQ(client_->get("/api/v1/scenarios/my-own/schema").status, 200);
  const std::string run = client_->start({{"scenario", "my-own"}});
  ASSERT_TRUE(client_->reaches(run, "finished"));
  EXPECT_EQ(client_->get("/api/v1/runs?q=scenario:my-own").json.at("items").size(), 1u);
  EXPECT_EQ(client_->remove("/api/v1/scenarios/my-own").status, 204);
  expect_problem(client_->remove("/api/v1/scenarios/my-own"), 404);
  expect_problem(client_->get("/api/v1/scenarios/my-own"), 404);
  expect_problem(client_->get("/api/v1/scenarios/my-own/schema"), 404);
}

TEST_F(ScenariosTest, BadDocumentsAreNamed) {
  const Json good = client_->get("/api/v1/scenarios/consensus").json;
  expect_problem(client_->send("PUT", "/api/v1/scenarios/consensus", good.dump()), 409);
  expect_problem(client_->remove("/api/v1/scenarios/consensus"), 409);
  expect_problem(client_->send("PUT", "/api/v1/scenarios/Bad%20Id", good.dump()), 400);
  expect_problem(client_->send("PUT", "/api/v1/scenarios/mine", "{"), 400);
  expect_problem(client_->send("PUT", "/api/v1/scenarios/mine", "{}"), 422);
  Json wrong = good;
  wrong["lanes"]["consensus"]["params"]["tau"] = -1;
  expect_problem(client_->send("PUT", "/api/v1/scenarios/mine", wrong.dump()), 422, "/lanes/consensus/params/tau");
  wrong = good;
  wrong["adversery"] = Json::object();
  expect_problem(client_->send("PUT", "/api/v1/scenarios/mine", wrong.dump()), 422, "/adversery");
  expect_problem(client_->get("/api/v1/scenarios/mine"), 404);
}

using TracesTest = ApiTest;

constexpr const char* kTrace = "k,t,input.x\n0,0,\n1,1,0.5\n2,2,0.25\n";

TEST_F(TracesTest, ATraceIsStoredOnceListedReadAndDeleted) {
  const Answer made = client_->send("POST", "/api/v1/traces?name=mine", kTrace, "text/csv");
  ASSERT_EQ(made.status, 201) << made.body;
  EXPECT_EQ(made.json.at("rows"), 3);
  EXPECT_EQ(made.json.at("columns"), Json({"input.x"}));
  const std::string path = "/api/v1/traces/" + made.json.at("id").get<std::string>();
  EXPECT_EQ(made.header("Location"), path);
  EXPECT_EQ(client_->send("POST", "/api/v1/traces", kTrace, "text/csv").json.at("id"), made.json.at("id"));
  EXPECT_EQ(client_->get("/api/v1/traces").json.at("items").size(), 1u);
  EXPECT_EQ(client_->get(path).json.at("name"), "mine");
  EXPECT_EQ(client_->get(path, {{"Accept", "text/csv"}}).body, kTrace);
  EXPECT_EQ(client_->remove(path).status, 204);
  expect_problem(client_->get(path), 404);
  expect_problem(client_->remove(path), 404);
}

TEST_F(TracesTest, WhatIsNoTraceIsRefused) {
  for (const char* text : {"", "a,b\n1,2\n", "k,t,x\n0,0\n", "k,t,x\n0,0,abc\n", "k,t,x\n0,0,nan\n",
                           "k,t,x\n0,0,1e999\n", "k,t,x,x\n0,0,1,1\n", "k,t,x\n0,0,1\n2,2,1\n", "k,t,\xff\n0,0,1\n"}) {
    SCOPED_TRACE(text);
    expect_problem(client_->send("POST", "/api/v1/traces", text, "text/csv"), 422);
  }
  expect_problem(client_->send("POST", "/api/v1/traces", "{}", "application/json"), 415);
  expect_problem(client_->send("POST", "/api/v1/traces?name=" + std::string(300, 'n'), kTrace, "text/csv"), 400);
  EXPECT_TRUE(client_->get("/api/v1/traces").json.at("items").empty());
}

TEST_F(TracesTest, FramesOfARunAreATraceWithTheSameLanes) {
  const Json document{{"scenario", "consensus"}, {"seed", 5}, {"patch", {{"time", {{"steps", 12}}}}}};
  const std::string first = client_->start(document);
  ASSERT_TRUE(client_->reaches(first, "finished"));
  const httplib::Headers csv{{"Accept", "text/csv"}};
  const Answer frames = client_->get("/api/v1/runs/" + first + "/samples", csv);
  ASSERT_EQ(frames.status, 200);
  const Answer trace = client_->send("POST", "/api/v1/traces", frames.body, "text/csv");
  ASSERT_EQ(trace.status, 201) << trace.body;
  Json again = document;
  again["input"] = {{"trace", trace.json.at("id")}};
  const std::string second = client_->start(again);
  ASSERT_TRUE(client_->reaches(second, "finished"));
  EXPECT_EQ(client_->get("/api/v1/runs/" + second).json.at("input"), again["input"]);
  const std::string lanes = "/samples?signals=lane.*.estimate.*";
  EXPECT_EQ(client_->get("/api/v1/runs/" + second + lanes, csv).body,
            client_->get("/api/v1/runs/" + first + lanes, csv).body);
}

}  // namespace
}  // namespace vigil::api_test::scenarios_test
