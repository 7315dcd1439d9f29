// The single trials of a campaign: their values, the outliers first, and how to run one alone.
#include <algorithm>
#include <cmath>

#include "engine/core/describe.hpp"
#include "server/api/campaign_json.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/trial_command.hpp"
#include "server/campaigns/work.hpp"

namespace vigil {
namespace {

/// The place of a metric among a cell's columns. Throws HttpError 400 with what there is.
int place_of(const Json& columns, const std::string& wanted) {
  int place = 0;
  std::vector<std::string> known;
  for (const Json& item : columns) {
    const std::string name =
        item.at("lane").get<std::string>() + "." + metric_id(item.at("node"), item.at("name"), item.at("variant"));
    if (!item.contains("part")) {
      if (name == wanted) return place;
      known.push_back(name);
    }
    ++place;
  }
  throw HttpError(400, "metric is " + in_quotes(wanted) + "; expected a metric of the campaign.",
                  {{"/metric", "no trial of the cell has it", listed(known)}});
}

struct Shown {
  const TrialRow* row;
  double value;
};

/// Falling in what stands first: the distance from the median of those that have a value; without a value last.
void sort_trials(std::vector<Shown>& trials, const std::string& sort) {
  if (sort.empty() || sort == "index") return;
  const bool falling = sort == "-value", outlier = sort == "outlier";
  if (!falling && !outlier && sort != "value")
    throw HttpError(400, "sort is " + in_quotes(sort) + "; expected index, value, -value or outlier.");
  std::vector<double> values;
  for (const Shown& one : trials) {
    if (std::isfinite(one.value)) values.push_back(one.value);
  }
  std::sort(values.begin(), values.end());
  const double middle = values.empty() ? 0 : values[values.size() / 2];
  const auto rank = [&](const Shown& one) {
    if (!std::isfinite(one.value)) return std::numeric_limits<double>::infinity();
    return outlier ? -std::abs(one.value - middle) : falling ? -one.value : one.value;
  };
  std::stable_sort(trials.begin(), trials.end(), [&](const Shown& a, const Shown& b) { return rank(a) < rank(b); });
}

/// Of the faults those that stopped a lane; a single trial shows all.
Json trial_json(const TrialRow& row, std::int64_t runs) {
  Json stops = Json::array();
  for (const Json& fault : row.faults) {
    if (fault.value("stopped", false)) stops.push_back(fault);
  }
  const auto text = [](const std::string& value) { return value.empty() ? Json() : Json(value); };
  return {{"index", row.index},
          {"cell", row.index / runs},
          {"seed", row.seed},
          {"state", row.state},
          {"faults", std::move(stops)},
          {"error", text(row.error)},
          {"run", row.run ? Json(std::to_string(*row.run)) : Json()}};
}

void list(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const CampaignRow campaign = campaign_row(request, services);
  const std::int64_t runs = campaign.request.value("runs", std::int64_t{1});
  const std::int64_t cell = request.query_int("cell", 0, 0, static_cast<std::int64_t>(kMostCells));
  const auto found = services.reader.campaign_cell(campaign.id, cell);
  if (!found) throw HttpError(404, "The campaign has no cell " + std::to_string(cell) + ".");
  const std::string metric = request.query_value("metric"), state = request.query_value("state");
  const int place = metric.empty() ? -1 : place_of(found->columns, metric);
  if (metric.empty() && !request.query_value("sort").empty() && request.query_value("sort") != "index")
    throw HttpError(400, "sort needs metric: the value to sort by.");
  const auto rows = services.reader.trials(campaign.id, {cell * runs, (cell + 1) * runs - 1});
  std::vector<Shown> trials;
  for (const TrialRow& row : rows) {
    if (state.empty() || row.state == state) trials.push_back({&row, TrialColumns::value(row.numbers, place)});
  }
  sort_trials(trials, request.query_value("sort"));
  const auto limit = static_cast<std::size_t>(request.query_int("limit", 100, 1, 10'000));
  const auto from = static_cast<std::size_t>(request.query_int("cursor", 0, 0, kMostTrials));
  Json answer{{"items", Json::array()}, {"next", nullptr}};
  for (std::size_t i = from; i < std::min(trials.size(), from + limit); ++i) {
    answer["items"].push_back(trial_json(*trials[i].row, runs));
    const double value = trials[i].value;
    if (place >= 0) answer["items"].back()["value"] = std::isfinite(value) ? Json(value) : Json();
  }
  if (from + limit < trials.size()) answer["next"] = std::to_string(from + limit);
  response.json(answer);
}

/// What to type to repeat a trial; its trace is fetched from this server first.
std::string command_of(const HttpRequest& request, const Json& campaign, const Scenario& scenario, std::uint64_t seed) {
  if (!campaign.contains("trace")) return run_command(scenario, seed, "");
  const std::string id = std::to_string(campaign.at("trace").get<std::int64_t>()), file = "trace-" + id + ".csv";
  const std::string host = request.header("Host");
  return "curl -fsS -H 'Accept: text/csv' -o " + file + " " +
         shell_word("http://" + (host.empty() ? "localhost" : host) + "/api/v1/traces/" + id) + " && " +
         run_command(scenario, seed, file);
}

void show(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const CampaignRow campaign = campaign_row(request, services);
  const std::int64_t runs = campaign.request.value("runs", std::int64_t{1}), index = request.id_param("index");
  const auto rows = services.reader.trials(campaign.id, {index, index});
  const auto cell = services.reader.campaign_cell(campaign.id, index / runs);
  if (rows.empty() || !cell || cell->columns.is_null())
    throw HttpError(404, "The campaign has no trial " + request.params.at("index") + " yet.");
  Scenario scenario = Scenario::from_json(campaign.request.at("scenario"));
  for (const auto& [path, value] : cell->sweep.items()) scenario = scenario.with(path, value);
  Json answer = trial_json(rows.front(), runs);
  answer["sweep"] = cell->sweep;
  if (!rows.front().faults.is_null()) answer["faults"] = rows.front().faults;
  answer["warnings"] = rows.front().warnings.is_null() ? Json::array() : rows.front().warnings;
  answer["metrics"] = Json::array();
  for (const MetricValue& metric : trial_of(rows.front(), TrialColumns::from_json(cell->columns)).metrics)
    answer["metrics"].push_back(to_json(metric));
  Json alone{{"scenario", scenario.document()}, {"seed", rows.front().seed}};
  if (campaign.request.contains("trace"))
    alone["input"] = {{"trace", std::to_string(campaign.request.at("trace").get<std::int64_t>())}};
  answer["request"] = std::move(alone);
  answer["command"] = command_of(request, campaign.request, scenario, rows.front().seed);
  response.json(answer);
}

}  // namespace

void add_trial_routes(Routes& routes, Services& services) {
  const Json any{{"type", "object"}};
  routes.add(make_route(
      "GET", "/api/v1/campaigns/{id}/trials", [&services](const auto& q, auto& r) { list(services, q, r); },
      "The trials of one cell, with one of their metrics",
      doc::Operation()
          .parameter(doc::query("cell", doc::integer_schema(0, kMostCells), "0 without"))
          .parameter(doc::query("metric", doc::text_schema(), "lane.name or lane.node.name, with :variant"))
          .parameter(doc::query("sort", {{"enum", {"index", "value", "-value", "outlier"}}},
                                "outlier: the farthest from the median first"))
          .parameter(doc::query("state", {{"enum", {"finished", "stopped", "failed"}}}, "all without"))
          .parameter(doc::query("limit", doc::integer_schema(1, 10'000), "items a page, 100 without"))
          .parameter(doc::query("cursor", doc::text_schema(), "`next` of the page before"))
          .answer(200, "A page of trials.", doc::page_schema(any))
          .problem(404, "There is no such campaign or cell.")
          .what()));
  routes.add(make_route(
      "GET", "/api/v1/campaigns/{id}/trials/{index}", [&services](const auto& q, auto& r) { show(services, q, r); },
      "A trial with all its metrics, and the body of POST /runs that repeats it",
      doc::Operation().answer(200, "The trial.", any).problem(404, "There is no such trial yet.").what()));
}

}  // namespace vigil
