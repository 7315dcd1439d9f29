// Alarms and states out of the server, by a broker that keeps the newest states for those who come later.
#include "server/mqtt/connection.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostKept = 100'000;

class MqttAlarms : public AlarmSink {
 public:
  explicit MqttAlarms(const MqttOptions& options) : prefix_(options.prefix), connection_(options, role(options)) {}

  std::string name() const override { return "mqtt"; }
  bool send(const Announcement& announcement) override {
    return connection_.publish(prefix_ + "/" + announcement.topic, announcement.text, announcement.kept, 2s);
  }
  bool connected() const override { return connection_.connected(); }
  std::uint64_t connections() const override { return connection_.connections(); }
  std::vector<std::pair<std::string, std::string>> kept() override {
    const std::lock_guard lock(mutex_);
    return std::exchange(kept_, {});
  }
  Json status() const override {
    Json status = connection_.status();
    status["prefix"] = prefix_;
    return status;
  }

 private:
  MqttRole role(const MqttOptions& options) {
    MqttRole role;
    role.client = options.client + "-alarms";
    role.status_topic = options.prefix + "/status";
    role.filters = {options.prefix + "/runs/+/state"};
    role.message = [this](const mqtt::message& message) {
      if (!message.is_retained()) return;  // what we have just said ourselves
      const std::lock_guard lock(mutex_);
      if (kept_.size() < kMostKept)
        kept_.emplace_back(message.get_topic().substr(prefix_.size() + 1), message.get_payload_str());
    };
    return role;
  }

  const std::string prefix_;
  std::mutex mutex_;
  std::vector<std::pair<std::string, std::string>> kept_;
  MqttConnection connection_;  ///< last: its thread uses the others
};

}  // namespace

std::unique_ptr<AlarmSink> open_mqtt_alarms(const MqttOptions& options) {
  return std::make_unique<MqttAlarms>(options);
}

}  // namespace vigil
