// Recorded inputs of the user's own.
#include "engine/core/describe.hpp"
#include "engine/identify/mapping.hpp"
#include "engine/run/pushed_columns.hpp"
#include "engine/run/trace.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"
#include "server/api/services.hpp"

namespace vigil {
namespace {

constexpr std::size_t kTraceLimit = 64u << 20;
constexpr std::size_t kTraceCells = 20'000'000;
constexpr std::size_t kMappedLimit = 96u << 20;  ///< a table of 64 MiB inside JSON, its line ends escaped

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

void check_name(const std::string& name) {
  if (name.size() > 200)
    throw HttpError(400, "name is longer than 200 bytes.", {{"/name", "longer than 200 bytes", "200 bytes"}});
}

void store(Services& services, const std::string& name, const std::string& csv, HttpResponse& response) {
  const Trace trace = Trace::from_csv(csv, kTraceCells);
  const std::int64_t id = services.log.put_trace(name, csv, trace.rows(), trace.columns());
  const auto row = services.reader.trace(id);
  if (!row) throw HttpError(404, "The trace was deleted at once.");
  response.json(trace_json(*row), 201);
  response.set_header("Location", "/api/v1/traces/" + std::to_string(id));
}

void create(Services& services, const HttpRequest& request, HttpResponse& response) {
  const std::string name = request.query_value("name");
  check_name(name);
  if (!is_utf8(request.body)) throw InputError("", "the CSV is not UTF-8", "UTF-8");
  store(services, name, request.body, response);
}

/// A member that has to be a text.
std::string text_of(const Json& body, const std::string& key, const std::string& what) {
  if (!body.contains(key) || !body.at(key).is_string())
    throw InputError("/" + key, key + " is missing or no text; expected " + what, "text");
  return body.at(key).get<std::string>();
}

/// Somebody's table as a trace, by the code of `vigil trace table`.
void create_mapped(Services& services, const HttpRequest& request, HttpResponse& response) {
  Json body = request.json();
  const std::string csv = text_of(body, "csv", "the table's text");
  body.erase("csv");  // the rest is short
  check_members(body, {"name", "mapping"});
  const std::string name = body.contains("name") ? text_of(body, "name", "a name for people") : "";
  check_name(name);
  if (!body.contains("mapping")) throw InputError("/mapping", "mapping is missing; expected an object", "object");
  const identify::Mapping mapping = identify::read_mapping(body.at("mapping"), "/mapping");
  std::string trace;
  try {
    trace = identify::table_to_trace(csv, mapping);
  } catch (const InputError& error) {
    rethrow_below(error, "/csv");
  }
  if (trace.size() > kTraceLimit)
    throw HttpError(413, "The trace would be larger than 64 MiB.", {{"/csv", "too large", "a trace of 64 MiB"}});
  store(services, name, trace, response);
}

/// What a trace of the scenario may hold, for whoever maps a table to it.
void columns_of(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const Scenario scenario = named_scenario(services, request.params.at("id"));
  const PushedColumns columns = pushed_columns(scenario);
  const Json& document = scenario.document();
  Json lanes = Json::array();
  for (const auto& [lane, ignored] : document.at("lanes").items()) lanes.push_back(lane);
  const Json::json_pointer kept("/view/mapping");
  response.json({{"columns", columns.names},
                 {"nodes", columns.nodes},
                 {"lanes", lanes},
                 {"dt", document.at("time").at("dt")},
                 {"mapping", document.contains(kept) ? document.at(kept) : Json()}});
}

void list_traces(const Services& services, HttpResponse& response) {
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

Route mapped_route(Services& services) {
  const Json mapping = doc::object_schema({{"columns", {{"type", "object"}, {"description", "signal: column"}}},
                                           {"constants", {{"type", "object"}, {"description", "signal: number"}}},
                                           {"dt", {{"type", "number"}, {"exclusiveMinimum", 0}}},
                                           {"input_lag", {{"enum", {0, 1}}}},
                                           {"label", {{"type", {"object", "null"}}}}},
                                          {"columns"});
  const Json body = doc::object_schema(
      {{"csv", doc::text_schema("any table with a header")}, {"mapping", mapping}, {"name", doc::text_schema()}},
      {"csv", "mapping"});
  Route route = make_route(
      "POST", "/api/v1/traces/map", [&services](const auto& q, auto& r) { create_mapped(services, q, r); },
      "Store any table as a trace, its columns mapped to signals as `vigil trace table --map` does",
      doc::Operation()
          .body(body)
          .answer(201, "The trace; the same again is the same trace.", {{"type", "object"}})
          .problem(413, "Larger than 64 MiB.")
          .problem(422, "The mapping is none, or the table has no such column or number: line and column are named.")
          .what());
  route.body_limit = kMappedLimit;
  return route;
}

}  // namespace

void add_trace_routes(Routes& routes, Services& services) {
  routes.add(mapped_route(services));
  routes.add(make_route(
      "GET", "/api/v1/scenarios/{id}/columns", [&services](const auto& q, auto& r) { columns_of(services, q, r); },
      "The readings, known inputs and true states that a trace of the scenario may have",
      doc::Operation()
          .answer(200, "Names of columns; nodes, lanes, seconds a tick; the mapping that the scenario keeps.",
                  {{"type", "object"}})
          .problem(404, "There is no such scenario.")
          .problem(422, "Its plant or sensors cannot be made.")
          .what()));
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
      "GET", "/api/v1/traces", [&services](const auto&, auto& r) { list_traces(services, r); }, "All traces",
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
