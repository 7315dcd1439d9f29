#include "server/api/server.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <utility>

#include "engine/core/input_error.hpp"
#include "server/api/documentation_routes.hpp"
#include "server/api/papers_routes.hpp"
#include "server/api/services.hpp"
#include "server/papers/manager.hpp"
#include "server/runs/demo.hpp"

namespace vigil {
namespace {

constexpr const char* kNoPage =
    "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Vigil</title></head><body>"
    "<h1>The page is not built</h1>"
    "<p>The server runs and its API answers below <code>/api/v1</code>, but the page's files were not found.</p>"
    "<p>Build them with <code>cd web &amp;&amp; npm ci &amp;&amp; npm run build</code>, or start the server with "
    "<code>script/server</code>, which does that; <code>--web DIR</code> names another folder.</p></body></html>\n";

std::unique_ptr<Broker> connect(const NatsOptions& options) {
  if (options.url.empty()) return nullptr;
  try {
    return connect_nats(options);
  } catch (const std::runtime_error& failure) {
    throw InputError("/nats", std::string("--nats: ") + failure.what());
  }
}

/// The same wherever it is opened from, and like no other machine's.
std::string log_name(const std::string& db) {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  std::error_code error;
  return std::string(host) + ":" + std::filesystem::weakly_canonical(db, error).string();
}

ManagerOptions heard(ManagerOptions options, Outside& outside) {
  options.announcer = &outside.announcer();
  return options;
}

Route no_page_route() {
  Route route;
  route.method = "GET";
  route.pattern = "/";
  route.open = true;
  route.summary = "Says how to build the page, where it was not found";
  route.doc = {{"responses", {{"404", {{"description", "The page is not built."}}}}}};
  route.handler = [](const HttpRequest&, HttpResponse& response) {
    response.text(kNoPage, "text/html; charset=utf-8", 404);
  };
  return route;
}

}  // namespace

struct Server::State {
  explicit State(ServerOptions given)
      : options(std::move(given)),
        files(options.web ? StaticFiles(*options.web) : StaticFiles()),
        log(options.db, options.log),
        reader(options.db),
        hub(options.hub),
        broker(connect(options.nats)),
        outside({options.mqtt, broker.get(), options.nats_prefix}, reader),
        runs(log, reader, hub, heard(options.runs, outside)),
        campaigns(log, reader, hub, runs, {broker.get(), log_name(options.db)}),
        papers(log, reader, runs),
        services{log,
                 reader,
                 hub,
                 runs,
                 campaigns,
                 [this] { return front->stats(); },
                 [this]() -> const Routes& { return front->routes(); },
                 [this] { return demo.load() < 0 ? std::nullopt : std::optional<RunId>(demo.load()); },
                 options.front.tokens.required(),
                 broker.get(),
                 &outside} {
    Routes routes = make_routes(services);
    add_papers_routes(routes, papers);
    add_documentation_routes(routes);
    if (files.empty()) routes.add(no_page_route());
    front = std::make_unique<Front>(options.front, std::move(routes), hub, std::move(files));
  }

  ServerOptions options;
  StaticFiles files;
  LogWriter log;
  LogReader reader;
  Hub hub;
  std::unique_ptr<Broker> broker;
  Outside outside;
  std::atomic<RunId> demo{-1};
  RunManager runs;
  CampaignManager campaigns;
  PapersManager papers;
  Services services;
  std::unique_ptr<Front> front;
};

Server::Server(ServerOptions options) : state_(std::make_unique<State>(std::move(options))) {}
Server::~Server() { stop(); }

void Server::start() {
  state_->front->start();
  state_->outside.listen(state_->runs);
  state_->campaigns.take_up();
  state_->papers.take_up();
  if (!state_->options.demo) return;
  try {
    state_->demo = start_demo(state_->runs, state_->log, state_->reader);
  } catch (const std::exception& failure) {
    // A full disk, say: the server is still of use.
    spdlog::warn("the demo run did not start: {}", failure.what());
  }
}

int Server::port() const { return state_->front->port(); }

void Server::stop() {
  if (!state_) return;
  // Runs first: their viewers hear how they ended. Handlers that wait for a run are let go by its end.
  state_->outside.stop();
  state_->papers.stop();
  state_->campaigns.stop();
  state_->runs.stop();
  state_->front->stop();
  state_.reset();
}

}  // namespace vigil
