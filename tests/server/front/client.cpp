#include "tests/server/front/client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

namespace vigil::test {
namespace {

constexpr int kDeadline = 30'000;  // ms

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

std::string Reply::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? std::string() : found->second;
}

Client::Client(int port, int receive_buffer) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (receive_buffer > 0) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  const timeval patience{kDeadline / 1000, 0};
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("cannot connect");
}

Client::~Client() {
  if (socket_ >= 0) ::close(socket_);
}

Client::Client(Client&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      in_(std::move(other.in_)),
      events_(std::move(other.events_)),
      stream_status_(other.stream_status_) {}

bool Client::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

bool Client::more() {
  pollfd wait{socket_, POLLIN, 0};
  if (::poll(&wait, 1, kDeadline) <= 0) return false;
  char buffer[65536];
  const ssize_t n = ::recv(socket_, buffer, sizeof buffer, 0);
  if (n <= 0) return false;
  in_.append(buffer, static_cast<std::size_t>(n));
  return true;
}

bool Client::read_head(Reply& reply) {
  while (in_.find("\r\n\r\n") == std::string::npos) {
    if (!more()) return false;
  }
  const auto end = in_.find("\r\n\r\n");
  const std::string head = in_.substr(0, end + 2);
  in_.erase(0, end + 4);
  reply.status = std::stoi(head.substr(9, 3));
  for (auto at = head.find("\r\n") + 2; at < head.size();) {
    const auto stop = head.find("\r\n", at);
    const std::string line = head.substr(at, stop - at);
    const auto colon = line.find(": ");
    reply.headers.emplace(lower(line.substr(0, colon)), line.substr(colon + 2));
    at = stop + 2;
  }
  return true;
}

bool Client::read_chunk(std::string& out) {
  while (in_.find("\r\n") == std::string::npos) {
    if (!more()) return false;
  }
  const auto line = in_.find("\r\n");
  const std::size_t size = std::stoul(in_.substr(0, line), nullptr, 16);
  while (in_.size() < line + 2 + size + 2) {
    if (!more()) return false;
  }
  out.append(in_, line + 2, size);
  in_.erase(0, line + 2 + size + 2);
  if (size == 0) stream_whole_ = true;
  return size > 0;
}

Reply Client::reply(bool head_only) {
  Reply reply;
  do {
    reply = Reply();
    if (!read_head(reply)) return reply;
  } while (reply.status == 100);
  if (head_only || reply.status == 204 || reply.status == 304) {
    reply.whole = true;
  } else if (reply.header("transfer-encoding") == "chunked") {
    stream_whole_ = false;
    while (read_chunk(reply.body)) continue;
    reply.whole = stream_whole_;
  } else {
    const std::size_t size = std::stoul(reply.header("content-length"));
    while (in_.size() < size && more()) continue;
    reply.whole = in_.size() >= size;
    reply.body = in_.substr(0, size);
    in_.erase(0, size);
  }
  return reply;
}

int Client::stream_status() {
  if (stream_status_ < 0) {
    Reply head;
    stream_status_ = read_head(head) ? head.status : 0;
  }
  return stream_status_;
}

Event Client::event() {
  if (stream_status() != 200) return {};
  while (events_.find("\n\n") == std::string::npos) {
    if (!read_chunk(events_)) return {};
  }
  const auto end = events_.find("\n\n");
  const std::string text = events_.substr(0, end + 1);
  events_.erase(0, end + 2);
  Event event;
  for (std::size_t at = 0; at < text.size();) {
    const auto stop = text.find('\n', at);
    const std::string line = text.substr(at, stop - at);
    if (line.rfind("event: ", 0) == 0) event.name = line.substr(7);
    if (line.rfind("data: ", 0) == 0) event.data = line.substr(6);
    if (line.rfind("id: ", 0) == 0) event.id = line.substr(4);
    at = stop + 1;
  }
  return event;
}

std::vector<Event> Client::events_until(std::string_view name) {
  std::vector<Event> events;
  do {
    events.push_back(event());
  } while (events.back().name != name && !events.back().name.empty());
  return events;
}

bool Client::closed() {
  while (true) {
    pollfd wait{socket_, POLLIN, 0};
    if (::poll(&wait, 1, kDeadline) <= 0) return false;
    char buffer[65536];
    if (::recv(socket_, buffer, sizeof buffer, 0) <= 0) return true;
  }
}

std::string get(std::string_view path, std::string_view lines) {
  std::string text = "GET ";
  return text.append(path).append(" HTTP/1.1\r\nHost: localhost\r\n").append(lines).append("\r\n");
}

std::string post(std::string_view path, std::string_view body, std::string_view type, std::string_view lines) {
  std::string text = "POST ";
  text.append(path)
      .append(" HTTP/1.1\r\nHost: localhost\r\nContent-Type: ")
      .append(type)
      .append("\r\nContent-Length: ");
  return text.append(std::to_string(body.size())).append("\r\n").append(lines).append("\r\n").append(body);
}

bool eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(kDeadline);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace vigil::test
