#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "server/front/loop.hpp"
#include "server/hub/viewer.hpp"

namespace vigil {
namespace {

constexpr int kAcceptedAtOnce = 64;
constexpr auto kAcceptPause = std::chrono::milliseconds(200);

/// As text without the port; a mapped IPv4 address as IPv4.
std::string address_text(const sockaddr_storage& address) {
  char text[INET6_ADDRSTRLEN] = "";
  if (address.ss_family == AF_INET) {
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in&>(address).sin_addr, text, sizeof text);
  } else if (address.ss_family == AF_INET6) {
    inet_ntop(AF_INET6, &reinterpret_cast<const sockaddr_in6&>(address).sin6_addr, text, sizeof text);
  }
  const std::string_view plain = text;
  static constexpr std::string_view kMapped = "::ffff:";
  return std::string(plain.starts_with(kMapped) ? plain.substr(kMapped.size()) : plain);
}

bool is_loopback(std::string_view address) { return address == "::1" || address.starts_with("127."); }

void set_option(int socket, int level, int name, int value) { setsockopt(socket, level, name, &value, sizeof value); }

std::string local_address(int socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  return getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0 ? address_text(address) : std::string();
}

}  // namespace

void Loop::accept_all() {
  for (int i = 0; i < kAcceptedAtOnce && accepting_ && !stopping_; ++i) {
    sockaddr_storage peer{};
    socklen_t size = sizeof peer;
    const int socket = accept4(listener_, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket >= 0) {
      admit(socket, peer);
    } else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
      pause_accepting();
    } else if (errno != ECONNABORTED && errno != EINTR) {
      return;
    }
  }
}

void Loop::admit(int socket, const sockaddr_storage& peer) {
  auto connection = std::make_unique<Connection>();
  connection->socket = socket;
  connection->id = next_id_++;
  connection->remote = address_text(peer);
  connection->local = local_address(socket);
  connection->deadline = Clock::now() + options_.head_deadline;
  const bool counted = options_.per_address > 0 && (options_.cap_loopback || !is_loopback(connection->remote));
  const bool too_many = counted && per_address_[connection->remote] >= options_.per_address;
  set_option(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, 20'000);
  Connection& kept = *connection;
  ++per_address_[kept.remote];
  connections_.emplace(kept.id, std::move(connection));
  counters_.connections = connections_.size();
  if (too_many) {
    refuse(kept, {429, "There are too many connections from this address."}, {{"Retry-After", "5"}}, false);
    advance(kept);
  } else {
    arm(kept, EPOLLIN);
  }
  if (connections_.size() >= options_.connections) pause_accepting();
}

/// The backlog waits in the kernel; the sweep tries again. Without this, a full table of descriptors is a busy loop.
void Loop::pause_accepting() {
  accepting_ = false;
  accept_again_ = Clock::now() + kAcceptPause;
  epoll_event event{};
  event.data.ptr = &listener_;
  epoll_ctl(epoll_, EPOLL_CTL_MOD, listener_, &event);
  // Kept connections that nobody uses are the first to go.
  for (auto& [id, connection] : connections_) {
    if (connection->state == State::head && connection->in.empty() && connection->keep_alive) close(*connection);
  }
}

void Loop::resume_accepting() {
  if (stopping_ || connections_.size() >= options_.connections) return;
  accepting_ = true;
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.ptr = &listener_;
  epoll_ctl(epoll_, EPOLL_CTL_MOD, listener_, &event);
}

void Loop::arm(Connection& connection, std::uint32_t events) {
  if (connection.events == events) return;
  epoll_event event{};
  event.events = events;
  event.data.ptr = &connection;
  const int operation = connection.events == 0 ? EPOLL_CTL_ADD : events == 0 ? EPOLL_CTL_DEL : EPOLL_CTL_MOD;
  epoll_ctl(epoll_, operation, connection.socket, &event);
  connection.events = events;
}

void Loop::close(Connection& connection) {
  if (connection.dead) return;
  connection.dead = true;
  arm(connection, 0);
  ::close(connection.socket);
  connection.socket = -1;
  dead_.push_back(&connection);
}

/// Not at once: events of this turn, and the hub's list being walked, may still name it.
void Loop::bury() {
  for (Connection* connection : dead_) {
    if (connection->viewer) hub_.detach(connection->viewer);
    if (connection->state == State::body) bodies_ -= connection->body_wanted;
    const auto count = per_address_.find(connection->remote);
    if (--count->second == 0) per_address_.erase(count);
    connections_.erase(connection->id);
  }
  if (dead_.empty()) return;
  dead_.clear();
  counters_.connections = connections_.size();
}

}  // namespace vigil
