/// A broker of MQTT, behind interfaces: the rest of the server knows neither its library nor its protocol.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/json.hpp"
#include "server/alarms/alarm_sink.hpp"
#include "server/plant/credentials.hpp"
#include "server/plant/inbox.hpp"

namespace vigil {

struct MqttOptions {
  std::string url;                   ///< tcp://HOST[:PORT], ssl://HOST[:PORT], or mqtt:// and mqtts:// for the same
  std::vector<TopicPattern> topics;  ///< that feed runs; none: only alarms go out
  BrokerCredentials credentials;
  std::string client;  ///< stable over restarts: the broker keeps messages for it
  std::string prefix;  ///< of the topics that go out; no wildcard
  InboxOptions inbox;
};

/// Connects, reconnects for ever, and brings messages into an inbox.
class PlantLink {
 public:
  virtual ~PlantLink() = default;
  /// {"url","connected","connections","held","error":sentence or null,"topics":[…]}.
  virtual Json status() const = 0;
};

/// Why MQTT cannot be used in this executable; empty: it can.
std::string mqtt_missing();
/// Throws std::runtime_error with one sentence where the address is none. Returns before there is a broker.
void check_mqtt(const MqttOptions& options);
std::unique_ptr<PlantLink> open_plant_link(const MqttOptions& options, PlantInbox& inbox);
std::unique_ptr<AlarmSink> open_mqtt_alarms(const MqttOptions& options);

}  // namespace vigil
