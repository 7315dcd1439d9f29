/// A client of MQTT 3.1.1 over a bare socket, independent of the library that the server uses. QoS 1 only.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace vigil::mqtt_test {

struct Received {
  std::string topic, payload;
  bool retained = false;
};

class PlainClient {
 public:
  PlainClient() = default;
  ~PlainClient() { drop(); }
  PlainClient(const PlainClient&) = delete;
  PlainClient& operator=(const PlainClient&) = delete;

  /// A clean session. False where the broker is not there or refuses.
  bool connect(int port, const std::string& id, const std::string& user = {}, const std::string& password = {});
  /// The connection goes without a word; what is not acknowledged stays known.
  void drop();

  /// False where the connection is lost: the message is among those that resend() sends. Waits while 100 are under way.
  bool publish(std::string_view topic, std::string_view payload, bool retained = false);
  /// Waits for every acknowledgement; false where the connection is lost or thirty seconds have passed.
  bool settle();
  /// All that is not acknowledged once more, in order, marked as repeated.
  bool resend();
  std::size_t unacknowledged() const { return unacked_.size(); }

  bool subscribe(std::string_view filter);
  /// The next message; empty where none comes in time.
  std::optional<Received> next(std::chrono::milliseconds patience = std::chrono::seconds(30));

 private:
  bool send(const std::string& bytes);
  bool read_some(int milliseconds);
  bool take_packet();
  void take(unsigned char type, std::string_view body);

  int socket_ = -1;
  std::string input_;
  std::uint16_t id_ = 0;
  std::map<std::uint64_t, std::pair<std::uint16_t, std::string>> unacked_;  ///< by order: packet id and packet
  std::map<std::uint16_t, std::uint64_t> order_;
  std::uint64_t count_ = 0;
  std::deque<Received> received_;
  bool connected_ = false, subscribed_ = false;
};

}  // namespace vigil::mqtt_test
