#include <csignal>
#include <cstdlib>
#include <fstream>

#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::serve_test {
namespace {

TEST(Serve, SaysWhereItListensAndEndsCleanly) {
  const TemporaryFolder folder;
  ServerProcess server({"--db", folder.file("log.db")});
  EXPECT_EQ(server.first_line(),
            "vigil " + std::string(version()) + " listening on http://127.0.0.1:" + std::to_string(server.port()));
  const Client client(server.port());
  EXPECT_FALSE(client.get("/api/v1/server").json.at("demo").is_null());
  const std::string id =
      client.start({{"scenario", "consensus"}, {"pace", 20}, {"patch", {{"time", {{"steps", nullptr}}}}}});
  ASSERT_TRUE(eventually([&] { return client.tick(id) > 2; }));
  EXPECT_EQ(server.end(SIGTERM), 0);
  const LogReader reader(folder.file("log.db"));
  const auto row = reader.run(std::stoll(id));
  ASSERT_TRUE(row.has_value());
  EXPECT_EQ(row->state, "stopped");
  EXPECT_FALSE(row->metrics.empty());
  EXPECT_EQ(vigil_command({"db", "check", "--db", folder.file("log.db")}).code, 0);
}

TEST(Serve, InterruptEndsItToo) {
  const TemporaryFolder folder;
  ServerProcess server({"--db", folder.file("log.db"), "--no-demo"});
  EXPECT_TRUE(Client(server.port()).get("/api/v1/server").json.at("demo").is_null());
  EXPECT_EQ(server.end(SIGINT), 0);
}

TEST(Serve, APortOrLogInUseIsSaidInOneSentence) {
  const TemporaryFolder folder;
  ServerProcess server({"--db", folder.file("log.db"), "--no-demo"});
  const Outcome port =
      vigil_command({"serve", "--port", std::to_string(server.port()), "--db", folder.file("other.db"), "--no-demo"});
  EXPECT_EQ(port.code, 2) << port.error;
  EXPECT_EQ(port.output, "");
  const Outcome log = vigil_command({"serve", "--port", "0", "--db", folder.file("log.db")});
  EXPECT_EQ(log.code, 2) << log.error;
  EXPECT_NE(log.error.find("log.db"), std::string::npos) << log.error;
}

TEST(Serve, ATokenOpensOtherHosts) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("token")) << "0123456789abcdef0123\n";
  std::ofstream(folder.file("short")) << "abc\n";
  EXPECT_EQ(
      vigil_command({"serve", "--port", "0", "--db", folder.file("x.db"), "--token-file", folder.file("short")}).code,
      2);
  ServerProcess server({"--host", "0.0.0.0", "--db", folder.file("log.db"), "--token-file", folder.file("token")});
  const Client client(server.port());
  EXPECT_EQ(client.get("/api/v1/server").status, 401);
  EXPECT_EQ(client.get("/api/v1/server", {{"Authorization", "Bearer 0123456789abcdef0123"}}).status, 200);
  EXPECT_EQ(server.end(SIGTERM), 0);
}

/// What a server had acknowledged before it was killed.
struct Acknowledged {
  std::string run, key;
  std::size_t commands = 0;
};

Acknowledged work(const Client& client, int round) {
  Acknowledged done;
  done.key = "key-" + std::to_string(round);
  const Json body{
      {"scenario", "consensus"}, {"seed", round}, {"pace", 300}, {"patch", {{"time", {{"steps", nullptr}}}}}};
  done.run = client.post("/api/v1/runs", body, {{"Idempotency-Key", done.key}}).json.at("id");
  EXPECT_TRUE(eventually([&] { return client.tick(done.run) > 5 * (round % 7); }));
  for (int i = 0; i < 1 + round % 3; ++i) {
    const Answer answer =
        client.patch("/api/v1/runs/" + done.run, {{"params", {{"lanes.consensus.params.tau", 0.01 + 0.001 * i}}}});
    if (answer.status == 200) ++done.commands;
  }
  return done;
}

TEST(Serve, AKillLosesNothingThatWasAcknowledged) {
  const TemporaryFolder folder;
  const std::string db = folder.file("log.db");
  const int rounds = std::getenv("VIGIL_FULL") != nullptr ? 50 : 5;
  std::vector<Acknowledged> all;
  for (int round = 1; round <= rounds; ++round) {
    SCOPED_TRACE(round);
    ServerProcess server({"--db", db, "--no-demo"});
    const Client client(server.port());
    for (const Acknowledged& earlier : all) {
      const Json run = client.get("/api/v1/runs/" + earlier.run).json;
      ASSERT_TRUE(run.is_object());
      EXPECT_EQ(run.at("state"), "interrupted");
      EXPECT_EQ(run.at("commands").size(), earlier.commands);
    }
    if (!all.empty()) {
      const Json same{
          {"scenario", "consensus"}, {"seed", round - 1}, {"pace", 300}, {"patch", {{"time", {{"steps", nullptr}}}}}};
      EXPECT_EQ(client.post("/api/v1/runs", same, {{"Idempotency-Key", all.back().key}}).json.at("id"), all.back().run);
    }
    all.push_back(work(client, round));
    EXPECT_EQ(server.end(SIGKILL), 128 + SIGKILL);
    const Outcome check = vigil_command({"db", "check", "--db", db});
    EXPECT_EQ(check.code, 0) << check.output << check.error;
  }
}

}  // namespace
}  // namespace vigil::api_test::serve_test
