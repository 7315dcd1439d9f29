// `vigil attack`, `tune`, `fork` and `bundle` against a real server.
#include <fstream>

#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::hands_test {
namespace {

class HandsTest : public ::testing::Test {
 protected:
  HandsTest() : server_({"--no-demo", "--db", folder_.file("vigil.db")}), client_(server_.port()) {}
  Outcome hand(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--server", "http://127.0.0.1:" + std::to_string(server_.port())});
    return vigil_command(arguments);
  }
  Json run(const std::string& id) const { return client_.get("/api/v1/runs/" + id).json; }
  /// An endless run that has made some ticks.
  std::string endless() const {
    const std::string id = client_.start(
        {{"scenario", "consensus"}, {"seed", 5}, {"pace", 100}, {"patch", {{"time", {{"steps", nullptr}}}}}});
    EXPECT_TRUE(eventually([&] { return client_.tick(id) >= 3; }));
    return id;
  }
  TemporaryFolder folder_;
  ServerProcess server_;
  Client client_;
};

TEST_F(HandsTest, AttackTuneForkAndTakeAwayWhatRunsAgain) {
  const std::string id = endless();
  const Outcome started = hand({"attack", id, "--type", "dos", "--on", "link:2-3", "--on", "sensor:1", "--id", "jam"});
  ASSERT_EQ(started.code, 0) << started.error;
  EXPECT_EQ(Json::parse(started.output).at("id"), "jam");
  ASSERT_EQ(hand({"tune", id, "lanes.consensus.params.tau=0.03"}).code, 0);
  ASSERT_EQ(hand({"attack", id, "--end", "jam"}).code, 0);
  EXPECT_EQ(run(id).at("commands").size(), 3u);
  ASSERT_EQ(client_.patch("/api/v1/runs/" + id, {{"state", "stopped"}}).status, 200);

  const Outcome bundled = hand({"bundle", id, "--out", folder_.file("bundle.json")});
  ASSERT_EQ(bundled.code, 0) << bundled.error;
  const Outcome again = vigil_command({"run", folder_.file("bundle.json"), "--json", "-"});
  ASSERT_EQ(again.code, 0) << again.error;
  EXPECT_EQ(Json::parse(again.output).at("metrics"), run(id).at("metrics"));

  std::ofstream(folder_.file("patch.json")) << R"({"time":{"steps":60},"adversary":{"links":null}})";
  const Outcome forked = hand({"fork", id, "--k", "2", "--patch", folder_.file("patch.json"), "--pace", "max"});
  ASSERT_EQ(forked.code, 0) << forked.error;
  const std::string fork = forked.output.substr(0, forked.output.find('\n'));
  ASSERT_TRUE(client_.reaches(fork, "finished"));
  EXPECT_EQ(run(fork).at("parent"), (Json{{"run", id}, {"k", 2}}));
}

TEST_F(HandsTest, WhatIsWrongIsSaidInOneSentence) {
  const std::string id = endless();
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& words) {
    const Outcome outcome = hand(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.error;
    EXPECT_NE(outcome.error.find(words), std::string::npos) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  };
  refused({"attack", "x", "--type", "dos"}, "RUN is x");
  refused({"attack", "99", "--type", "dos"}, "99");
  refused({"attack", id}, "--type");
  refused({"attack", id, "--type", "doss"}, "did you mean \"dos\"");
  refused({"attack", id, "--type", "dos", "--on", "link:9-9"}, "link:9-9");
  refused({"attack", id, "--type", "dos", "--params", "[1]"}, "--params");
  refused({"attack", id, "--end", "nothing"}, "nothing");
  refused({"tune", id, "lanes.consensus.params.tau=-1"}, "tau");
  refused({"fork", id, "--k", "1", "--pace", "fast"}, "--pace");
  refused({"fork", id, "--k", "100000"}, "k");
  refused({"bundle", "99"}, "99");
  const Outcome nobody = vigil_command({"tune", id, "a.b=1", "--server", "http://127.0.0.1:1"});
  EXPECT_EQ(nobody.code, 2);
  EXPECT_NE(nobody.error.find("does not answer"), std::string::npos) << nobody.error;
}

}  // namespace
}  // namespace vigil::api_test::hands_test
