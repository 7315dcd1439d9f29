// About the server itself.
#include "engine/scenario/scenario.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/openapi.hpp"
#include "server/api/services.hpp"

namespace vigil {
namespace {

Json server_json(const Services& services) {
  const RunManager::Counts counts = services.runs.counts();
  const LogHealth health = services.log.health();
  const auto demo = services.demo();
  Json info;
  info["version"] = std::string(version());
  info["uptime"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - services.started).count();
  info["runs"] = {
      {"running", counts.running}, {"queued", counts.queued}, {"designing", counts.designing}, {"max", counts.max}};
  info["viewers"] = services.hub.viewers();
  info["log"] = {{"bytes", health.bytes},
                 {"queue", health.queue_bytes},
                 {"state", to_string(health.state)},
                 {"dropped", health.dropped}};
  info["demo"] = demo ? Json(std::to_string(*demo)) : Json();
  info["auth"] = services.auth;
  info["nats"] = services.broker != nullptr ? Json{{"connected", services.broker->connected()}} : Json();
  info["alarms"] = services.outside->alarms();
  info["mqtt"] = services.outside->listens() ? services.outside->plant() : Json();
  return info;
}

void ready(const Services& services, HttpResponse& response) {
  const LogHealth health = services.log.health();
  if (health.state == LogHealth::State::ok) return response.text("ready\n");
  throw HttpError(503, "The log is degraded: " + health.sentence).with_header("Retry-After", "5");
}

Route open_route(const char* pattern, Handler handler, const char* summary, Json what) {
  Route route = make_route("GET", pattern, std::move(handler), summary, std::move(what));
  route.open = true;
  return route;
}

}  // namespace

void add_system_routes(Routes& routes, Services& services) {
  const Json any{{"type", "object"}};
  routes.add(make_route(
      "GET", "/api/v1/server", [&services](const auto&, auto& r) { r.json(server_json(services)); },
      "Version, uptime, runs, viewers, the log's state", doc::Operation().answer(200, "The server.", any).what()));
  routes.add(make_route(
      "GET", "/api/v1/openapi.json", [&services](const auto&, auto& r) { r.json(openapi_json(services.routes())); },
      "This description", doc::Operation().answer(200, "OpenAPI 3.1.", any).what()));
  const auto health = doc::Operation().answer(200, "It is.", doc::text_schema(), "text/plain");
  routes.add(open_route(
      "/healthz", [](const auto&, auto& r) { r.text("ok\n"); }, "Whether the server is alive", health.what()));
  routes.add(open_route(
      "/readyz", [&services](const auto&, auto& r) { ready(services, r); }, "Whether the server can do its work",
      doc::Operation(health).problem(503, "The log cannot be written at the moment.").what()));
}

Routes make_routes(Services& services) {
  Routes routes;
  add_scenario_routes(routes, services);
  add_run_routes(routes, services);
  add_control_routes(routes, services);
  add_design_routes(routes, services);
  add_check_routes(routes, services);
  add_compatibility_routes(routes, services);
  add_data_routes(routes, services);
  add_compare_routes(routes, services);
  add_campaign_routes(routes, services);
  add_bundle_routes(routes, services);
  add_trace_routes(routes, services);
  add_ingest_routes(routes, services);
  add_stream_routes(routes, services);
  add_system_routes(routes, services);
  add_metrics_route(routes, services);
  return routes;
}

}  // namespace vigil
