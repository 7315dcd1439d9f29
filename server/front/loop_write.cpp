#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <array>
#include <cerrno>

#include "server/front/loop.hpp"
#include "server/hub/viewer.hpp"

namespace vigil {
namespace {

constexpr int kSendBuffer = 64 * 1024;  // bounds what a stalled viewer holds in the kernel
constexpr auto kLinger = std::chrono::seconds(2);
constexpr int kParts = 16;

}  // namespace

void Loop::reply(Connection& connection, std::string bytes, bool keep_alive) {
  if (connection.state == State::body) bodies_ -= connection.body_wanted;
  connection.body_wanted = 0;
  connection.body = std::string();
  connection.out = std::move(bytes);
  connection.out_at = 0;
  connection.keep_alive = keep_alive && !stopping_;
  connection.state = State::writing;
  connection.deadline = Clock::now() + options_.write_deadline;
}

void Loop::refuse(Connection& connection, const Refusal& refusal, const HeaderList& headers, bool keep_alive) {
  ++counters_.refused;
  const bool head_only = connection.head.method == "HEAD" && keep_alive;
  reply(connection, raw_problem(refusal.status, refusal.detail, headers, keep_alive, head_only), keep_alive);
}

/// True when the answer is out and the connection may go on.
bool Loop::step_write(Connection& connection) {
  std::string& out = connection.out;
  while (connection.out_at < out.size()) {
    const ssize_t count =
        ::send(connection.socket, out.data() + connection.out_at, out.size() - connection.out_at, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) {
      arm(connection, EPOLLOUT);
      return false;
    }
    if (count <= 0) {
      close(connection);
      return false;
    }
    connection.out_at += static_cast<std::size_t>(count);
    connection.deadline = Clock::now() + options_.write_deadline;
  }
  out = std::string();
  if (connection.keep_alive && !stopping_) {
    connection.state = State::head;
    connection.deadline = Clock::now() + (connection.in.empty() ? options_.idle_deadline : options_.head_deadline);
    return true;
  }
  ::shutdown(connection.socket, SHUT_WR);
  connection.state = State::lingering;
  connection.in = std::string();
  connection.deadline = Clock::now() + kLinger;
  if (stopping_) {
    close(connection);
  } else {
    arm(connection, EPOLLIN);
  }
  return false;
}

void Loop::open_stream(Connection& connection, HttpRequest request) {
  StreamTarget target;
  try {
    target = connection.pass.match.route->stream(request);
  } catch (const HttpError& error) {
    refuse(connection, {error.status(), error.what()}, error.headers(), connection.head.keep_alive);
    return;
  } catch (const std::exception&) {
    refuse(connection, {500, "Something went wrong in the server."}, {}, false);
    return;
  }
  std::string last = request.header("last-event-id");
  if (last.empty()) last = request.query_value("lastEventId");
  Hub::Attached attached = hub_.attach(target.run.value_or(-1), target.topic, last);
  switch (attached.result) {
    case Hub::Attach::ok:
      start_viewing(connection, std::move(attached.viewer));
      return;
    case Hub::Attach::busy:
      reply(connection, stream_head() + attached.text, false);
      return;
    case Hub::Attach::ended:
      reply(connection, raw_reply(204, {}, "", "", connection.head.keep_alive), connection.head.keep_alive);
      return;
    case Hub::Attach::unknown_topic:
      refuse(connection, {404, "This run has no topic \"" + target.topic + "\"."}, {}, connection.head.keep_alive);
      return;
    case Hub::Attach::unknown_run:
      dispatch(connection, std::move(request));
  }
}

void Loop::start_viewing(Connection& connection, std::shared_ptr<Viewer> viewer) {
  viewer->owner = &connection;
  connection.viewer = std::move(viewer);
  connection.state = State::streaming;
  connection.head = Head();
  connection.pass = Pass();
  connection.in = std::string();
  setsockopt(connection.socket, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
  const std::string head = stream_head();
  // The socket is fresh from a request: a head of 700 bytes fits its buffer, or the client reads nothing at all.
  if (::send(connection.socket, head.data(), head.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(head.size())) {
    close(connection);
    return;
  }
  arm(connection, EPOLLIN | EPOLLRDHUP);
  pump(connection);
}

void Loop::pump(Connection& connection) {
  std::array<iovec, kParts> parts;
  while (true) {
    const int count = connection.viewer->gather(parts.data(), kParts);
    if (count == 0) break;
    std::size_t total = 0;
    for (int i = 0; i < count; ++i) total += parts[static_cast<std::size_t>(i)].iov_len;
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = static_cast<std::size_t>(count);
    const ssize_t result = ::sendmsg(connection.socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (result < 0 && errno != EAGAIN && errno != EINTR) {
      close(connection);
      return;
    }
    const std::size_t sent = result < 0 ? 0 : static_cast<std::size_t>(result);
    connection.viewer->sent(sent);
    counters_.bytes_streamed.fetch_add(sent, std::memory_order_relaxed);
    if (sent > 0) connection.progress = Clock::now();
    if (sent < total) {
      set_blocked(connection, true);
      return;
    }
  }
  set_blocked(connection, false);
  if (!connection.viewer->finished()) return;
  reply(connection, {}, false);  // shuts the sending side and waits for the client to close
  advance(connection);
}

void Loop::set_blocked(Connection& connection, bool blocked) {
  if (connection.blocked == blocked) return;
  connection.blocked = blocked;
  if (blocked) connection.progress = Clock::now();
  arm(connection, EPOLLIN | EPOLLRDHUP | (blocked ? EPOLLOUT : 0u));
}

}  // namespace vigil
