/// A server whose campaigns are made by workers.
#include "tests/server/cli/command.hpp"
#include "tests/server/nats/processes.hpp"

namespace vigil::api_test::serve_test {
namespace {

Answer post(const Client& client, const Json& body) { return client.send("POST", "/api/v1/campaigns", body.dump()); }

TEST(ServeWithoutABroker, RefusesWorkers) {
  const TemporaryFolder folder;
  const ServerProcess server({"--db", folder.file("a.db"), "--no-demo"});
  const Client client(server.port());
  const Answer refused = post(client, {{"scenario", "consensus"}, {"runs", 2}, {"crew", "workers"}});
  EXPECT_EQ(refused.status, 422);
  EXPECT_EQ(refused.json["errors"][0]["pointer"], "/crew");
  EXPECT_EQ(post(client, {{"scenario", "consensus"}, {"runs", 2}, {"crew", "elves"}}).status, 422);
  EXPECT_TRUE(client.get("/api/v1/server").json["nats"].is_null());
  EXPECT_EQ(post(client, {{"scenario", "consensus"}, {"runs", 2}, {"crew", "threads"}}).json["crew"], "threads");
}

TEST(ServeWithABroker, WorkersGiveWhatThreadsGive) {
  if (const std::string why = BrokerProcess::missing(); !why.empty()) GTEST_SKIP() << why;
  BrokerProcess broker;
  const auto first = start_worker(broker, "first"), second = start_worker(broker, "second");
  const ServerProcess server({"--db", broker.folder().file("a.db"), "--no-demo", "--nats", broker.url()});
  const Client client(server.port());
  EXPECT_TRUE(eventually([&] { return client.get("/api/v1/server").json["nats"]["connected"] == true; }));
  Json answers[2];
  for (int i = 0; i < 2; ++i) {
    const char* crew = i == 0 ? "threads" : "workers";
    const Answer made = post(client, {{"scenario", "consensus"}, {"runs", 60}, {"crew", crew}});
    ASSERT_EQ(made.status, 202) << made.body;
    const std::string address = made.header("Location");
    ASSERT_TRUE(eventually([&] { return client.get(address).json["state"] == "finished"; }))
        << client.get(address).body;
    answers[i] = client.get(address).json;
    EXPECT_EQ(answers[i]["crew"], crew);
    EXPECT_EQ(answers[i]["workers"].size(), i == 0 ? 0U : 2U) << answers[i]["workers"];
    answers[i] = client.get(address + "/cells/0").json;
  }
  EXPECT_EQ(answers[0].dump(), answers[1].dump());
}

TEST(ServeWithABroker, ACampaignOfWorkersIsPausedAndGoesOnWithoutThem) {
  if (const std::string why = BrokerProcess::missing(); !why.empty()) GTEST_SKIP() << why;
  BrokerProcess broker;
  const auto worker = start_worker(broker, "slow", {"VIGIL_TRIAL_SLEEP_MS=20"});
  const ServerProcess server({"--db", broker.folder().file("a.db"), "--no-demo", "--nats", broker.url()});
  const Client client(server.port());
  const std::string address =
      post(client, {{"scenario", "consensus"}, {"runs", 300}, {"crew", "workers"}}).header("Location");
  const auto done = [&] { return client.get(address).json["progress"]["done"].get<int>(); };
  ASSERT_TRUE(eventually([&] { return done() > 20; }));
  const Answer paused = client.send("PATCH", address, R"({"state":"paused"})");
  EXPECT_EQ(paused.json["state"], "paused") << paused.body;
  const int there = done();
  EXPECT_EQ(client.send("PATCH", address, R"({"state":"running"})").status, 200);
  ASSERT_TRUE(eventually([&] { return done() > there; }));
  EXPECT_EQ(client.send("PATCH", address, R"({"state":"cancelled"})").json["state"], "cancelled");
}

}  // namespace
}  // namespace vigil::api_test::serve_test
