#include "server/api/campaign_json.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "server/campaigns/manager.hpp"
#include "server/campaigns/work.hpp"

namespace vigil {

CampaignRow campaign_row(const HttpRequest& request, const Services& services) {
  auto row = services.reader.campaign(request.id_param("id"));
  if (!row) throw HttpError(404, "There is no campaign " + request.params.at("id") + ".");
  return std::move(*row);
}

Json campaign_item(const CampaignRow& row, const Services& services) {
  const Json& request = row.request;
  const auto speed = services.campaigns.speed(row.id);
  const std::int64_t runs = request.value("runs", std::int64_t{1});
  Json item{{"id", std::to_string(row.id)},
            {"state", row.state},
            {"scenario", request.contains("scenario") ? request.at("scenario").value("id", "") : ""},
            {"runs", runs},
            {"first_seed", request.value("first_seed", Json())},
            {"sweep", request.value("sweep", Json::object())},
            {"points", row.trials / std::max<std::int64_t>(runs, 1)},
            {"threads", request.value("threads", 0)},
            {"crew", request.value("crew", "threads")},
            {"workers", Json::array()},
            {"samples", request.value("samples", false)},
            {"tags", request.value("tags", Json::array())},
            {"note", request.value("note", "")}};
  item["progress"] = {{"done", row.done},
                      {"trials", row.trials},
                      {"failed", row.failed},
                      {"trials_per_second", speed ? Json(speed->trials_per_second) : Json()},
                      {"seconds_left", speed && speed->seconds_left ? Json(*speed->seconds_left) : Json()}};
  for (const CrewMember& member : services.campaigns.workers(row.id)) item["workers"].push_back(to_json(member));
  item["created"] = to_rfc3339(row.created);
  item["ended"] = row.ended ? Json(to_rfc3339(*row.ended)) : Json();
  item["error"] = row.error.empty() ? Json() : Json(row.error);
  if (const auto end = services.campaigns.unlogged(row.id)) {
    item["state"] = end->state;
    item["error"] = end->error.empty() ? Json() : Json(end->error);
  }
  return item;
}

std::string metric_id(const std::string& node, const std::string& name, const std::string& variant) {
  const std::string text = node.empty() ? name : node + "." + name;
  return variant.empty() ? text : text + ":" + variant;
}

std::vector<std::string> comma_words(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    if (comma > from) words.push_back(text.substr(from, comma - from));
    from = comma + 1;
  }
  return words;
}

std::vector<CellResult> campaign_cells(const CampaignRow& row, CampaignResults& results, const Services& services) {
  std::vector<CellResult> cells;
  for (CampaignCellRow& cell : services.reader.campaign_cells(row.id))
    cells.push_back({cell.cell, std::move(cell.sweep), results.result(row, cell.cell)});
  return cells;
}

Json campaign_detail(const CampaignRow& row, const std::vector<CellResult>& cells, const Services& services) {
  Json detail = campaign_item(row, services);
  const std::int64_t runs = detail.at("runs");
  detail["document"] = row.request.value("scenario", Json());
  detail["trials"] = trials_of(cells);
  Json list = Json::array();
  Json metrics = Json::array();
  for (const CellResult& cell : cells) {
    const std::int64_t done = std::clamp<std::int64_t>(row.done - cell.cell * runs, 0, runs);
    list.push_back({{"cell", cell.cell}, {"sweep", cell.sweep}, {"done", done}});
    if (cell.result.is_null()) continue;
    list.back()["trials"] = cell.result.at("trials");
    list.back()["ticks"] = cell.result.at("ticks");
    for (const Json& metric : cell.result.at("metrics")) {
      metrics.push_back(metric);
      metrics.back()["sweep"] = cell.sweep;
      metrics.back()["cell"] = cell.cell;
    }
  }
  detail["cells"] = std::move(list);
  detail["metrics"] = std::move(metrics);
  detail["faults"] = rows_of(cells, "faults");
  detail["warnings"] = warnings_of(cells);
  return detail;
}

namespace {

/// {"lanes":[…],"metrics":[{"id","node","lanes":[places]}]}, in the order in which they first came.
Json names_of(const std::vector<SummaryRow>& rows) {
  std::map<std::string, std::size_t> lanes, metrics;
  std::set<std::pair<std::size_t, std::size_t>> seen;
  Json names{{"lanes", Json::array()}, {"metrics", Json::array()}};
  for (const SummaryRow& cell : rows) {
    for (const CellSummary::Row& row : cell.summary.rows) {
      const std::string id = metric_id(row.node, row.name, row.variant);
      const auto [lane, new_lane] = lanes.try_emplace(row.lane, lanes.size());
      if (new_lane) names["lanes"].push_back(row.lane);
      const auto [metric, new_metric] = metrics.try_emplace(id, metrics.size());
      if (new_metric) {
        const Json node = row.node.empty() ? Json() : Json(row.node);
        names["metrics"].push_back({{"id", id}, {"node", node}, {"lanes", Json::array()}});
      }
      if (seen.emplace(metric->second, lane->second).second)
        names["metrics"][metric->second]["lanes"].push_back(lane->second);
    }
  }
  return names;
}

void add_warnings(Json& all, const Json& warnings) {
  for (const Json& warning : warnings) {
    if (std::find(all.begin(), all.end(), warning) == all.end()) all.push_back(warning);
  }
}

}  // namespace

Json campaign_outline(const CampaignRow& row, CampaignResults& results, const Services& services) {
  Json outline = campaign_item(row, services);
  outline["document"] = row.request.value("scenario", Json());
  const std::int64_t runs = outline.at("runs");
  const std::vector<SummaryRow> summaries = results.summaries(row);
  Json sum{{"finished", 0}, {"stopped", 0}, {"failed", 0}}, warnings = Json::array(), cells = Json::array();
  for (const CampaignCellRow& cell : services.reader.campaign_cells(row.id)) {
    const std::int64_t done = std::clamp<std::int64_t>(row.done - cell.cell * runs, 0, runs);
    cells.push_back({{"cell", cell.cell}, {"sweep", cell.sweep}, {"done", done}});
    const auto place = static_cast<std::size_t>(cell.cell);
    if (place >= summaries.size()) continue;
    const CellSummary& summary = summaries[place].summary;
    cells.back()["trials"] = summary.trials;
    cells.back()["ticks"] = summary.ticks;
    for (auto& [state, count] : sum.items())
      count = count.get<std::int64_t>() + summary.trials.value(state, std::int64_t{0});
    add_warnings(warnings, summary.warnings);
  }
  outline["trials"] = std::move(sum);
  outline["cells"] = std::move(cells);
  outline["names"] = names_of(summaries);
  outline["warnings"] = std::move(warnings);
  return outline;
}

}  // namespace vigil
