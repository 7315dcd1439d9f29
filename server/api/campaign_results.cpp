// Figures of chosen metrics of all points, and values of chosen metrics of all trials: compact, for drawings.
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/describe.hpp"
#include "server/api/campaign_json.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/services.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kMostValues = 100'000;  // trials an answer

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// Gives every name its place, in the order in which they come.
class Places {
 public:
  std::size_t of(const std::string& name) {
    const auto [place, fresh] = places_.try_emplace(name, names_.size());
    if (fresh) names_.push_back(name);
    return place->second;
  }
  const Json& names() const { return names_; }

 private:
  std::map<std::string, std::size_t> places_;
  Json names_ = Json::array();
};

bool wanted(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void results(const Services& services, CampaignResults& all, const HttpRequest& request, HttpResponse& response) {
  const CampaignRow campaign = campaign_row(request, services);
  const auto metrics = comma_words(request.query_value("metric")), lanes = comma_words(request.query_value("lane"));
  const std::int64_t from = request.query_int("from", 0, 0, static_cast<std::int64_t>(kMostCells));
  Places lane_places, metric_places;
  Json rows = Json::array();
  for (const SummaryRow& cell : all.summaries(campaign, from)) {
    for (const CellSummary::Row& row : cell.summary.rows) {
      const std::string id = metric_id(row.node, row.name, row.variant);
      if (metrics.empty() ? !row.node.empty() : !wanted(metrics, id)) continue;
      if (!lanes.empty() && !wanted(lanes, row.lane)) continue;
      Json& line = rows.emplace_back(Json::array({cell.cell, lane_places.of(row.lane), metric_places.of(id)}));
      for (const double figure : row.figures) line.push_back(number(figure));
    }
  }
  response.json({{"from", from},
                 {"done", campaign.done},
                 {"lanes", lane_places.names()},
                 {"metrics", metric_places.names()},
                 {"figures", kSummaryFigures},
                 {"rows", std::move(rows)}});
}

/// Where the metrics of an answer stand among the numbers of each cell's trials.
class ValuePlaces {
 public:
  ValuePlaces(const std::vector<ColumnsRow>& cells, std::vector<std::string> names) : names_(std::move(names)) {
    const bool all = names_.empty();
    std::shared_ptr<const Json> known;
    for (const ColumnsRow& cell : cells) {
      if (cell.columns != known) kinds_.push_back(read(*cell.columns, all));
      known = cell.columns;
      cells_[cell.cell] = kinds_.size() - 1;
    }
  }
  const std::vector<std::string>& names() const { return names_; }
  /// -1: the cell's trials have it not.
  int place(std::int64_t cell, const std::string& name) const {
    const auto kind = cells_.find(cell);
    if (kind == cells_.end()) return -1;
    const auto found = kinds_[kind->second].find(name);
    return found == kinds_[kind->second].end() ? -1 : found->second;
  }
  /// Throws HttpError 400 where no cell has a metric that is asked for.
  void require() const {
    for (const std::string& name : names_) {
      const auto has = [&](const auto& kind) { return kind.contains(name); };
      if (kinds_.empty() || std::any_of(kinds_.begin(), kinds_.end(), has)) continue;
      std::vector<std::string> known;
      for (const auto& [other, place] : kinds_.front()) known.push_back(other);
      throw HttpError(400, "metric is " + in_quotes(name) + "; expected metrics of the campaign.",
                      {{"/metric", "no trial has it", listed(known)}});
    }
  }

 private:
  using Kind = std::map<std::string, int>;
  Kind read(const Json& columns, bool all) {
    Kind places;
    int place = -1;
    for (const Json& item : columns) {
      ++place;
      if (item.contains("part")) continue;
      const std::string node = item.at("node"), id = metric_id(node, item.at("name"), item.at("variant"));
      const std::string name = item.at("lane").get<std::string>() + "." + id;
      places.emplace(name, place);
      if (all && node.empty() && !wanted(names_, name)) names_.push_back(name);
    }
    return places;
  }

  std::vector<std::string> names_;
  std::vector<Kind> kinds_;
  std::map<std::int64_t, std::size_t> cells_;  ///< place among kinds_
};

/// The trials that are asked for: those of a cell, or all.
TrialRange range_of(const HttpRequest& request, const CampaignRow& campaign, std::int64_t runs) {
  TrialRange range{0, campaign.done - 1};
  if (request.has_query("cell")) {
    const std::int64_t cell = request.query_int("cell", 0, 0, static_cast<std::int64_t>(kMostCells));
    if (cell * runs >= campaign.trials) throw HttpError(404, "The campaign has no cell " + std::to_string(cell) + ".");
    range = {cell * runs, std::min(campaign.done, (cell + 1) * runs) - 1};
  }
  range.from = std::max(range.from, request.query_int("from", 0, 0, kMostTrials));
  return range;
}

void values(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const CampaignRow campaign = campaign_row(request, services);
  const std::int64_t runs = campaign.request.value("runs", std::int64_t{1});
  TrialRange range = range_of(request, campaign, runs);
  const std::int64_t last = range.to, limit = request.query_int("limit", 10'000, 1, kMostValues);
  range.to = std::min(last, range.from + limit - 1);
  const ValuePlaces places(services.reader.campaign_columns(campaign.id, range.from / runs, range.to / runs),
                           comma_words(request.query_value("metric")));
  places.require();
  std::vector<Json> columns(places.names().size(), Json::array());
  std::vector<int> here(columns.size(), -1);
  std::int64_t cell = -1;
  services.reader.each_trial(campaign.id, range, [&](std::int64_t index, std::string_view numbers) {
    if (index / runs != cell) {
      cell = index / runs;
      for (std::size_t i = 0; i < here.size(); ++i) here[i] = places.place(cell, places.names()[i]);
    }
    for (std::size_t i = 0; i < here.size(); ++i) columns[i].push_back(number(TrialColumns::value(numbers, here[i])));
  });
  response.json({{"from", range.from},
                 {"n", std::max<std::int64_t>(0, range.to - range.from + 1)},
                 {"metrics", places.names()},
                 {"values", std::move(columns)},
                 {"next", range.to < last ? Json(range.to + 1) : Json()}});
}

}  // namespace

void add_result_routes(Routes& routes, Services& services, const SharedResults& all) {
  const Json any{{"type", "object"}};
  const auto place = [](std::int64_t most) { return doc::integer_schema(0, most); };
  routes.add(make_route(
      "GET", "/api/v1/campaigns/{id}/results",
      [&services, all](const auto& q, auto& r) { results(services, *all, q, r); },
      "Figures of chosen metrics of every point",
      doc::Operation()
          .parameter(doc::query("metric", doc::text_schema(),
                                "name or node.name, with :variant; commas between; "
                                "without: all that are not of a node"))
          .parameter(doc::query("lane", doc::text_schema(), "only these lanes; commas between"))
          .parameter(
              doc::query("from", place(static_cast<std::int64_t>(kMostCells)), "the first point that is told of"))
          .answer(200, "Rows of [cell, place of the lane, place of the metric, figures…].", any)
          .problem(404, "There is no such campaign.")
          .what()));
  routes.add(make_route(
      "GET", "/api/v1/campaigns/{id}/values", [&services](const auto& q, auto& r) { values(services, q, r); },
      "Values of chosen metrics of all trials, a list a metric",
      doc::Operation()
          .parameter(doc::query("metric", doc::text_schema(),
                                "lane.name or lane.node.name, with :variant; commas "
                                "between; without: all that are not of a node"))
          .parameter(doc::query("cell", place(static_cast<std::int64_t>(kMostCells)), "trials of this point alone"))
          .parameter(doc::query("from", place(kMostTrials), "index of the first trial"))
          .parameter(doc::query("limit", doc::integer_schema(1, kMostValues), "trials an answer, 10000 without"))
          .answer(200, "`values` by `metrics`, null where a trial has none; `next` is the `from` of what is left.", any)
          .problem(404, "There is no such campaign or point.")
          .what()));
}

}  // namespace vigil
