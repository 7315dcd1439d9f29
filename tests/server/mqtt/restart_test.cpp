// A broker that ends in the middle and comes back: every reading is taken once.
#include <csignal>
#include <thread>

#include "tests/server/mqtt/fixture.hpp"

namespace vigil::mqtt_test::restart_test {
namespace {

using api_test::eventually;

class RestartTest : public MqttTest {};

/// Keeps publishing over restarts of the broker, as a gateway with a memory does.
class Gateway {
 public:
  explicit Gateway(const Mosquitto& broker) : broker_(broker) {}
  void publish(const std::string& topic, const std::string& payload) {
    if (!client_.publish(topic, payload)) come_back();
  }
  bool settle() {
    return eventually([this] {
      if (client_.settle()) return true;
      come_back();
      return false;
    });
  }

 private:
  void come_back() {
    eventually([this] { return client_.connect(broker_.port(), "gateway") && client_.resend(); });
  }
  const Mosquitto& broker_;
  PlainClient client_;
};

TEST_F(RestartTest, NoReadingIsLost) {
  constexpr std::int64_t kTicks = 6000;
  const std::string id = begin_run("line", {{"patch", {{"time", {{"steps", nullptr}}}}}});
  const Json nodes = client_->get("/api/v1/ingest/" + id).json.at("nodes");
  std::atomic<std::int64_t> published{0};
  std::thread gateway([&] {
    Gateway way(broker_);
    way.publish("plant/line/rows", R"({"k":0,"values":{"truth.x":1,"truth.y":1,"truth.theta":0}})");
    for (std::int64_t k = 0; k < kTicks; ++k) {
      for (const Json& node : nodes) {
        Json row{{"k", k}, {"node", node}, {"values", Json::object()}};
        way.publish("plant/line/rows", row.dump());
      }
      published = k;
    }
    EXPECT_TRUE(way.settle());
  });
  for (const std::int64_t at : {kTicks / 4, kTicks / 2}) {
    ASSERT_TRUE(eventually([&] { return published > at; }));
    broker_.end(SIGTERM);
    EXPECT_TRUE(eventually([&] { return !connected(); }));
    ASSERT_TRUE(broker_.start());
    EXPECT_TRUE(eventually([&] { return connected(); }));
  }
  gateway.join();
  const auto status = [&] { return client_->get("/api/v1/ingest/" + id).json; };
  const std::int64_t all = kTicks * static_cast<std::int64_t>(nodes.size()) + 1;
  EXPECT_TRUE(eventually([&] { return status().at("closed") == kTicks - 1; })) << status() << link();
  EXPECT_EQ(status().at("accepted"), all) << status();
  EXPECT_GE(link().at("broker").at("connections"), 3);
  EXPECT_EQ(link().at("refused"), 0) << link();
}

}  // namespace
}  // namespace vigil::mqtt_test::restart_test
