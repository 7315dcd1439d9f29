// Runs side by side.
#include <charconv>
#include <cmath>

#include "engine/core/describe.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/run_json.hpp"
#include "server/compare/compare.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kMostPoints = 5000;
constexpr std::int64_t kMostShift = 100'000;

[[noreturn]] void refuse(const std::string& name, const std::string& detail, const std::string& allowed) {
  throw HttpError(400, detail, {{"/" + name, detail, allowed}});
}

double query_tolerance(const HttpRequest& request, const std::string& name) {
  const std::string text = request.query_value(name);
  if (text.empty()) return 0;
  double value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value) || value < 0)
    refuse(name, name + " is " + in_quotes(text) + "; expected a number >= 0.", ">= 0");
  return value;
}

/// Metrics of a run that goes on are newer in memory than in the log.
ComparedRun compared(const Services& services, const std::string& text) {
  RunId id = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error != std::errc() || end != text.data() + text.size() || id < 0)
    refuse("ids", "ids holds " + in_quotes(text) + "; expected the ids of 2 to 10 runs, comma-separated.", "run ids");
  const auto row = services.reader.run(id);
  if (!row) throw HttpError(404, "There is no run " + text + ".", {{"/ids", "There is no run " + text + ".", ""}});
  ComparedRun run = run_of_log(services.reader, *row);
  if (const auto live = services.runs.find(id)) {
    const auto status = live->status();
    run.state = status->state;
    run.metrics = status->metrics;
  }
  return run;
}

std::vector<ComparedRun> compared_runs(const Services& services, std::string_view ids) {
  std::vector<ComparedRun> runs;
  while (!ids.empty()) {
    if (runs.size() == kMostRuns) {
      refuse("ids",
             "More than " + std::to_string(kMostRuns) + " runs are named; a comparison takes 2 to " +
                 std::to_string(kMostRuns) + ".",
             "2 to 10 runs");
    }
    const std::size_t comma = ids.find(',');
    runs.push_back(compared(services, std::string(ids.substr(0, comma))));
    ids.remove_prefix(comma == std::string_view::npos ? ids.size() : comma + 1);
  }
  return runs;
}

CompareOrder order_of(const HttpRequest& request) {
  CompareOrder order;
  order.signals = request.query_value("signals");
  const std::string align = request.query_value("align", "tick");
  if (align != "tick" && align != "attack")
    refuse("align", "align is " + in_quotes(align) + "; expected tick or attack.", "tick, attack");
  order.by_attack = align == "attack";
  order.tolerance.abs = query_tolerance(request, "abs");
  order.tolerance.rel = query_tolerance(request, "rel");
  order.tolerance.shift = request.query_int("shift", 0, 0, kMostShift);
  if (request.has_query("from")) order.from = request.query_int("from", 0, -kLastTick, kLastTick);
  if (request.has_query("to")) order.to = request.query_int("to", 0, -kLastTick, kLastTick);
  order.points = static_cast<int>(request.query_int("points", 1000, 0, kMostPoints));
  return order;
}

void compare(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const CompareOrder order = order_of(request);
  try {
    response.json(compare_runs(compared_runs(services, request.query_value("ids")), order));
  } catch (const InputError& error) {
    throw HttpError(400, error.problems().front().detail, error.problems());  // a query, not a document
  }
}

Json array_schema(Json item) { return {{"type", "array"}, {"items", std::move(item)}}; }

Json compare_doc() {
  const Json object{{"type", "object"}};
  Json answer{{"type", "object"},
              {"required", {"runs", "range", "parameters", "metrics", "series", "verdicts", "paired"}},
              {"properties", {{"range", {{"type", {"object", "null"}}}}}}};
  for (const char* part : {"runs", "parameters", "metrics", "series", "verdicts", "paired"})
    answer["properties"][part] = array_schema(object);
  return doc::Operation()
      .parameter(
          doc::query("ids", doc::text_schema(), "2 to 10 runs, comma-separated; the others are measured by the first"))
      .parameter(doc::query("signals", doc::text_schema(),
                            "names and patterns (* ?), comma-separated, at most 64 signals; the lanes' errors without"))
      .parameter(doc::query("align", {{"type", "string"}, {"enum", {"tick", "attack"}}},
                            "attack: tick 0 is where each run's first attack begins"))
      .parameter(doc::query("abs", doc::text_schema(), "absolute tolerance, in each signal's unit"))
      .parameter(doc::query("rel", doc::text_schema(), "tolerance relative to the first run's value; the wider counts"))
      .parameter(doc::query("shift", doc::integer_schema(0, kMostShift), "ticks that a value may come early or late"))
      .parameter(doc::query("from", doc::integer_schema(-kLastTick, kLastTick), "first tick, after alignment"))
      .parameter(doc::query("to", doc::integer_schema(-kLastTick, kLastTick), "last tick, included"))
      .parameter(doc::query("points", doc::integer_schema(0, kMostPoints),
                            "buckets of `series` at most, 1000 without; 0: no series. Verdicts see every tick"))
      .answer(200, "What differs, the samples to draw, tolerance verdicts and paired differences.", answer)
      .problem(400, "Too few or many runs, a signal that is not there, a number that cannot be read, too much at once.")
      .problem(404, "There is no such run.")
      .what();
}

}  // namespace

void add_compare_routes(Routes& routes, Services& services) {
  routes.add(make_route(
      "GET", "/api/v1/compare", [&services](const auto& q, auto& r) { compare(services, q, r); }, "Runs side by side",
      compare_doc()));
}

}  // namespace vigil
