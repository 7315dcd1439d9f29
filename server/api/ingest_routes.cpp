// Rows pushed into a run that goes on.
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/run_json.hpp"
#include "server/api/services.hpp"

namespace vigil {
namespace {

constexpr std::size_t kRowsLimit = 8u << 20;

/// The run, if rows can be pushed into it.
std::shared_ptr<LiveRun> fed_run(HttpRequest request, const Services& services) {
  const std::string id = request.params.at("run");
  request.params["id"] = id;
  auto run = live_run(request, services);
  if (!run->order().feed)
    throw HttpError(409, "Run " + id + " takes no rows: it was not started with \"input\":\"ingest\".");
  if (run->wait_ended(std::chrono::milliseconds(0)))
    throw HttpError(409, "Run " + id + " is over: it takes no more rows.");
  return run;
}

void push(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const auto run = fed_run(request, services);
  response.json(run->order().feed->take(request.content_type(), request.body));
  run->wake();
}

Json row_schema() {
  const Json node{{"type", {"string", "integer", "null"}}, {"description", "whose channels the values are"}};
  const Json values{{"type", "object"},
                    {"additionalProperties", {{"type", {"number", "null"}}}},
                    {"description", "with a node its channels, without one whole names as in `columns`"}};
  return doc::object_schema({{"k", doc::integer_schema(0, 1'000'000'000'000)},
                             {"seq", {{"type", {"integer", "null"}}, {"minimum", 0}}},
                             {"node", node},
                             {"values", values}},
                            {"k", "values"});
}

Json push_doc() {
  const Json count{{"type", "integer"}};
  const Json answer = doc::object_schema({{"accepted", count},
                                          {"duplicate", count},
                                          {"late", count},
                                          {"beyond", count},
                                          {"open", {{"type", "array"}, {"items", count}}},
                                          {"closed", count}});
  const Json many{{"oneOf", {row_schema(), {{"type", "array"}, {"items", row_schema()}}}}};
  return doc::Operation()
      .body(doc::text_schema("one row a line"), "application/x-ndjson")
      .body(many)
      .body(doc::text_schema("header k,<signal names>"), "text/csv")
      .answer(200, "What became of the rows.", answer)
      .problem(404, "There is no such run.")
      .problem(409, "The run is over, or takes no rows.")
      .problem(413, "Larger than 8 MiB.")
      .problem(422, "A row is not one of this run: nothing was taken.")
      .problem(429, "The run is behind: nothing was taken; Retry-After says when to send the same again.")
      .what();
}

void plant(const Services& services, HttpResponse& response) {
  const Json status = services.outside->plant();
  response.json(status.is_null() ? Json{{"broker", nullptr}} : status);
}

}  // namespace

void add_ingest_routes(Routes& routes, Services& services) {
  Route post = make_route(
      "POST", "/api/v1/ingest/{run}", [&services](const auto& q, auto& r) { push(services, q, r); },
      "Push rows into a run that was started with \"input\":\"ingest\"", push_doc());
  post.body_types = {"application/x-ndjson", "application/json", "text/csv"};
  post.body_limit = kRowsLimit;
  routes.add(std::move(post));
  routes.add(make_route(
      "GET", "/api/v1/ingest", [&services](const auto&, auto& r) { plant(services, r); },
      "What the broker's topics brought",
      doc::Operation()
          .answer(200, "The broker (null: none), messages that came, were taken, refused, or for no run.",
                  {{"type", "object"}})
          .what()));
  routes.add(make_route(
      "GET", "/api/v1/ingest/{run}",
      [&services](const auto& q, auto& r) { r.json(fed_run(q, services)->order().feed->status()); },
      "Which columns such a run takes, and what became of the rows so far",
      doc::Operation()
          .answer(200, "Columns, nodes, deadline, counts, open ticks, ticks that wait.", {{"type", "object"}})
          .problem(404, "There is no such run.")
          .problem(409, "The run is over, or takes no rows.")
          .what()));
}

}  // namespace vigil
