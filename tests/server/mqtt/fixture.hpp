/// A server that a real broker feeds and that tells it of its runs.
#pragma once

#include "tests/server/api/fixture.hpp"
#include "tests/server/mqtt/mosquitto.hpp"
#include "tests/server/mqtt/plain_client.hpp"

namespace vigil::mqtt_test {

class MqttTest : public api_test::ApiTest {
 protected:
  void SetUp() override {
    if (const std::string reason = why_not(); !reason.empty()) GTEST_SKIP() << reason;
    ASSERT_TRUE(broker_.start());
    MqttOptions mqtt;
    mqtt.url = broker_.url();
    mqtt.client = "vigil-test";
    mqtt.prefix = "vigil/test";
    for (const char* topic : {"plant/{run}/rows", "plant/{run}/{node}/{channel}", "plant/{run}/signal/x/{channel}"})
      mqtt.topics.emplace_back(topic);
    mqtt.inbox = inbox_;
    options_.mqtt = mqtt;
    begin();
    ASSERT_TRUE(api_test::eventually([this] { return connected(); }));
    ASSERT_TRUE(plant_.connect(broker_.port(), "plant"));
  }
  Json link() const { return client_->get("/api/v1/ingest").json; }
  bool connected() const {
    return link().at("broker").at("connected") == true &&
           client_->get("/api/v1/server").json.at("alarms").at("mqtt").at("connected") == true;
  }
  std::string begin_run(Json mqtt, Json more = Json::object()) {
    Json body{{"scenario", "consensus"},
              {"seed", 5},
              {"input", {{"ingest", {{"deadline", 3600}, {"mqtt", std::move(mqtt)}}}}}};
    body.update(more);
    return client_->start(body);
  }
  std::string frames(const std::string& id) const {
    return client_->get("/api/v1/runs/" + id + "/samples?signals=lane.*", {{"Accept", "text/csv"}}).body;
  }

  InboxOptions inbox_;
  Mosquitto broker_;
  PlainClient plant_;
};

}  // namespace vigil::mqtt_test
