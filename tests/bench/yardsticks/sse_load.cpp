#include "tests/bench/yardsticks/sse_load.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace vigil::bench {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::string_view kMark = "\nid: ";  // once a frame, at the begin of its event

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

Viewers::Viewers(int count) : viewers_(static_cast<std::size_t>(count)), epoll_(epoll_create1(0)), buffer_(1 << 18) {}

Viewers::~Viewers() {
  for (const auto& viewer : viewers_) {
    if (viewer.socket >= 0) ::close(viewer.socket);
  }
  ::close(epoll_);
}

void Viewers::connect(int port, const std::string& path) {
  const std::string request = "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nAccept: text/event-stream\r\n\r\n";
  for (std::size_t i = 0; i < viewers_.size(); ++i) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return;
    if (::send(socket, request.data(), request.size(), MSG_NOSIGNAL) < 0) return;
    viewers_[i].socket = socket;
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = i;
    epoll_ctl(epoll_, EPOLL_CTL_ADD, socket, &event);
    if (i % 32 == 31) receive(0);
  }
}

void Viewers::receive(int milliseconds) {
  std::array<epoll_event, 512> events;
  const int count = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), milliseconds);
  for (int i = 0; i < count; ++i) take(viewers_[events[static_cast<std::size_t>(i)].data.u64]);
}

void Viewers::receive_for(double seconds) {
  for (const auto start = Clock::now(); since(start) < seconds;) receive(20);
}

void Viewers::take(Viewer& viewer) {
  const ssize_t count = ::recv(viewer.socket, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
  if (count <= 0) {
    if (count == 0) epoll_ctl(epoll_, EPOLL_CTL_DEL, viewer.socket, nullptr);
    return;
  }
  if (!viewer.started) ++started_;
  viewer.started = true;
  bytes_ += static_cast<std::uint64_t>(count);
  count_marks(viewer, std::string_view(buffer_.data(), static_cast<std::size_t>(count)));
}

/// A chunk's size ends with a line break, so every frame's id stands behind one.
void Viewers::count_marks(Viewer& viewer, std::string_view text) {
  while (viewer.matched > 0 && !text.empty()) {
    viewer.matched = text.front() == kMark[viewer.matched] ? viewer.matched + 1 : 0;
    text.remove_prefix(1);
    if (viewer.matched == kMark.size()) {
      ++frames_;
      viewer.matched = 0;
    }
  }
  const char* at = text.data();
  const char* const end = at + text.size();
  while (const void* found = memmem(at, static_cast<std::size_t>(end - at), kMark.data(), kMark.size())) {
    ++frames_;
    at = static_cast<const char*>(found) + kMark.size();
  }
  const std::string_view rest(at, static_cast<std::size_t>(end - at));
  for (std::size_t length = kMark.size() - 1; length > 0; --length) {
    if (rest.ends_with(kMark.substr(0, length))) {
      viewer.matched = length;
      return;
    }
  }
}

double process_cpu(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

LoadResult watch(int port, const std::string& path, pid_t server, const Load& load) {
  Viewers viewers(load.viewers);
  viewers.connect(port, path);
  for (const auto start = Clock::now(); viewers.started() < load.viewers && since(start) < 20;) viewers.receive(20);
  viewers.receive_for(load.warm_up);
  const std::uint64_t frames = viewers.frames();
  const std::uint64_t bytes = viewers.bytes();
  const double cpu = process_cpu(server);
  const auto start = Clock::now();
  viewers.receive_for(load.seconds);
  const double elapsed = since(start);
  LoadResult result;
  result.connected = viewers.started();
  const auto counted = static_cast<double>(viewers.frames() - frames);
  result.frames_per_second = counted / elapsed;
  result.server_cpu = (process_cpu(server) - cpu) / elapsed;
  result.bytes_per_frame = counted > 0 ? static_cast<double>(viewers.bytes() - bytes) / counted : 0;
  return result;
}

}  // namespace vigil::bench
