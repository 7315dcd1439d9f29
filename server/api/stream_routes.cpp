// Where a browser listens. The hub speaks; these routes only say who it is about, and what to answer when all is over.
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/run_json.hpp"
#include "server/api/services.hpp"

namespace vigil {
namespace {

/// Reached only where the hub does not know the run: it has ended (of an earlier server, say), has not begun, or never
/// was.
void ended(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const RunRow row = run_row(request, services);
  if (row.state == "designing")
    throw HttpError(409, "The run is designing: its stream begins when its gains are found.");
  response.empty(204);
}

}  // namespace

void add_stream_routes(Routes& routes, Services& services) {
  const Json events = doc::text_schema("events hello, frame, mark, gap, ping, end, busy; see docs/api.md");
  Route run = make_route(
      "GET", "/api/v1/runs/{id}/stream", [&services](const auto& q, auto& r) { ended(services, q, r); },
      "Frames and marks of a run as they are made",
      doc::Operation()
          .parameter(doc::query("topic", doc::text_schema(), "overview (without), lane:<lane>, all"))
          .parameter(doc::query("lastEventId", doc::text_schema(), "resume after this event; the header wins"))
          .parameter(doc::header("Last-Event-ID", "resume after this event"))
          .answer(200, "Server-sent events.", events, "text/event-stream")
          .empty(204, "The run is over: nothing will come.")
          .problem(404, "There is no such run or topic.")
          .problem(409, "The run is designing; GET /stream tells when that is over.")
          .what());
  run.stream = [](const HttpRequest& request) {
    return StreamTarget{request.id_param("id"), request.query_value("topic")};
  };
  routes.add(std::move(run));

  Route global = make_route(
      "GET", "/api/v1/stream", [](const auto&, auto& r) { r.empty(204); },
      "Run states, progress and alarms of the whole server",
      doc::Operation().answer(200, "Server-sent events run, alarm, ping.", events, "text/event-stream").what());
  global.stream = [](const HttpRequest&) { return StreamTarget{}; };
  routes.add(std::move(global));
}

}  // namespace vigil
