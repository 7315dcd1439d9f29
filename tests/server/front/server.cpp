#include "tests/server/front/server.hpp"

namespace vigil::test {
namespace {

Route route(std::string method, std::string pattern, Handler handler) {
  Route route;
  route.method = std::move(method);
  route.pattern = std::move(pattern);
  route.handler = std::move(handler);
  return route;
}

void echo(const HttpRequest& request, HttpResponse& response) {
  Json out;
  out["method"] = request.method;
  out["body"] = request.body;
  out["remote"] = request.remote;
  out["forged"] = request.header("REMOTE_ADDR");
  for (const auto& [name, value] : request.params) out["params"][name] = value;
  for (const auto& [name, value] : request.query) out["query"][name] = value;
  response.json(out);
}

void long_body(const HttpRequest& request, HttpResponse& response) {
  const auto parts = request.query_int("parts", 1, 0, 100'000);
  const bool cut = request.has_query("cut");
  response.content_type = "text/csv";
  response.stream = [parts, cut](const BodyWriter& write) {
    const std::string part(10'000, 'x');
    for (std::int64_t i = 0; i < parts; ++i) {
      if (!write(part)) return false;
    }
    if (cut) throw std::runtime_error("the secret reason");
    return true;
  };
}

Routes make_routes(Gate& gate) {
  Routes routes;
  routes.add(route("GET", "/api/v1/echo/{name}", echo));
  routes.add(route("GET", "/api/v1/ok", [](const HttpRequest&, HttpResponse& response) {
    response.json(Json{{"ok", true}});
  }));
  Route csv = route("POST", "/api/v1/echo", echo);
  csv.body_types = {"application/json", "text/csv"};
  routes.add(csv);
  routes.add(route("DELETE", "/api/v1/echo/{name}", echo));
  routes.add(route("POST", "/api/v1/json",
                   [](const HttpRequest& request, HttpResponse& response) { response.json(request.json()); }));
  routes.add(route("GET", "/api/v1/boom",
                   [](const HttpRequest&, HttpResponse&) { throw std::runtime_error("the secret reason"); }));
  routes.add(route("GET", "/api/v1/odd", [](const HttpRequest&, HttpResponse&) { throw 7; }));
  routes.add(route("GET", "/api/v1/input",
                   [](const HttpRequest&, HttpResponse&) { throw InputError("/a", "a is 3, but must be 1", "1"); }));
  routes.add(route("GET", "/api/v1/long", long_body));
  routes.add(route("GET", "/api/v1/wait", [&gate](const HttpRequest&, HttpResponse& response) {
    gate.pass();
    response.json(Json{{"waited", true}});
  }));
  Route health = route("GET", "/healthz", [](const HttpRequest&, HttpResponse& response) { response.text("ok\n"); });
  health.open = true;
  routes.add(health);
  Route stream = route("GET", "/api/v1/runs/{id}/stream",
                       [](const HttpRequest&, HttpResponse&) { throw HttpError(404, "There is no such run."); });
  stream.stream = [](const HttpRequest& request) {
    return StreamTarget{request.id_param("id"), request.query_value("topic")};
  };
  routes.add(stream);
  stream.pattern = "/api/v1/stream";
  stream.stream = [](const HttpRequest&) { return StreamTarget{}; };
  routes.add(stream);
  return routes;
}

}  // namespace

void Gate::open() {
  const std::lock_guard lock(mutex_);
  open_ = true;
  changed_.notify_all();
}

void Gate::pass() {
  std::unique_lock lock(mutex_);
  ++waiting_;
  changed_.wait(lock, [this] { return open_; });
  --waiting_;
}

int Gate::waiting() const {
  const std::lock_guard lock(mutex_);
  return waiting_;
}

Server::Server(ServerOptions options) : hub(options.hub) {
  options.front.port = 0;
  front = std::make_unique<Front>(options.front, make_routes(gate), hub, std::move(options.files));
  front->start();
}

Server::~Server() {
  gate.open();
  front->stop();
}

Catalogue catalogue_of(int count) {
  Catalogue catalogue;
  for (int i = 0; i < count; ++i) {
    Signal signal;
    signal.name = "s" + std::to_string(i);
    catalogue.add(std::move(signal));
  }
  return catalogue;
}

Frame frame_of(std::int64_t k, int count) {
  Frame frame;
  frame.k = k;
  frame.t = static_cast<double>(k) * 0.05;
  for (int i = 0; i < count; ++i) frame.values.push_back(static_cast<double>(k) + 0.5 * i);
  return frame;
}

std::vector<HubTopic> overview_of(int count) {
  HubTopic topic{"overview", {}};
  for (int i = 0; i < count; ++i) topic.signals.push_back(i);
  return {topic};
}

}  // namespace vigil::test
