// Alarms and states as others hear them from a real broker.
#include <csignal>
#include <map>

#include "tests/server/cli/command.hpp"
#include "tests/server/mqtt/fixture.hpp"

namespace vigil::mqtt_test::alarms_test {
namespace {

using api_test::eventually;

class AlarmsTest : public MqttTest {
 protected:
  void SetUp() override {
    MqttTest::SetUp();
    if (IsSkipped()) return;
    ASSERT_TRUE(listener_.connect(broker_.port(), "listener"));
    ASSERT_TRUE(listener_.subscribe("vigil/test/#"));
  }
  /// Somebody who comes only now: what is kept, by topic.
  std::map<std::string, std::string> kept() const {
    PlainClient late;
    std::map<std::string, std::string> kept;
    if (!late.connect(broker_.port(), "late") || !late.subscribe("vigil/test/#")) return kept;
    while (const auto message = late.next(std::chrono::milliseconds(200))) {
      if (message->retained) kept[message->topic] = message->payload;
    }
    return kept;
  }
  Json kept_state(const std::string& id) const {
    const auto all = kept();
    const auto place = all.find("vigil/test/runs/" + id + "/state");
    return place == all.end() ? Json::object() : Json::parse(place->second);
  }

  PlainClient listener_;
};

TEST_F(AlarmsTest, AlarmsPassAndTheNewestStateIsKept) {
  const std::string id = client_->start({{"scenario", "replay-ubb"}});
  ASSERT_TRUE(client_->reaches(id, "finished"));
  const Json marks = client_->get("/api/v1/runs/" + id + "/marks?type=alarm&limit=1000").json.at("items");
  ASSERT_FALSE(marks.empty());
  std::vector<Json> alarms;
  Json state;
  EXPECT_TRUE(eventually([&] {
    while (const auto message = listener_.next(std::chrono::milliseconds(20))) {
      if (message->topic == "vigil/test/runs/" + id + "/alarms") {
        EXPECT_FALSE(message->retained);
        alarms.push_back(Json::parse(message->payload));
      } else if (message->topic == "vigil/test/runs/" + id + "/state") {
        state = Json::parse(message->payload);
      }
    }
    const auto dropped = client_->get("/api/v1/server").json.at("alarms").at("mqtt").at("dropped").get<std::size_t>();
    return alarms.size() + dropped == marks.size() && state.is_object() && state.at("state") == "finished";
  })) << alarms.size()
      << " of " << marks.size() << state;
  EXPECT_EQ(alarms.back().at("run"), id);
  EXPECT_EQ(alarms.back().at("k"), marks.back().at("k"));
  const Json later = kept_state(id);
  EXPECT_EQ(later.at("state"), "finished");
  EXPECT_EQ(later.at("scenario"), "replay-ubb");
  EXPECT_FALSE(later.at("lanes").empty());
  EXPECT_EQ(kept().at("vigil/test/status"), "online");
  for (const auto& [topic, text] : kept()) EXPECT_FALSE(topic.ends_with("/alarms")) << topic;

  EXPECT_EQ(client_->remove("/api/v1/runs/" + id).status, 204);
  EXPECT_TRUE(eventually([&] { return kept_state(id).empty(); }));
}

TEST_F(AlarmsTest, AStateTellsWhichLanesAreInAlarmNow) {
  const std::string id =
      client_->start({{"scenario", "replay-ubb"}, {"pace", 100}, {"patch", {{"time", {{"steps", nullptr}}}}}});
  bool begun = false;
  EXPECT_TRUE(eventually([&] {
    while (const auto message = listener_.next(std::chrono::milliseconds(20))) {
      if (message->topic != "vigil/test/runs/" + id + "/state") continue;
      const Json state = Json::parse(message->payload);
      for (const auto& [lane, now] : state.at("lanes").items())
        begun = begun || (now.at("alarm") == true && !now.at("since").empty());
    }
    return begun;
  }));
  client_->patch("/api/v1/runs/" + id, {{"state", "stopped"}});
}

TEST_F(AlarmsTest, AnOrderlyEndAndAKillSayOffline) {
  server_.reset();
  EXPECT_EQ(kept().at("vigil/test/status"), "offline");
  const api_test::TemporaryFolder folder;
  api_test::ServerProcess process(
      {"--db", folder.file("log.db"), "--no-demo", "--mqtt", broker_.url(), "--mqtt-prefix", "vigil/test"});
  EXPECT_TRUE(eventually([&] { return kept().at("vigil/test/status") == "online"; }));
  process.end(SIGKILL);
  EXPECT_TRUE(eventually([&] { return kept().at("vigil/test/status") == "offline"; }));
}

TEST_F(AlarmsTest, AfterAKillTheKeptStatesAreMadeRight) {
  server_.reset();
  const api_test::TemporaryFolder folder;
  const std::vector<std::string> arguments{"--db",        folder.file("log.db"), "--no-demo", "--mqtt",
                                           broker_.url(), "--mqtt-prefix",       "vigil/test"};
  std::string id;
  {
    api_test::ServerProcess process(arguments);
    const api_test::Client client(process.port());
    id = client.start({{"scenario", "consensus"}, {"pace", 5}, {"patch", {{"time", {{"steps", nullptr}}}}}});
    ASSERT_TRUE(eventually([&] { return kept_state(id).value("state", "") == "running"; }));
    process.end(SIGKILL);
  }
  ASSERT_TRUE(listener_.publish("vigil/test/runs/999/state", R"({"run":"999","state":"running"})", true));
  ASSERT_TRUE(listener_.settle());
  api_test::ServerProcess process(arguments);
  EXPECT_TRUE(eventually([&] { return kept_state(id).value("state", "") == "interrupted"; })) << kept_state(id);
  EXPECT_TRUE(eventually([&] { return kept_state("999").empty(); })) << "a run that is not there any more";
}

TEST_F(AlarmsTest, ABrokerThatIsGoneHoldsNobodyUpAndHearsTheStatesLater) {
  broker_.end(SIGKILL);
  const std::string id = client_->start({{"scenario", "replay-ubb"}});
  ASSERT_TRUE(client_->reaches(id, "finished"));
  EXPECT_EQ(client_->get("/api/v1/server").json.at("alarms").at("mqtt").at("connected"), false);
  ASSERT_TRUE(broker_.start());
  EXPECT_TRUE(eventually([&] { return kept_state(id).value("state", "") == "finished"; }));
}

}  // namespace
}  // namespace vigil::mqtt_test::alarms_test
