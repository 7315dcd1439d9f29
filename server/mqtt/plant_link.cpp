// Messages of a plant, from a broker into an inbox.
#include "server/mqtt/connection.hpp"

namespace vigil {
namespace {

class MqttPlantLink : public PlantLink {
 public:
  MqttPlantLink(const MqttOptions& options, PlantInbox& inbox)
      : options_(options), inbox_(inbox), connection_(options, role(options, inbox)) {
    inbox_.on_pause([this](bool paused) { connection_.hold(paused); });
  }
  ~MqttPlantLink() override { inbox_.on_pause(nullptr); }

  Json status() const override {
    Json status = connection_.status();
    for (const TopicPattern& topic : options_.topics) status["topics"].push_back(topic.text());
    return status;
  }

 private:
  static MqttRole role(const MqttOptions& options, PlantInbox& inbox) {
    MqttRole role;
    role.client = options.client;
    role.keeps_session = true;
    for (const TopicPattern& topic : options.topics) role.filters.push_back(topic.filter());
    role.message = [&inbox](const mqtt::message& message) {
      inbox.deliver(message.get_topic(), message.get_payload_str());
    };
    return role;
  }

  const MqttOptions options_;
  PlantInbox& inbox_;
  MqttConnection connection_;
};

}  // namespace

std::string mqtt_missing() { return {}; }

void check_mqtt(const MqttOptions& options) { paho_address(options.url); }

std::unique_ptr<PlantLink> open_plant_link(const MqttOptions& options, PlantInbox& inbox) {
  return std::make_unique<MqttPlantLink>(options, inbox);
}

}  // namespace vigil
