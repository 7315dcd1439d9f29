/// A client of a broker that never gives up.
#pragma once

#include <mqtt/async_client.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/plant/mqtt.hpp"

namespace vigil {

/// tcp:// or ssl:// as Paho has it, with a port. Throws std::runtime_error with one sentence.
std::string paho_address(const std::string& url);

struct MqttRole {
  std::string client;
  bool keeps_session = false;        ///< the broker keeps messages of its subscriptions while it is away
  std::vector<std::string> filters;  ///< subscribed at QoS 1, at every connection
  std::string status_topic;          ///< "online" while it is there, else "offline", retained; empty: none
  /// On the library's only receiving thread: must not wait.
  std::function<void(const mqtt::message&)> message;
};

/// Safe from any thread.
class MqttConnection {
 public:
  /// Throws std::runtime_error where the options cannot be used. Returns before there is a broker.
  MqttConnection(const MqttOptions& options, MqttRole role);
  ~MqttConnection();
  MqttConnection(const MqttConnection&) = delete;
  MqttConnection& operator=(const MqttConnection&) = delete;

  bool connected() const { return connected_; }
  std::uint64_t connections() const { return connections_; }
  /// While true it stays away from the broker, which keeps what is for it.
  void hold(bool away);
  /// At QoS 1, acknowledged within `patience`; false where not.
  bool publish(const std::string& topic, const std::string& text, bool retained, std::chrono::milliseconds patience);
  /// {"url","connected","connections","held","error"}.
  Json status() const;

 private:
  mqtt::connect_options connect_options();
  void main();
  bool connect();
  void subscribe();
  void leave();
  void say_gone();
  bool wait(const mqtt::token_ptr& token, std::chrono::milliseconds patience) const;
  void failed(const std::string& sentence);

  const MqttOptions options_;
  const MqttRole role_;
  const std::string address_;
  std::atomic<bool> connected_{false}, stop_{false};
  std::atomic<std::uint64_t> connections_{0};
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool away_ = false;
  std::string error_, tls_error_;
  mqtt::async_client client_;  ///< its callbacks use what is above
  std::thread thread_;
};

}  // namespace vigil
