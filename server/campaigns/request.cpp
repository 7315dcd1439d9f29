#include "server/campaigns/request.hpp"

#include <algorithm>
#include <thread>

#include "engine/core/input_error.hpp"

namespace vigil {

Json CampaignRequest::to_json() const {
  Json grid = Json::object();
  for (const auto& [path, values] : sweep) grid[path] = values;
  Json json{{"scenario", scenario.document()},
            {"runs", runs},
            {"first_seed", first_seed},
            {"sweep", std::move(grid)},
            {"threads", threads},
            {"crew", workers ? "workers" : "threads"},
            {"samples", samples},
            {"tags", tags},
            {"note", note}};
  if (trace) json["trace"] = *trace;
  return json;
}

CampaignRequest CampaignRequest::from_json(const Json& json) {
  CampaignRequest request;
  request.scenario = Scenario::from_json(json.at("scenario"));
  request.runs = json.at("runs");
  request.first_seed = json.at("first_seed");
  for (const auto& [path, values] : json.at("sweep").items())
    request.sweep.emplace_back(path, values.get<std::vector<Json>>());
  request.threads = json.value("threads", 0);
  request.workers = json.value("crew", "threads") == "workers";
  request.samples = json.value("samples", false);
  request.tags = json.value("tags", std::vector<std::string>());
  request.note = json.value("note", "");
  if (json.contains("trace")) request.trace = json.at("trace").get<std::int64_t>();
  return request;
}

std::string CampaignRequest::identity() const {
  Json json = to_json();
  for (const char* other : {"threads", "crew", "tags", "note"}) json.erase(other);
  return json.dump();
}

std::size_t CampaignRequest::cells() const {
  std::size_t cells = 1;
  for (const auto& [path, values] : sweep) cells = std::min(cells * values.size(), kMostCells + 1);
  return cells;
}

int all_cores() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

CampaignPlan make_plan(const CampaignRequest& request) {
  const std::size_t cells = request.cells();
  if (cells == 0) throw InputError("/sweep", "a path of the sweep has no value; expected at least one");
  if (cells > kMostCells) {
    throw InputError("/sweep", "the sweep asks for more than " + std::to_string(kMostCells) + " points",
                     "up to " + std::to_string(kMostCells) + " points");
  }
  if (request.runs > kMostTrials / static_cast<std::int64_t>(cells))
    throw InputError("/runs", "the campaign has more than 10000000 trials", "up to 10000000 trials in all");
  CampaignPlan plan;
  plan.points = make_grid(request.scenario, request.sweep);
  plan.runs = request.runs;
  plan.first_seed = request.first_seed;
  plan.threads = request.threads > 0 ? request.threads : all_cores();
  return plan;
}

NewCampaign new_campaign(const CampaignRequest& request, const CampaignPlan& plan) {
  NewCampaign campaign;
  campaign.request = request.to_json();
  campaign.trials = plan.trials();
  for (const CampaignPoint& point : plan.points) {
    CampaignCellRow& row = campaign.cells.emplace_back();
    row.cell = static_cast<std::int64_t>(campaign.cells.size()) - 1;
    row.sweep = point.sweep;
    if (!point.designs.empty()) row.designs = point.designs;
  }
  return campaign;
}

}  // namespace vigil
