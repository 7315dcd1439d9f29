#include "tests/server/mqtt/plain_client.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

namespace vigil::mqtt_test {
namespace {

constexpr std::size_t kUnderWay = 100;

std::string number(std::uint16_t value) { return {static_cast<char>(value >> 8), static_cast<char>(value & 0xff)}; }

std::string text(std::string_view value) { return number(static_cast<std::uint16_t>(value.size())).append(value); }

std::string packet(unsigned char first, const std::string& body) {
  std::string bytes(1, static_cast<char>(first));
  for (std::size_t left = body.size();;) {
    const auto digit = static_cast<unsigned char>(left % 128);
    left /= 128;
    bytes += static_cast<char>(left > 0 ? digit | 128 : digit);
    if (left == 0) return bytes + body;
  }
}

std::uint16_t number_at(std::string_view body, std::size_t at) {
  return static_cast<std::uint16_t>((static_cast<unsigned char>(body[at]) << 8) |
                                    static_cast<unsigned char>(body[at + 1]));
}

}  // namespace

void PlainClient::drop() {
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
  connected_ = false;
  input_.clear();
}

bool PlainClient::connect(int port, const std::string& id, const std::string& user, const std::string& password) {
  drop();
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return false;
  const int one = 1;
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
  std::string body = text("MQTT") + '\x04';
  body += static_cast<char>(0x02 | (user.empty() ? 0 : 0x80) | (password.empty() ? 0 : 0x40));
  body += number(0) + text(id);
  if (!user.empty()) body += text(user);
  if (!password.empty()) body += text(password);
  if (!send(packet(0x10, body))) return false;
  while (!connected_ && read_some(5000)) {
  }
  return connected_;
}

bool PlainClient::send(const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
    if (n <= 0) return false;
    at += static_cast<std::size_t>(n);
  }
  return true;
}

/// False where nothing comes in time, or the connection is lost: then it is no longer connected.
bool PlainClient::read_some(int milliseconds) {
  pollfd waiting{socket_, POLLIN, 0};
  if (socket_ < 0 || poll(&waiting, 1, milliseconds) <= 0) return false;
  char part[65536];
  const ssize_t n = recv(socket_, part, sizeof part, 0);
  if (n <= 0) {
    drop();
    return false;
  }
  input_.append(part, static_cast<std::size_t>(n));
  while (take_packet()) {
  }
  return true;
}

bool PlainClient::take_packet() {
  std::size_t length = 0, at = 1;
  for (int shift = 0;; shift += 7, ++at) {
    if (at >= input_.size()) return false;
    length |= static_cast<std::size_t>(input_[at] & 127) << shift;
    if ((input_[at] & 128) == 0) break;
  }
  ++at;
  if (input_.size() < at + length) return false;
  take(static_cast<unsigned char>(input_[0]), std::string_view(input_).substr(at, length));
  input_.erase(0, at + length);
  return true;
}

void PlainClient::take(unsigned char type, std::string_view body) {
  if (type == 0x20) {
    connected_ = body.size() == 2 && body[1] == 0;
    if (!connected_) shutdown(socket_, SHUT_RDWR);
  } else if (type == 0x40) {
    const auto place = order_.find(number_at(body, 0));
    if (place == order_.end()) return;
    unacked_.erase(place->second);
    order_.erase(place);
  } else if (type == 0x90) {
    subscribed_ = body.size() == 3 && body[2] <= 2;
  } else if ((type & 0xf0) == 0x30) {
    const std::size_t length = number_at(body, 0);
    Received message{std::string(body.substr(2, length)), {}, (type & 1) != 0};
    std::size_t at = 2 + length;
    if ((type & 6) != 0) {
      send(packet(0x40, number(number_at(body, at))));
      at += 2;
    }
    message.payload = body.substr(at);
    received_.push_back(std::move(message));
  }
}

bool PlainClient::publish(std::string_view topic, std::string_view payload, bool retained) {
  while (connected_ && unacked_.size() >= kUnderWay) {
    if (!read_some(30'000)) drop();
  }
  do {
    ++id_;
  } while (id_ == 0 || order_.contains(id_));
  std::string bytes = packet(retained ? 0x33 : 0x32, text(topic) + number(id_) + std::string(payload));
  order_[id_] = ++count_;
  const bool sent = connected_ && send(bytes);
  unacked_[count_] = {id_, std::move(bytes)};
  if (sent) {
    while (read_some(0)) {
    }
  }
  return sent && connected_;
}

bool PlainClient::settle() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (connected_ && !unacked_.empty() && std::chrono::steady_clock::now() < end) read_some(200);
  return connected_ && unacked_.empty();
}

bool PlainClient::resend() {
  std::deque<std::string> all;
  for (const auto& [order, one] : unacked_) all.push_back(one.second);
  for (std::string& bytes : all) {
    bytes[0] = static_cast<char>(bytes[0] | 0x08);
    if (!send(bytes)) return false;
    read_some(0);
  }
  return connected_;
}

bool PlainClient::subscribe(std::string_view filter) {
  subscribed_ = false;
  if (!send(packet(0x82, number(1) + text(filter) + '\x01'))) return false;
  while (!subscribed_ && read_some(5000)) {
  }
  return subscribed_;
}

std::optional<Received> PlainClient::next(std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (received_.empty() && connected_ && std::chrono::steady_clock::now() < end) read_some(50);
  if (received_.empty()) return std::nullopt;
  Received first = std::move(received_.front());
  received_.pop_front();
  return first;
}

}  // namespace vigil::mqtt_test
