// Runs: start, find, look at, delete.
#include <chrono>

#include "db/query.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"
#include "server/api/run_json.hpp"

namespace vigil {
namespace {

WallTime now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

const Json kRun{{"type", "object"}};

void create(Services& services, const HttpRequest& request, HttpResponse& response) {
  RunOrder order = read_order(request, services);
  const CreatedRun created = services.runs.create(std::move(order));
  const auto row = services.reader.run(created.id);
  if (!row) throw HttpError(404, "The run that this Idempotency-Key made was deleted.");
  response.json(run_detail(*row, services), 201);
  response.set_header("Location", "/api/v1/runs/" + std::to_string(created.id));
  if (!created.fresh) response.set_header("Idempotency-Replayed", "true");
}

void list(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const Query query = Query::parse(request.query_value("q"), now());
  const int limit = static_cast<int>(request.query_int("limit", 50, 1, 500));
  const RunPage page = services.reader.list(query, request.query_value("sort"), limit, request.query_value("cursor"));
  Json answer{{"items", Json::array()}, {"next", page.next ? Json(*page.next) : Json()}};
  for (const RunRow& row : page.items) answer["items"].push_back(run_item(row, services));
  response.json(answer);
}

Json create_doc() {
  const Json scenario{{"oneOf", {{{"type", "string"}}, {{"type", "object"}}}},
                      {"description", "an id or a whole document"}};
  const Json pace{{"oneOf", {{{"const", "max"}}, {{"type", "number"}, {"minimum", 0.001}, {"maximum", 100000}}}}};
  const Json trace = doc::object_schema({{"trace", doc::text_schema("id of a trace")}}, {"trace"});
  const Json ingest = doc::object_schema(
      {{"ingest", doc::object_schema({{"deadline", {{"type", "number"}, {"minimum", 0.001}, {"maximum", 3600}}},
                                      {"columns", {{"type", "array"}, {"items", {{"type", "string"}}}}}})}},
      {"ingest"});
  const Json input{{"oneOf", {{{"const", "simulate"}}, trace, {{"const", "ingest"}}, ingest}}};
  const Json tags{
      {"type", "array"}, {"maxItems", 32}, {"items", {{"type", "string"}, {"minLength", 1}, {"maxLength", 64}}}};
  return doc::Operation()
      .parameter(doc::header("Idempotency-Key", "the same key with the same body starts no second run"))
      .body(doc::object_schema({{"scenario", scenario},
                                {"patch", {{"type", "object"}, {"description", "JSON Merge Patch of the document"}}},
                                {"seed", doc::integer_schema(0, static_cast<std::int64_t>(kLargestSeed))},
                                {"pace", pace},
                                {"input", input},
                                {"webhook", doc::text_schema("http://… that alarms are sent to")},
                                {"tags", tags},
                                {"note", {{"type", "string"}, {"maxLength", 4000}}}},
                               {"scenario"}))
      .answer(201, "The run; Location holds its address. Over the limit of runs at once it is queued.", kRun)
      .problem(422, "The scenario, or what was asked beside it, is not valid; or the key was used with another body.")
      .problem(503, "Too many runs wait already.")
      .what();
}

Json list_doc() {
  return doc::Operation()
      .parameter(doc::query("q", doc::text_schema(), "which runs: field:value, ranges, AND, OR, NOT, parentheses"))
      .parameter(doc::query("sort", doc::text_schema(), "a field, '-' before it for falling; newest first without"))
      .parameter(doc::query("limit", doc::integer_schema(1, 500), "items a page, 50 without"))
      .parameter(doc::query("cursor", doc::text_schema(), "`next` of the page before"))
      .answer(200, "A page of runs.", doc::page_schema(kRun))
      .problem(400, "The query, sort, limit or cursor cannot be read.")
      .what();
}

}  // namespace

void add_run_routes(Routes& routes, Services& services) {
  routes.add(make_route(
      "POST", "/api/v1/runs", [&services](const auto& q, auto& r) { create(services, q, r); }, "Start a run",
      create_doc()));
  routes.add(make_route(
      "GET", "/api/v1/runs", [&services](const auto& q, auto& r) { list(services, q, r); }, "Find runs", list_doc()));
  routes.add(make_route(
      "GET", "/api/v1/runs/{id}",
      [&services](const auto& q, auto& r) { r.json(run_detail(run_row(q, services), services)); },
      "A run: state, progress, metrics, design, document",
      doc::Operation().answer(200, "The run.", kRun).problem(404, "There is no such run.").what()));
  routes.add(make_route(
      "DELETE", "/api/v1/runs/{id}",
      [&services](const auto& q, auto& r) {
        run_row(q, services);
        services.runs.remove(q.id_param("id"));
        r.empty();
      },
      "Delete a run; a live one is stopped first",
      doc::Operation().empty(204, "It is gone.").problem(404, "There is no such run.").what()));
}

}  // namespace vigil
