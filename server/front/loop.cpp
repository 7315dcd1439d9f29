#include "server/front/loop.hpp"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <stdexcept>

#include "server/hub/viewer.hpp"

namespace vigil {
namespace {

constexpr auto kSweep = std::chrono::milliseconds(200);
constexpr std::size_t kReadBuffer = 64 * 1024;

std::string random_prefix() {
  std::random_device device;
  static constexpr char kHex[] = "0123456789abcdef";
  std::string prefix;
  for (int i = 0; i < 6; ++i) prefix += kHex[device() & 15];
  return prefix + "-";
}

}  // namespace

Loop::Loop(const FrontOptions& options, const Door& door, Hub& hub, int listener)
    : options_(options),
      door_(door),
      hub_(hub),
      listener_(listener),
      id_prefix_(random_prefix()),
      buffer_(kReadBuffer, '\0') {
  epoll_ = epoll_create1(EPOLL_CLOEXEC);
  wake_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (epoll_ < 0 || wake_ < 0)
    throw std::runtime_error(std::string("cannot start the server's loop: ") + std::strerror(errno));
  for (int* fd : {&listener_, &wake_}) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.ptr = fd;
    epoll_ctl(epoll_, EPOLL_CTL_ADD, *fd, &event);
  }
  next_sweep_ = next_collect_ = Clock::now();
}

Loop::~Loop() {
  for (auto& [id, connection] : connections_) {
    if (connection->socket >= 0) ::close(connection->socket);
  }
  for (const int fd : {listener_, epoll_, wake_}) {
    if (fd >= 0) ::close(fd);
  }
}

void Loop::wake() {
  const std::uint64_t one = 1;
  if (::write(wake_, &one, sizeof one) < 0) return;  // the counter is full: it is awake already
}

void Loop::stop() {
  stop_asked_ = true;
  wake();
}

void Loop::finished(Done done) {
  {
    const std::lock_guard lock(done_mutex_);
    done_.push_back(std::move(done));
  }
  wake();
}

int Loop::turn_timeout() const {
  auto next = next_collect_;
  if (!connections_.empty() || !accepting_ || stopping_) next = std::min(next, next_sweep_);
  const auto wait = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(wait, 0, 1000));
}

void Loop::run() {
  std::array<epoll_event, 256> events;
  while (!stopped()) {
    const int count = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), turn_timeout());
    bool woken = false;
    for (int i = 0; i < count; ++i) {
      const auto& event = events[static_cast<std::size_t>(i)];
      if (event.data.ptr == &listener_) {
        accept_all();
      } else if (event.data.ptr == &wake_) {
        std::uint64_t seen = 0;
        woken = ::read(wake_, &seen, sizeof seen) > 0;
      } else {
        handle(*static_cast<Connection*>(event.data.ptr), event.events);
      }
    }
    if (stop_asked_ && !stopping_) begin_stop();
    if (woken) take_finished();
    if (woken || Clock::now() >= next_collect_) {
      const auto sleep = hub_.collect([this](Viewer& viewer) {
        auto& connection = *static_cast<Connection*>(viewer.owner);
        if (!connection.dead && !connection.blocked) pump(connection);
      });
      next_collect_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(sleep);
    }
    if (Clock::now() >= next_sweep_) sweep();
    bury();
  }
  release(false);
}

void Loop::release(bool working_too) {
  for (auto& [id, connection] : connections_) {
    if (working_too || connection->state != State::working) close(*connection);
  }
  bury();
}

void Loop::handle(Connection& connection, std::uint32_t events) {
  if (connection.dead) return;
  const bool gone =
      (events & (EPOLLERR | EPOLLHUP)) != 0 || (connection.state == State::streaming && (events & EPOLLRDHUP) != 0);
  if (gone) {
    close(connection);
    return;
  }
  if ((events & EPOLLIN) != 0) readable(connection);
  if (connection.dead || (events & EPOLLOUT) == 0) return;
  if (connection.state == State::streaming) {
    pump(connection);
  } else if (connection.state == State::writing) {
    advance(connection);
  }
}

void Loop::take_finished() {
  std::vector<Done> batch;
  {
    const std::lock_guard lock(done_mutex_);
    batch.swap(done_);
  }
  for (Done& done : batch) {
    const auto found = connections_.find(done.connection);
    if (found == connections_.end()) continue;
    Connection& connection = *found->second;
    if (done.failed) {
      close(connection);
      continue;
    }
    reply(connection, std::move(done.bytes), done.keep_alive);
    advance(connection);
  }
}

void Loop::sweep() {
  const auto now = Clock::now();
  next_sweep_ = now + kSweep;
  if (!accepting_ && now >= accept_again_) resume_accepting();
  for (auto& [id, connection] : connections_) {
    if (connection->dead || connection->state == State::working) continue;
    if (connection->state == State::streaming) {
      if (connection->blocked && now - connection->progress > options_.stuck_deadline) close(*connection);
    } else if (now > connection->deadline) {
      expire(*connection);
    }
  }
}

void Loop::expire(Connection& connection) {
  const bool asked = connection.state == State::body || (connection.state == State::head && !connection.in.empty());
  if (!asked) {
    close(connection);
    return;
  }
  refuse(connection, {408, "The request did not arrive whole in time."}, {}, false);
  advance(connection);
}

void Loop::begin_stop() {
  stopping_ = true;
  stop_by_ = Clock::now() + options_.stop_deadline;
  ::close(listener_);
  listener_ = -1;
  for (auto& [id, connection] : connections_) {
    if (connection->dead) continue;
    if (connection->state == State::streaming) {
      connection->viewer->finish();
      if (!connection->blocked) pump(*connection);
    } else if (connection->state == State::head || connection->state == State::body ||
               connection->state == State::lingering) {
      close(*connection);
    } else {
      connection->keep_alive = false;
    }
  }
  bury();
}

bool Loop::stopped() const { return stopping_ && (connections_.empty() || Clock::now() > stop_by_); }

}  // namespace vigil
