#include "tests/bench/yardsticks/sse_epoll.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace vigil::bench {
namespace {

constexpr std::uint64_t kRing = 64;
constexpr int kParts = 16;
constexpr int kSendBuffer = 64 * 1024;

using Packet = std::shared_ptr<const std::string>;

std::string chunk(const std::string& payload) {
  std::array<char, 32> size;
  std::snprintf(size.data(), size.size(), "%zx\r\n", payload.size());
  return size.data() + payload + "\r\n";
}

std::string frame(std::uint64_t sequence, std::size_t bytes) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  std::string text = "id: " + std::to_string(sequence) + "\ndata: {\"ts\":" + std::to_string(nanoseconds) + ",\"p\":\"";
  if (text.size() + 4 < bytes) text.append(bytes - text.size() - 4, 'x');
  return text + "\"}\n\n";
}

struct Client {
  int socket = -1;
  bool live = false;
  bool blocked = false;
  bool dead = false;
  std::uint64_t next = 0;
  std::size_t offset = 0;
  Packet partial;  ///< of a frame that went out in part: the ring may move on meanwhile
  std::string gap;
  std::string in;
};

class Loop {
 public:
  Loop(int listener, double rate, std::size_t bytes) : listener_(listener), bytes_(bytes), epoll_(epoll_create1(0)) {
    timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK);
    const auto period = static_cast<long>(1e9 / rate);
    const itimerspec every{{period / 1'000'000'000, period % 1'000'000'000}, {0, 1'000'000}};
    timerfd_settime(timer_, 0, &every, nullptr);
    watch(EPOLL_CTL_ADD, listener_, EPOLLIN, &listener_);
    watch(EPOLL_CTL_ADD, timer_, EPOLLIN, &timer_);
  }

  [[noreturn]] void run() {
    std::array<epoll_event, 256> events;
    while (true) {
      const int count = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), -1);
      for (int i = 0; i < count; ++i) {
        const auto& event = events[static_cast<std::size_t>(i)];
        if (event.data.ptr == &listener_) {
          accept_all();
        } else if (event.data.ptr == &timer_) {
          publish();
        } else {
          handle(*static_cast<Client*>(event.data.ptr), event.events);
        }
      }
      bury();
    }
  }

 private:
  void watch(int operation, int fd, std::uint32_t events, void* tag) const {
    epoll_event event{};
    event.events = events;
    event.data.ptr = tag;
    epoll_ctl(epoll_, operation, fd, &event);
  }

  void accept_all() {
    for (int socket = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK); socket >= 0;
         socket = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK)) {
      const int on = 1;
      setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
      clients_.push_back(std::make_unique<Client>());
      clients_.back()->socket = socket;
      watch(EPOLL_CTL_ADD, socket, EPOLLIN | EPOLLRDHUP, clients_.back().get());
    }
  }

  void publish() {
    std::uint64_t ticks = 0;
    if (::read(timer_, &ticks, sizeof ticks) != sizeof ticks) return;
    ring_[sequence_ % kRing] = std::make_shared<const std::string>(chunk(frame(sequence_, bytes_)));
    ++sequence_;
    for (const auto& client : clients_) {
      if (client->live && !client->blocked && !client->dead) pump(*client);
    }
  }

  void handle(Client& client, std::uint32_t events) {
    if ((events & (EPOLLHUP | EPOLLERR | EPOLLRDHUP)) != 0) client.dead = true;
    if (!client.dead && (events & EPOLLIN) != 0) receive(client);
    if (!client.dead && (events & EPOLLOUT) != 0) pump(client);
  }

  void receive(Client& client) const {
    std::array<char, 4096> buffer;
    const ssize_t count = ::recv(client.socket, buffer.data(), buffer.size(), 0);
    if (count <= 0) {
      client.dead = count == 0 || errno != EAGAIN;
      return;
    }
    if (client.live) return;
    client.in.append(buffer.data(), static_cast<std::size_t>(count));
    if (client.in.find("\r\n\r\n") == std::string::npos) return;
    static constexpr char kHead[] =
        "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nTransfer-Encoding: "
        "chunked\r\n\r\n";
    client.dead = ::send(client.socket, kHead, sizeof kHead - 1, MSG_NOSIGNAL) < 0;
    client.live = true;
    client.next = sequence_;
    client.in = std::string();
  }

  const Packet& packet(const Client& client, std::uint64_t sequence) const {
    return sequence == client.next && client.partial ? client.partial : ring_[sequence % kRing];
  }

  void fall_behind(Client& client) const {
    const std::uint64_t to = sequence_ - kRing / 2;
    client.gap = chunk("event: gap\ndata: {\"from\":" + std::to_string(client.next) +
                       ",\"to\":" + std::to_string(to - 1) + "}\n\n");
    client.next = to;
  }

  void pump(Client& client) const {
    while (client.next < sequence_ || !client.gap.empty()) {
      const bool late = sequence_ - client.next > kRing - 2;
      if (late && client.offset == 0 && client.gap.empty()) fall_behind(client);
      std::array<iovec, kParts> parts;
      std::array<Packet, kParts> held;
      std::size_t skip = client.offset;
      std::size_t total = 0;
      std::size_t count = 0;
      const auto add = [&](const std::string& bytes) {
        parts[count++] = {const_cast<char*>(bytes.data()) + skip, bytes.size() - skip};
        total += bytes.size() - skip;
        skip = 0;
      };
      if (!client.gap.empty()) add(client.gap);
      for (std::uint64_t at = client.next; at < sequence_ && count < kParts; ++at) {
        held[count] = packet(client, at);
        add(*held[count]);
        if (sequence_ - client.next > kRing - 2) break;  // only the rest of the current frame may go out
      }
      if (!send(client, parts.data(), count, total)) return;
    }
    block(client, false);
  }

  /// False when nothing more can go out now.
  bool send(Client& client, iovec* parts, std::size_t count, std::size_t total) const {
    msghdr message{};
    message.msg_iov = parts;
    message.msg_iovlen = count;
    const ssize_t result = ::sendmsg(client.socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (result < 0 && errno != EAGAIN) {
      client.dead = true;
      return false;
    }
    const std::size_t sent = result < 0 ? 0 : static_cast<std::size_t>(result);
    advance(client, sent);
    if (sent == total) return true;
    block(client, true);
    return false;
  }

  void advance(Client& client, std::size_t sent) const {
    while (sent > 0) {
      const bool in_gap = !client.gap.empty();
      const Packet current = in_gap ? nullptr : packet(client, client.next);
      const std::size_t left = (in_gap ? client.gap.size() : current->size()) - client.offset;
      if (sent < left) {
        client.offset += sent;
        client.partial = current;
        return;
      }
      sent -= left;
      client.offset = 0;
      client.partial.reset();
      if (in_gap) {
        client.gap.clear();
      } else {
        ++client.next;
      }
    }
  }

  void block(Client& client, bool blocked) const {
    if (client.blocked == blocked) return;
    client.blocked = blocked;
    watch(EPOLL_CTL_MOD, client.socket, EPOLLIN | EPOLLRDHUP | (blocked ? EPOLLOUT : 0u), &client);
  }

  void bury() {
    const auto gone = [](const std::unique_ptr<Client>& client) {
      if (client->dead) ::close(client->socket);
      return client->dead;
    };
    std::erase_if(clients_, gone);
  }

  int listener_;
  std::size_t bytes_;
  int epoll_;
  int timer_ = -1;
  std::array<Packet, kRing> ring_;
  std::uint64_t sequence_ = 0;
  std::vector<std::unique_ptr<Client>> clients_;
};

}  // namespace

void serve_sse_epoll(int listener, double frames_per_second, std::size_t bytes) {
  Loop(listener, frames_per_second, bytes).run();
}

int listen_on_loopback(int& port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool good = ::bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0 && ::listen(socket, 4096) == 0 &&
                    getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  if (!good) {
    std::perror("listen");
    std::exit(1);
  }
  port = ntohs(address.sin_port);
  return socket;
}

}  // namespace vigil::bench
