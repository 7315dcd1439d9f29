// Runs fed by topics of a real broker.
#include "tests/server/api/measured.hpp"
#include "tests/server/mqtt/fixture.hpp"

namespace vigil::mqtt_test::plant_test {
namespace {

using api_test::eventually;
using api_test::expect_problem;
using api_test::Measured;

class PlantTest : public MqttTest {
 protected:
  std::string by_http(const Measured& rows) {
    const std::string id = client_->start({{"scenario", "consensus"}, {"seed", 5}, {"input", "ingest"}});
    EXPECT_EQ(client_->send("POST", "/api/v1/ingest/" + id, rows.csv(0, rows.cells.size()), "text/csv").status, 200);
    EXPECT_TRUE(client_->reaches(id, "finished"));
    return frames(id);
  }
  /// One message a value, as a gateway does it.
  void publish_values(const Measured& rows, std::size_t k, const std::string& run) {
    for (std::size_t c = rows.names.size(); c-- > 0;) {  // the truth first
      const double value = rows.cells[k][c];
      const Json message{{"k", k}, {"value", std::isfinite(value) ? Json(value) : Json(nullptr)}};
      const std::string name = rows.names[c];
      const std::size_t dot = name.rfind('.');
      const std::string topic = rows.node[c] < 0
                                    ? "plant/" + run + "/signal/x/" + name
                                    : "plant/" + run + "/" + name.substr(7, dot - 7) + "/" + name.substr(dot + 1);
      ASSERT_TRUE(plant_.publish(topic, message.dump()));
    }
  }
};

TEST_F(PlantTest, TheSameRowsGiveTheSameSamplesAsOverHttp) {
  const Measured rows(41);
  const std::string expected = by_http(rows);
  ASSERT_GT(expected.size(), 1000u);

  const std::string by_row = begin_run("line1");
  for (std::size_t k = 0; k < rows.cells.size(); ++k) {
    for (int who = -1; who < static_cast<int>(rows.nodes.size()); ++who)
      ASSERT_TRUE(plant_.publish("plant/line1/rows", rows.line(k, who).dump()));
  }
  ASSERT_TRUE(client_->reaches(by_row, "finished")) << link();
  EXPECT_EQ(frames(by_row), expected);

  const std::string by_table = begin_run("line2");
  ASSERT_TRUE(plant_.publish("plant/" + by_table + "/rows", rows.csv(0, rows.cells.size()))) << "by its id";
  ASSERT_TRUE(client_->reaches(by_table, "finished"));
  EXPECT_EQ(frames(by_table), expected);

  const std::string by_value = begin_run("line3");
  for (std::size_t k = 0; k < rows.cells.size(); ++k) publish_values(rows, k, "line3");
  ASSERT_TRUE(client_->reaches(by_value, "finished")) << link();
  EXPECT_EQ(frames(by_value), expected);
  EXPECT_EQ(link().at("refused"), 0) << link();
}

TEST_F(PlantTest, TwoRunsOfOneNameHearTheSame) {
  const Measured rows(42);
  const std::string first = begin_run("line"), second = begin_run("line");
  ASSERT_TRUE(plant_.publish("plant/line/rows", rows.csv(0, rows.cells.size())));
  ASSERT_TRUE(client_->reaches(first, "finished"));
  ASSERT_TRUE(client_->reaches(second, "finished"));
  EXPECT_EQ(frames(first), frames(second));
  EXPECT_EQ(client_->get("/api/v1/runs/" + first).json.at("input").at("ingest").at("mqtt").at("name"), "line");
}

TEST_F(PlantTest, GarbageIsCountedWithItsReasonAndHurtsNobody) {
  const Measured rows(43);
  const std::string id = begin_run("line");
  const std::string bad[] = {"",
                             "nonsense",
                             "{",
                             "{\"k\":0}",
                             "{\"k\":-1,\"values\":{}}",
                             "[1]",
                             std::string(100'000, '['),
                             std::string("\xff\xfe\0x", 4),
                             R"({"k":0,"values":{"nosuch":1}})",
                             "k,truth.x\n0,inf\n"};
  for (const std::string& payload : bad) ASSERT_TRUE(plant_.publish("plant/line/rows", payload));
  ASSERT_TRUE(plant_.publish("plant/line/1/nosuch", R"({"k":0,"value":1})"));
  ASSERT_TRUE(plant_.publish("plant/line/1/p", "12.5")) << "says no tick";
  ASSERT_TRUE(plant_.publish("plant/nobody/rows", rows.csv(0, 2)));
  ASSERT_TRUE(eventually([&] { return link().at("received") == 13; })) << link();
  ASSERT_TRUE(eventually([&] { return link().at("refused") == 12; })) << link();
  EXPECT_TRUE(eventually([&] { return link().at("no_run") == 1; }));
  const Json status = client_->get("/api/v1/ingest/" + id).json;
  EXPECT_EQ(status.at("refused").at("messages"), 12);
  EXPECT_EQ(status.at("refused").at("newest").size(), 5u);
  EXPECT_NE(status.at("refused").at("newest").back().get<std::string>().find("no k"), std::string::npos);
  EXPECT_EQ(status.at("accepted"), 0);
  ASSERT_TRUE(plant_.publish("plant/line/rows", rows.csv(0, rows.cells.size())));
  EXPECT_TRUE(client_->reaches(id, "finished"));
}

TEST_F(PlantTest, ARunThatIsBehindWaitsWithoutHoldingOthersUp) {
  const Measured rows(44);
  const std::string paused = begin_run("slow", {{"patch", {{"time", {{"steps", nullptr}}}}}});
  ASSERT_EQ(client_->patch("/api/v1/runs/" + paused, {{"state", "paused"}}).json.at("state"), "paused");
  const std::int64_t room = client_->get("/api/v1/ingest/" + paused).json.at("room"), last = room + 500;
  std::string table = "k,truth.x,truth.y,truth.theta";
  for (std::size_t c = 0; c < rows.names.size(); ++c)
    if (rows.node[c] >= 0) table += "," + rows.names[c];
  const auto line = [&](std::int64_t k) {
    std::string text = "\n" + std::to_string(k) + ",1,1,0";
    for (std::size_t c = 0; c < rows.names.size(); ++c)
      if (rows.node[c] >= 0) text += ",1";
    return text;
  };
  for (std::int64_t k = 0; k <= last; k += 50) {
    std::string body = table;
    for (std::int64_t at = k; at < std::min(k + 50, last + 1); ++at) body += line(at);
    ASSERT_TRUE(plant_.publish("plant/slow/rows", body));
  }
  ASSERT_TRUE(eventually([&] { return link().at("behind") == Json{paused}; })) << link();
  const std::string other = begin_run("quick");
  ASSERT_TRUE(plant_.publish("plant/quick/rows", rows.csv(0, rows.cells.size())));
  EXPECT_TRUE(client_->reaches(other, "finished"));
  ASSERT_EQ(client_->patch("/api/v1/runs/" + paused, {{"state", "running"}}).json.at("state"), "running");
  EXPECT_TRUE(eventually([&] { return client_->tick(paused) == last; })) << client_->tick(paused) << link();
  EXPECT_TRUE(eventually([&] { return link().at("behind").empty() && link().at("waiting_bytes") == 0; })) << link();
}

TEST_F(PlantTest, ValuesWithoutTicksAreSampledAtTheirArrival) {
  const std::string id = begin_run({{"name", "line"}, {"clock", "arrival"}, {"hold", 1000}},
                                   {{"patch", {{"time", {{"dt", 0.05}, {"steps", 20}}}}}});
  const std::string node = client_->get("/api/v1/ingest/" + id).json.at("nodes").at(0);
  for (const char* state : {"truth.x", "truth.y", "truth.theta"})
    ASSERT_TRUE(plant_.publish(std::string("plant/line/signal/x/") + state, "100"));
  ASSERT_TRUE(plant_.publish("plant/line/" + node + "/p", "7.5"));
  ASSERT_TRUE(client_->reaches(id, "finished")) << client_->get("/api/v1/ingest/" + id).body;
  const Json samples = client_->get("/api/v1/runs/" + id + "/samples?from=2&signals=sensor." + node + ".p").json;
  EXPECT_EQ(samples.at("series").at(0).at("v").back(), 7.5) << samples.dump();
}

TEST_F(PlantTest, ARedeliveredMessageIsADuplicate) {
  const Measured rows(45);
  const std::string id = begin_run("line");
  for (int times = 0; times < 3; ++times) {
    ASSERT_TRUE(plant_.publish("plant/line/rows", rows.line(0, 0).dump()));
    ASSERT_TRUE(plant_.publish("plant/line/" + rows.nodes[1] + "/p", R"({"k":0,"value":1})"));
  }
  ASSERT_TRUE(eventually([&] { return client_->get("/api/v1/ingest/" + id).json.at("duplicate") == 4; }));
  EXPECT_EQ(client_->get("/api/v1/ingest/" + id).json.at("accepted"), 2);
}

class NarrowInbox : public PlantTest {
 protected:
  NarrowInbox() {
    inbox_.full = 256u << 10;
    inbox_.low = 64u << 10;
  }
};

TEST_F(NarrowInbox, WhatDoesNotFitIsLeftWithTheBrokerAndComesLater) {
  const std::string id = begin_run("line", {{"patch", {{"time", {{"steps", nullptr}}}}}});
  ASSERT_EQ(client_->patch("/api/v1/runs/" + id, {{"state", "paused"}}).json.at("state"), "paused");
  const std::int64_t room = client_->get("/api/v1/ingest/" + id).json.at("room"), last = room + 4000;
  const Json nodes = client_->get("/api/v1/ingest/" + id).json.at("nodes");
  for (std::int64_t k = 0; k <= last; ++k) {
    std::string body = "{\"k\":" + std::to_string(k) + ",\"values\":{\"truth.x\":1,\"truth.y\":1,\"truth.theta\":0}}\n";
    for (const Json& node : nodes) body += Json{{"k", k}, {"node", node}, {"values", Json::object()}}.dump() + "\n";
    ASSERT_TRUE(plant_.publish("plant/line/rows", body));
  }
  ASSERT_TRUE(plant_.settle());
  ASSERT_TRUE(eventually([&] { return link().at("broker").at("held") == true; })) << link();
  EXPECT_LT(link().at("waiting_bytes"), 4u << 20);
  EXPECT_LT(link().at("received"), last) << "the others are with the broker";
  ASSERT_EQ(client_->patch("/api/v1/runs/" + id, {{"state", "running"}}).json.at("state"), "running");
  EXPECT_TRUE(eventually([&] { return client_->tick(id) == last; })) << client_->tick(id) << link();
  EXPECT_EQ(link().at("broker").at("held"), false);
  const Json status = client_->get("/api/v1/ingest/" + id).json;
  EXPECT_EQ(status.at("accepted"), (last + 1) * static_cast<std::int64_t>(nodes.size() + 1)) << status;
}

class WithoutTopics : public api_test::ApiTest {};

TEST_F(WithoutTopics, ARunThatWantsThemIsRefused) {
  expect_problem(
      client_->post("/api/v1/runs", {{"scenario", "consensus"}, {"input", {{"ingest", {{"mqtt", "line"}}}}}}), 422,
      "/input/ingest/mqtt");
  EXPECT_TRUE(client_->get("/api/v1/ingest").json.at("broker").is_null());
  EXPECT_TRUE(client_->get("/api/v1/server").json.at("mqtt").is_null());
}

}  // namespace
}  // namespace vigil::mqtt_test::plant_test
