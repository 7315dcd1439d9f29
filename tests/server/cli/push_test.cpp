// `vigil push` against a real server, and what a killed one leaves of a run that was pushed into.
#include <csignal>
#include <fstream>

#include "engine/run/frame_csv.hpp"
#include "tests/engine/runs/capture.hpp"
#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::push_test {
namespace {

class PushTest : public ::testing::Test {
 protected:
  PushTest() {
    vigil::Run run(Scenario::preset("consensus"), {41, nullptr, {}});
    vigil::test::Capture capture;
    vigil::test::run_to_end(run, capture);
    std::ofstream(folder_.file("frames.csv")) << vigil::test::csv_of(run.catalogue(), capture.frames);
  }
  std::vector<std::string> serve() const { return {"--no-demo", "--db", folder_.file("vigil.db")}; }
  Outcome push(const ServerProcess& server, const std::string& id, const std::string& file) const {
    return vigil_command({"push", id, file, "--server", "http://127.0.0.1:" + std::to_string(server.port())});
  }
  static std::string feed(const Client& client, const Json& steps = 30) {
    return client.start({{"scenario", "consensus"}, {"input", "ingest"}, {"patch", {{"time", {{"steps", steps}}}}}});
  }
  TemporaryFolder folder_;
};

TEST_F(PushTest, AFrameFileIsPushedWhole) {
  const ServerProcess server(serve());
  const Client client(server.port());
  const std::string id = feed(client);
  const Outcome outcome = push(server, id, folder_.file("frames.csv"));
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const Json total = Json::parse(outcome.output);
  EXPECT_EQ(total.at("accepted"), 31);
  EXPECT_EQ(total.at("closed"), 30);
  EXPECT_TRUE(client.reaches(id, "finished"));
}

TEST_F(PushTest, WhatIsWrongIsSaidInOneSentence) {
  const ServerProcess server(serve());
  const Client client(server.port());
  const std::string id = feed(client);
  const auto refused = [&](const std::string& run, const std::string& file) {
    const Outcome outcome = push(server, run, file);
    EXPECT_EQ(outcome.code, 2) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  };
  refused("99", folder_.file("frames.csv"));
  refused("x", folder_.file("frames.csv"));
  refused(id, folder_.file("nothing.csv"));
  std::ofstream(folder_.file("other.csv")) << "k,t,temperature\n0,0,1\n";
  refused(id, folder_.file("other.csv"));
  std::ofstream(folder_.file("bad.csv")) << "k,t,truth.x\n0,0,nan\n";
  refused(id, folder_.file("bad.csv"));
}

TEST_F(PushTest, AKilledServerLeavesAnInterruptedRunWithItsRows) {
  std::string id;
  {
    ServerProcess server(serve());
    const Client client(server.port());
    id = feed(client, 1000);
    ASSERT_EQ(push(server, id, folder_.file("frames.csv")).code, 0);
    ASSERT_TRUE(eventually([&] {
      const Json k = client.get("/api/v1/runs/" + id + "/samples?signals=truth.x").json.at("k");
      return k.size() == 31;
    }));
    server.end(SIGKILL);
  }
  const ServerProcess server(serve());
  const Client client(server.port());
  EXPECT_EQ(client.state(id), "interrupted");
  const Answer bundle = client.get("/api/v1/runs/" + id + "/bundle?frames=false");
  ASSERT_EQ(bundle.status, 200) << bundle.body;
  const Answer again = client.send("POST", "/api/v1/runs/import", bundle.body);
  ASSERT_EQ(again.status, 201) << again.body;
  EXPECT_TRUE(client.reaches(again.json.at("id"), "stopped"));
}

}  // namespace
}  // namespace vigil::api_test::push_test
