#include <sys/epoll.h>
#include <sys/socket.h>

#include <cerrno>

#include "server/front/loop.hpp"

namespace vigil {
namespace {

constexpr HeadLimits kLimits;
/// All bodies that are coming in at one time: slow senders must not add up.
constexpr std::size_t kBodiesAtOnce = 512u << 20;
constexpr std::size_t kReserve = 1u << 20;

/// False if a part is not valid percent-encoding.
bool parse_query(std::string_view text, std::vector<std::pair<std::string, std::string>>& query) {
  while (!text.empty()) {
    const auto end = text.find('&');
    const std::string_view pair = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (pair.empty()) continue;
    const auto equals = pair.find('=');
    auto name = percent_decode(pair.substr(0, equals), true);
    auto value = percent_decode(equals == std::string_view::npos ? std::string_view() : pair.substr(equals + 1), true);
    if (!name || !value) return false;
    query.emplace_back(std::move(*name), std::move(*value));
  }
  return true;
}

}  // namespace

void Loop::readable(Connection& connection) {
  const ssize_t count = ::recv(connection.socket, buffer_.data(), buffer_.size(), 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count <= 0) {
    close(connection);
    return;
  }
  if (connection.state == State::streaming || connection.state == State::lingering) return;  // said too late: not heard
  if (connection.state == State::head && connection.in.empty())
    connection.deadline = Clock::now() + options_.head_deadline;
  connection.in.append(buffer_.data(), static_cast<std::size_t>(count));
  advance(connection);
}

void Loop::advance(Connection& connection) {
  while (!connection.dead) {
    bool moved = false;
    switch (connection.state) {
      case State::head:
        moved = step_head(connection);
        break;
      case State::body:
        moved = step_body(connection);
        break;
      case State::writing:
        moved = step_write(connection);
        break;
      default:
        return;
    }
    if (!moved) return;
  }
}

bool Loop::step_head(Connection& connection) {
  std::string& in = connection.in;
  // Some clients send an empty line after a body: the standard asks to overlook it.
  if (in.starts_with("\r\n")) in.erase(0, 2);
  if (in == "\r") in.clear();
  Refusal refusal;
  const std::size_t length = connection.scan.scan(in, kLimits, refusal);
  if (!refusal && length == 0) {
    arm(connection, EPOLLIN);
    return false;
  }
  if (!refusal) refusal = parse_head(std::string_view(in).substr(0, length), kLimits, connection.head);
  connection.scan.reset();
  if (refusal) {
    refuse(connection, refusal, {}, false);
    return true;
  }
  in.erase(0, length);
  admit_request(connection);
  return !connection.dead && connection.state != State::working && connection.state != State::streaming;
}

void Loop::admit_request(Connection& connection) {
  const Head& head = connection.head;
  connection.pass = door_.check(head, connection.local);
  const Pass& pass = connection.pass;
  const std::size_t length = head.content_length.value_or(0);
  if (pass.refusal) {
    refuse(connection, pass.refusal, pass.headers, head.keep_alive && length == 0);
  } else if (pass.options) {
    reply(connection, raw_reply(204, pass.headers, "", "", head.keep_alive && length == 0),
          head.keep_alive && length == 0);
  } else if (length == 0) {
    complete(connection);
  } else if (bodies_ + length > kBodiesAtOnce) {
    refuse(connection, {503, "Too many large bodies are coming in at once: try again in a moment."},
           {{"Retry-After", "2"}}, false);
  } else {
    bodies_ += length;
    connection.body_wanted = length;
    connection.body.clear();
    connection.body.reserve(std::min(length, kReserve));
    connection.deadline = Clock::now() + options_.body_deadline + std::chrono::seconds(length / 100'000);
    connection.state = State::body;
    static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
    if (head.expects_continue && connection.in.empty()) {
      ::send(connection.socket, kContinue.data(), kContinue.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    }
  }
}

bool Loop::step_body(Connection& connection) {
  const std::size_t missing = connection.body_wanted - connection.body.size();
  if (connection.in.size() <= missing && connection.body.empty() && connection.in.size() == connection.body_wanted) {
    connection.body.swap(connection.in);
  } else {
    const std::size_t taken = std::min(missing, connection.in.size());
    connection.body.append(connection.in, 0, taken);
    connection.in.erase(0, taken);
  }
  if (connection.body.size() < connection.body_wanted) {
    arm(connection, EPOLLIN);
    return false;
  }
  bodies_ -= connection.body_wanted;
  connection.body_wanted = 0;
  complete(connection);
  return !connection.dead && connection.state != State::working && connection.state != State::streaming;
}

HttpRequest Loop::make_request(Connection& connection) {
  HttpRequest request;
  request.id = id_prefix_ + std::to_string(next_request_++);
  request.method = connection.head.method == "HEAD" ? "GET" : connection.head.method;
  request.path = connection.head.path;
  request.body = std::move(connection.body);
  request.remote = connection.remote;
  request.access = connection.pass.access;
  request.params = std::move(connection.pass.match.params);
  request.headers = connection.head.fields;
  connection.body = std::string();
  return request;
}

void Loop::complete(Connection& connection) {
  HttpRequest request = make_request(connection);
  if (!parse_query(connection.head.query, request.query)) {
    refuse(connection, {400, "The query is not valid percent-encoded UTF-8."}, {}, connection.head.keep_alive);
    return;
  }
  const Route* route = connection.pass.match.route;
  if (route && route->stream) {
    open_stream(connection, std::move(request));
  } else {
    dispatch(connection, std::move(request));
  }
}

void Loop::dispatch(Connection& connection, HttpRequest request) {
  Job job;
  job.connection = connection.id;
  job.socket = connection.socket;
  job.request = std::move(request);
  job.route = connection.pass.match.route;
  job.head_only = connection.head.method == "HEAD";
  job.keep_alive = connection.head.keep_alive && !stopping_;
  arm(connection, 0);
  connection.state = State::working;
  if (workers_->submit(job)) {
    ++counters_.requests;
    return;
  }
  refuse(connection, {503, "The server is busy: try again in a moment."}, {{"Retry-After", "1"}},
         connection.head.keep_alive);
}

}  // namespace vigil
