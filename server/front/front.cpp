#include "server/front/front.hpp"

#include <netdb.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "server/front/loop.hpp"

namespace vigil {
namespace {

constexpr int kBacklog = 4096;

struct Listener {
  int socket = -1;
  int port = 0;
};

int port_of(int socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  const bool v6 = address.ss_family == AF_INET6;
  return ntohs(v6 ? reinterpret_cast<sockaddr_in6&>(address).sin6_port
                  : reinterpret_cast<sockaddr_in&>(address).sin_port);
}

int open_listener(const addrinfo& address) {
  const int socket = ::socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return -1;
  const int on = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(socket, address.ai_addr, address.ai_addrlen) == 0 && ::listen(socket, kBacklog) == 0) return socket;
  const int error = errno;
  ::close(socket);
  errno = error;
  return -1;
}

Listener listen_on(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const std::string where = host + ":" + std::to_string(port);
  const int result = getaddrinfo(host.empty() ? nullptr : host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (result != 0) throw std::runtime_error("cannot listen on " + where + ": " + gai_strerror(result));
  int socket = -1;
  for (const addrinfo* each = found; each && socket < 0; each = each->ai_next) socket = open_listener(*each);
  const int error = errno;
  freeaddrinfo(found);
  if (socket < 0) throw std::runtime_error("cannot listen on " + where + ": " + std::strerror(error));
  return {socket, port_of(socket)};
}

void add_session_routes(Routes& routes, Doorkeeper& keeper) {
  Route begin;
  begin.method = "POST";
  begin.pattern = "/api/v1/session";
  begin.summary = "Exchange a bearer token for the page's cookie";
  begin.open = true;
  begin.body_types = {};
  begin.handler = [&keeper](const HttpRequest& request, HttpResponse& response) {
    const Access access = keeper.access(request.header("authorization"), "");
    if (access == Access::none) {
      throw HttpError(401, "Send the token as \"Authorization: Bearer …\".")
          .with_header("WWW-Authenticate", "Bearer realm=\"vigil\"");
    }
    response.json(Json{{"access", access == Access::full ? "full" : "viewer"}});
    if (keeper.required()) response.set_header("Set-Cookie", keeper.open_session(access));
  };
  Route end = begin;
  end.method = "DELETE";
  end.summary = "End the page's session";
  end.handler = [&keeper](const HttpRequest& request, HttpResponse& response) {
    response.set_header("Set-Cookie", keeper.close_session(request.header("cookie")));
    response.empty();
  };
  routes.add(std::move(begin));
  routes.add(std::move(end));
}

}  // namespace

struct Front::State {
  State(FrontOptions given, Routes table, Hub& feeds, StaticFiles page)
      : options(std::move(given)),
        routes(std::move(table)),
        files(std::move(page)),
        keeper(options.tokens),
        hub(feeds),
        door(options.host, options.allow_hosts, options.body_limit, routes, files, keeper),
        engine(routes, files, {1u << 20, std::max(1, options.workers / 2), options.write_deadline}) {
    add_session_routes(routes, keeper);
  }

  FrontOptions options;
  Routes routes;
  StaticFiles files;
  Doorkeeper keeper;
  Hub& hub;
  Door door;
  Engine engine;
  int port = 0;
  std::unique_ptr<Loop> loop;
  std::unique_ptr<Workers> workers;
  std::thread thread;
};

Front::Front(FrontOptions options, Routes routes, Hub& hub, StaticFiles files)
    : state_(std::make_unique<State>(std::move(options), std::move(routes), hub, std::move(files))) {}

Front::~Front() { stop(); }

void Front::start() {
  std::signal(SIGPIPE, SIG_IGN);
  const Listener listener = listen_on(state_->options.host, state_->options.port);
  state_->port = listener.port;
  state_->loop = std::make_unique<Loop>(state_->options, state_->door, state_->hub, listener.socket);
  Loop* loop = state_->loop.get();
  state_->workers =
      std::make_unique<Workers>(state_->engine, std::max(1, state_->options.workers), state_->options.queue,
                                [loop](Done done) { loop->finished(std::move(done)); });
  loop->set_workers(state_->workers.get());
  state_->hub.set_waker([loop] { loop->wake(); });
  state_->thread = std::thread([loop] { loop->run(); });
}

int Front::port() const { return state_->port; }

void Front::stop() {
  if (!state_->thread.joinable()) return;
  state_->loop->stop();
  state_->thread.join();
  state_->hub.set_waker({});
  state_->engine.abort();
  state_->workers->stop();
  state_->loop->release(true);
}

const Routes& Front::routes() const { return state_->routes; }

FrontStats Front::stats() const {
  FrontStats stats;
  if (!state_->loop) return stats;
  const LoopCounters& counters = state_->loop->counters();
  stats.requests = counters.requests;
  stats.refused = counters.refused;
  stats.bytes_streamed = counters.bytes_streamed;
  stats.connections = counters.connections;
  stats.viewers = state_->hub.viewers();
  stats.queued = state_->workers->queued();
  return stats;
}

}  // namespace vigil
