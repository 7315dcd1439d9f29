// Recorded inputs of the user's own.
#include "engine/core/describe.hpp"
#include "engine/run/trace.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/services.hpp"

namespace vigil {
namespace {

constexpr std::size_t kTraceLimit = 64u << 20;
constexpr std::size_t kTraceCells = 20'000'000;

Json trace_json(const TraceRow& row) {
  return {{"id", std::to_string(row.id)},
          {"name", row.name},
          {"hash", row.hash},
          {"rows", row.rows},
          {"columns", row.columns},
          {"bytes", row.bytes},
          {"created", to_rfc3339(row.created)}};
}

TraceRow trace_row(const HttpRequest& request, const Services& services) {
  auto row = services.reader.trace(request.id_param("id"));
  if (!row) throw HttpError(404, "There is no trace " + request.params.at("id") + ".");
  return std::move(*row);
}

void create(Services& services, const HttpRequest& request, HttpResponse& response) {
  const std::string name = request.query_value("name");
  if (name.size() > 200)
    throw HttpError(400, "name is longer than 200 bytes.", {{"/name", "longer than 200 bytes", "200 bytes"}});
  if (!is_utf8(request.body)) throw InputError("", "the CSV is not UTF-8", "UTF-8");
  const Trace trace = Trace::from_csv(request.body, kTraceCells);
  const std::int64_t id = services.log.put_trace(name, request.body, trace.rows(), trace.columns());
  const auto row = services.reader.trace(id);
  if (!row) throw HttpError(404, "The trace was deleted at once.");
  response.json(trace_json(*row), 201);
  response.set_header("Location", "/api/v1/traces/" + std::to_string(id));
}

void list(const Services& services, HttpResponse& response) {
  Json answer{{"items", Json::array()}, {"next", nullptr}};
  for (const TraceRow& row : services.reader.traces()) answer["items"].push_back(trace_json(row));
  response.json(answer);
}

void one(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const TraceRow row = trace_row(request, services);
  if (!request.accepts("text/csv")) return response.json(trace_json(row));
  auto text = services.reader.trace_csv(row.id);
  if (!text) throw HttpError(404, "The trace was just deleted.");
  response.text(std::move(*text), "text/csv; charset=utf-8");
  response.set_header("Content-Disposition", "attachment; filename=\"trace-" + std::to_string(row.id) + ".csv\"");
}

}  // namespace

void add_trace_routes(Routes& routes, Services& services) {
  const Json trace{{"type", "object"}};
  Route post = make_route(
      "POST", "/api/v1/traces", [&services](const auto& q, auto& r) { create(services, q, r); },
      "Store a recorded input (CSV: k,t,<signal names>)",
      doc::Operation()
          .parameter(doc::query("name", doc::text_schema(), "a name for people"))
          .body(doc::text_schema(), "text/csv")
          .answer(201, "The trace; the same text again is the same trace.", trace)
          .problem(413, "Larger than 64 MiB.")
          .problem(422, "Not a trace: line and column are named.")
          .what());
  post.body_types = {"text/csv"};
  post.body_limit = kTraceLimit;
  routes.add(std::move(post));
  routes.add(make_route(
      "GET", "/api/v1/traces", [&services](const auto&, auto& r) { list(services, r); }, "All traces",
      doc::Operation().answer(200, "Every trace.", doc::page_schema(trace)).what()));
  routes.add(make_route(
      "GET", "/api/v1/traces/{id}", [&services](const auto& q, auto& r) { one(services, q, r); },
      "A trace: what it holds, or (Accept: text/csv) its text",
      doc::Operation()
          .answer(200, "The trace.", trace)
          .answer(200, "The trace.", doc::text_schema(), "text/csv")
          .problem(404, "There is no such trace.")
          .what()));
  routes.add(make_route(
      "DELETE", "/api/v1/traces/{id}",
      [&services](const auto& q, auto& r) {
        if (!services.log.delete_trace(trace_row(q, services).id)) throw HttpError(404, "There is no such trace.");
        r.empty();
      },
      "Delete a trace", doc::Operation().empty(204, "It is gone.").problem(404, "There is no such trace.").what()));
}

}  // namespace vigil
