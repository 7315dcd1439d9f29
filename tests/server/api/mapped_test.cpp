// Somebody's own table, its columns mapped to signals, over real sockets.
#include "engine/identify/mapping.hpp"
#include "engine/run/pushed_columns.hpp"
#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::mapped_test {
namespace {

using MappedTest = ApiTest;

constexpr const char* kTable = "when;what,Range A, \"Range B\" ,mood\nmon,1.5,2,good\ntue,,3,bad\nwed,2.5,4e0,none\n";
const Json kMapping{
    {"dt", 0.5}, {"columns", {{"sensor.1.p", "Range A"}, {"sensor.2.p", "Range B"}}}, {"constants", {{"input.u", 7}}}};

TEST_F(MappedTest, AForeignTableIsStoredAsTheCommandLineWritesIt) {
  const Json body{{"csv", kTable}, {"mapping", kMapping}, {"name", "foreign"}};
  const Answer made = client_->post("/api/v1/traces/map", body);
  ASSERT_EQ(made.status, 201) << made.body;
  EXPECT_EQ(made.json.at("name"), "foreign");
  EXPECT_EQ(made.json.at("rows"), 3);
  const std::string path = "/api/v1/traces/" + made.json.at("id").get<std::string>();
  EXPECT_EQ(made.header("Location"), path);
  const std::string text = client_->get(path, {{"Accept", "text/csv"}}).body;
  EXPECT_EQ(text, identify::table_to_trace(kTable, identify::read_mapping(kMapping, "")));
  EXPECT_EQ(text, "k,t,sensor.1.p,sensor.2.p,input.u\n0,0,1.5,2,7\n1,0.5,,3,7\n2,1,2.5,4,7\n");
  EXPECT_EQ(client_->post("/api/v1/traces/map", body).json.at("id"), made.json.at("id"));
}

TEST_F(MappedTest, RefusalsNameLineAndColumnOrThePlaceInTheMapping) {
  const auto refused = [&](const Json& body, const std::string& pointer, const std::string& words) {
    SCOPED_TRACE(body.dump());
    const Answer answer = client_->post("/api/v1/traces/map", body);
    expect_problem(answer, 422, pointer);
    EXPECT_NE(answer.body.find(words), std::string::npos) << answer.body;
  };
  Json mapping = kMapping;
  refused({{"csv", "Range A,Range B\n1,2\n1,x\n"}, {"mapping", mapping}}, "/csv", "line 3: column 2 (Range B)");
  refused({{"csv", "Range A,Range B\n1,2,3\n"}, {"mapping", mapping}}, "/csv", "line 2");
  refused({{"csv", "Range A,Range C\n1,2\n"}, {"mapping", mapping}}, "/csv", "Range C");
  refused({{"csv", "Range A,Range B\n1,1e999\n"}, {"mapping", mapping}}, "/csv", "line 2: column 2");
  refused({{"csv", "Range A,Range B\n"}, {"mapping", mapping}}, "/csv", "no row");
  refused({{"csv", ""}, {"mapping", mapping}}, "/csv", "empty");
  refused({{"csv", kTable}, {"mapping", {{"columns", {{"k", "mood"}}}}}}, "/mapping/columns/k", "sensor.1.y1");
  refused({{"csv", kTable}, {"mapping", {{"columns", Json::object()}}}}, "/mapping/columns", "columns");
  refused({{"csv", kTable}, {"mapping", {{"colums", Json::object()}}}}, "/mapping", "columns");
  refused({{"csv", kTable}, {"mapping", 3}}, "/mapping", "columns");
  refused({{"csv", kTable}}, "/mapping", "missing");
  refused({{"mapping", mapping}}, "/csv", "missing");
  refused({{"csv", 1}, {"mapping", mapping}}, "/csv", "text");
  refused({{"csv", kTable}, {"mapping", mapping}, {"nane", "x"}}, "/nane", "name");
  mapping["constants"]["sensor.1.p"] = 1;
  refused({{"csv", kTable}, {"mapping", mapping}}, "/csv/columns/sensor.1.p", "twice");
  expect_problem(
      client_->post("/api/v1/traces/map", {{"csv", kTable}, {"mapping", kMapping}, {"name", std::string(300, 'n')}}),
      400, "/name");
  expect_problem(client_->send("POST", "/api/v1/traces/map", kTable, "text/csv"), 415);
  EXPECT_TRUE(client_->get("/api/v1/traces").json.at("items").empty());
}

TEST_F(MappedTest, AScenarioSaysWhichColumnsItTakes) {
  for (const char* id : {"consensus", "sparse", "observer-pair", "replay-ubb", "privacy-engine"}) {
    SCOPED_TRACE(id);
    const Answer answer = client_->get("/api/v1/scenarios/" + std::string(id) + "/columns");
    ASSERT_EQ(answer.status, 200) << answer.body;
    const Scenario scenario = Scenario::preset(id);
    EXPECT_EQ(answer.json.at("columns"), pushed_columns(scenario).names);
    EXPECT_EQ(answer.json.at("nodes").size(), scenario.document().at("nodes").size());
    EXPECT_EQ(answer.json.at("lanes").size(), scenario.document().at("lanes").size());
    EXPECT_EQ(answer.json.at("dt"), scenario.document().at("time").at("dt"));
    EXPECT_TRUE(answer.json.at("mapping").is_null());
  }
  Json own = client_->get("/api/v1/scenarios/consensus").json;
  own["view"]["mapping"] = kMapping;
  ASSERT_EQ(client_->send("PUT", "/api/v1/scenarios/mine", own.dump()).status, 201);
  EXPECT_EQ(client_->get("/api/v1/scenarios/mine/columns").json.at("mapping"), kMapping);
  expect_problem(client_->get("/api/v1/scenarios/nothing/columns"), 404);
}

TEST_F(MappedTest, ForksAreFoundByTheirParent) {
  const std::string parent = client_->start({{"scenario", "consensus"}, {"patch", {{"time", {{"steps", 5}}}}}});
  ASSERT_TRUE(client_->reaches(parent, "finished"));
  client_->start({{"scenario", "consensus"}, {"patch", {{"time", {{"steps", 5}}}}}});
  const Answer fork = client_->post("/api/v1/runs/" + parent + "/fork", {{"k", 2}});
  ASSERT_EQ(fork.status, 201) << fork.body;
  const Json found = client_->get("/api/v1/runs?q=parent:" + parent).json.at("items");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.at(0).at("id"), fork.json.at("id"));
  EXPECT_EQ(client_->get("/api/v1/runs?q=parent:null").json.at("items").size(), 2u);
}

}  // namespace
}  // namespace vigil::api_test::mapped_test
