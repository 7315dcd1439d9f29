#include "server/api/campaign_json.hpp"

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
            {"samples", request.value("samples", false)},
            {"tags", request.value("tags", Json::array())},
            {"note", request.value("note", "")}};
  item["progress"] = {{"done", row.done},
                      {"trials", row.trials},
                      {"failed", row.failed},
                      {"trials_per_second", speed ? Json(speed->trials_per_second) : Json()},
                      {"seconds_left", speed && speed->seconds_left ? Json(*speed->seconds_left) : Json()}};
  item["created"] = to_rfc3339(row.created);
  item["ended"] = row.ended ? Json(to_rfc3339(*row.ended)) : Json();
  item["error"] = row.error.empty() ? Json() : Json(row.error);
  return item;
}

std::vector<CellResult> campaign_cells(const CampaignRow& row, const Services& services) {
  const std::int64_t runs = row.request.value("runs", std::int64_t{1});
  std::vector<CellResult> cells;
  for (CampaignCellRow& cell : services.reader.campaign_cells(row.id)) {
    const bool begun = cell.cell * runs < row.done;
    cells.push_back(
        {cell.cell, std::move(cell.sweep), begun ? cell_result(services.reader, row.id, cell.cell, runs) : Json()});
  }
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

}  // namespace vigil
