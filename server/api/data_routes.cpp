// What a run left behind: its catalogue, samples and marks.
#include <algorithm>
#include <cmath>

#include "engine/core/describe.hpp"
#include "engine/run/frame_csv.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/run_json.hpp"
#include "server/api/sample_csv.hpp"
#include "server/api/signal_query.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostNumbers = 4'000'000;  // of one JSON answer; CSV has no such limit

/// A run that has just begun may not have its signals in the file yet: what was handed to the log is waited for once.
std::vector<Signal> catalogue_of(const Services& services, RunId run) {
  std::vector<Signal> catalogue = services.reader.signals(run);
  if (!catalogue.empty()) return catalogue;
  services.log.flush();
  return services.reader.signals(run);
}

void signals(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const RunRow row = run_row(request, services);
  const std::vector<Signal> catalogue = catalogue_of(services, row.id);
  const std::vector<int> logged = services.reader.logged_signals(row.id);
  Json items = Json::array();
  for (const Signal& signal : catalogue) {
    Json item = to_json(signal);
    item["logged"] = std::binary_search(logged.begin(), logged.end(), signal.id);
    items.push_back(std::move(item));
  }
  response.json({{"items", std::move(items)}, {"next", nullptr}});
}

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(std::isfinite(value) ? Json(value) : Json());
  return list;
}

Json window_json(const SampleWindow& window, const std::vector<Signal>& catalogue) {
  Json answer;
  answer["raw"] = window.raw;
  answer["bucket"] = window.bucket;
  answer["first"] = window.first;
  answer["last"] = window.last;
  answer["k"] = window.k;
  answer["t"] = numbers(window.t);
  answer["series"] = Json::array();
  for (const SampleWindow::Series& series : window.series) {
    Json item{{"signal", catalogue[static_cast<std::size_t>(series.signal)].name}, {"id", series.signal}};
    if (window.raw) {
      item["v"] = numbers(series.v);
    } else {
      item["lo"] = numbers(series.lo);
      item["hi"] = numbers(series.hi);
    }
    answer["series"].push_back(std::move(item));
  }
  answer["gaps"] = Json::array();
  for (const GapRow& gap : window.gaps) answer["gaps"].push_back({{"from", gap.from}, {"to", gap.to}});
  return answer;
}

void samples(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const RunRow row = run_row(request, services);
  const std::vector<Signal> catalogue = catalogue_of(services, row.id);
  const std::vector<int> picked = pick_signals(request.query_value("signals"), catalogue);
  const std::int64_t from = request.query_int("from", 0, 0, kLastTick);
  const std::int64_t to = request.query_int("to", kLastTick, 0, kLastTick);
  const int points = static_cast<int>(request.query_int("points", 1000, 2, 100'000));
  if (request.accepts("text/csv")) {
    response.content_type = "text/csv; charset=utf-8";
    response.set_header("Content-Disposition", "attachment; filename=\"run-" + std::to_string(row.id) + ".csv\"");
    response.stream = [&services, id = row.id, catalogue, picked, from, to](const BodyWriter& write) {
      return write_csv(services.reader, id, catalogue, picked, from, to, write);
    };
    return;
  }
  const std::size_t wanted = picked.size() * static_cast<std::size_t>(points) * 2;
  const std::size_t there =
      picked.size() * static_cast<std::size_t>(std::max<std::int64_t>(std::min(to, row.k) - from + 1, 0));
  if (std::min(wanted, there) > kMostNumbers) {
    throw HttpError(
        400, "That is too much for one JSON answer: ask for fewer signals or points, a shorter range, or text/csv.",
        {{"/points", "signals times points is more than 2000000", "at most 2000000 in all"}});
  }
  response.json(window_json(services.reader.samples(row.id, picked, from, to, points), catalogue));
}

std::vector<std::string> parts(std::string_view text) {
  std::vector<std::string> result;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    result.emplace_back(text.substr(0, comma));
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return result;
}

MarkType mark_type(const std::string& name) {
  static const std::vector<MarkType> all{MarkType::attack,  MarkType::alarm, MarkType::fault,
                                         MarkType::command, MarkType::state, MarkType::note};
  for (const MarkType type : all) {
    if (to_string(type) == name) return type;
  }
  const std::string detail = "type is " + in_quotes(name) + "; expected attack, alarm, fault, command, state or note";
  throw HttpError(400, detail, {{"/type", detail, "attack, alarm, fault, command, state, note"}});
}

void marks(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const RunRow row = run_row(request, services);
  MarkFilter filter;
  if (request.has_query("from")) filter.from = request.query_int("from", 0, 0, kLastTick);
  if (request.has_query("to")) filter.to = request.query_int("to", 0, 0, kLastTick);
  for (const std::string& name : parts(request.query_value("type"))) filter.types.push_back(mark_type(name));
  filter.lanes = parts(request.query_value("lane"));
  filter.cursor = request.query_value("cursor");
  filter.limit = static_cast<int>(request.query_int("limit", 1000, 1, 10'000));
  const MarkPage page = services.reader.marks(row.id, filter);
  Json answer{{"items", Json::array()}, {"next", page.next ? Json(*page.next) : Json()}};
  for (const MarkPage::Item& item : page.items) answer["items"].push_back(to_json(item.mark));
  response.json(answer);
}

Json samples_doc() {
  const Json numbers{{"type", "array"}, {"items", {{"type", {"number", "null"}}}}};
  const Json series{{"type", "object"},
                    {"properties",
                     {{"signal", {{"type", "string"}}},
                      {"id", {{"type", "integer"}}},
                      {"v", numbers},
                      {"lo", numbers},
                      {"hi", numbers}}}};
  const Json window{{"type", "object"},
                    {"required", {"k", "series"}},
                    {"properties",
                     {{"k", {{"type", "array"}, {"items", {{"type", "integer"}}}}},
                      {"t", numbers},
                      {"series", {{"type", "array"}, {"items", series}}}}}};
  return doc::Operation()
      .parameter(
          doc::query("signals", doc::text_schema(), "names, patterns (* ?) or ids, comma-separated; all without"))
      .parameter(doc::query("from", doc::integer_schema(0, kLastTick), "first tick"))
      .parameter(doc::query("to", doc::integer_schema(0, kLastTick), "last tick, included"))
      .parameter(
          doc::query("points", doc::integer_schema(2, 100'000), "buckets at most, 1000 without; CSV has every tick"))
      .answer(200, "Values where the range has no more ticks than points, otherwise the extremes of each bucket.",
              window)
      .answer(200, "Values where the range has no more ticks than points, otherwise the extremes of each bucket.",
              doc::text_schema("k,t,names; 17 significant digits; empty: missing"), "text/csv")
      .problem(400, "A signal that is not there, a range or number that cannot be read, or too much for one answer.")
      .problem(404, "There is no such run.")
      .what();
}

Json marks_doc() {
  return doc::Operation()
      .parameter(doc::query("from", doc::integer_schema(0, kLastTick), "first tick"))
      .parameter(doc::query("to", doc::integer_schema(0, kLastTick), "last tick, included"))
      .parameter(doc::query("type", doc::text_schema(), "attack, alarm, fault, command, state, note; comma-separated"))
      .parameter(doc::query("lane", doc::text_schema(), "lanes, comma-separated"))
      .parameter(doc::query("limit", doc::integer_schema(1, 10'000), "items a page, 1000 without"))
      .parameter(doc::query("cursor", doc::text_schema(), "`next` of the page before"))
      .answer(200, "A page of marks, in the order they were made.", doc::page_schema({{"type", "object"}}))
      .problem(404, "There is no such run.")
      .what();
}

}  // namespace

void add_data_routes(Routes& routes, Services& services) {
  routes.add(make_route(
      "GET", "/api/v1/runs/{id}/signals", [&services](const auto& q, auto& r) { signals(services, q, r); },
      "The run's signal catalogue",
      doc::Operation()
          .answer(200, "Every signal, in the order of frames.", doc::page_schema({{"type", "object"}}))
          .problem(404, "There is no such run.")
          .what()));
  routes.add(make_route(
      "GET", "/api/v1/runs/{id}/samples", [&services](const auto& q, auto& r) { samples(services, q, r); },
      "Samples of a run, at any zoom", samples_doc()));
  routes.add(make_route(
      "GET", "/api/v1/runs/{id}/marks", [&services](const auto& q, auto& r) { marks(services, q, r); },
      "What happened in a run", marks_doc()));
}

}  // namespace vigil
