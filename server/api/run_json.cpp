#include "server/api/run_json.hpp"

#include <algorithm>

namespace vigil {
namespace {

template <class Rows>
Json list_json(const Rows& rows) {
  Json list = Json::array();
  for (const auto& row : rows) list.push_back(to_json(row));
  return list;
}

Json time_json(const std::optional<WallTime>& time) { return time ? Json(to_rfc3339(*time)) : Json(); }

Json progress_json(const RunRow& row, const RunStatus* live, std::int64_t k) {
  Json progress;
  progress["k"] = k;
  progress["steps"] = row.steps ? Json(*row.steps) : Json();
  progress["t"] = live != nullptr ? live->t : static_cast<double>(std::max<std::int64_t>(k, 0)) * row.dt;
  progress["dt"] = row.dt;
  progress["ticks_per_second"] = live != nullptr && live->ticks_per_second ? Json(*live->ticks_per_second) : Json();
  return progress;
}

struct Look {
  std::shared_ptr<LiveRun> run;
  std::shared_ptr<const RunStatus> status;
};

Look look(const RunRow& row, const Services& services) {
  Look result;
  result.run = services.runs.find(row.id);
  if (result.run) result.status = result.run->status();
  return result;
}

Json base(const RunRow& row, const Look& look, const Services& services) {
  const RunStatus* live = look.status.get();
  Json run;
  run["id"] = std::to_string(row.id);
  run["scenario"] = row.scenario;
  run["document_hash"] = row.document_hash;
  run["family"] = row.family;
  run["title"] = row.title;
  run["state"] = live != nullptr ? live->state : row.state;
  run["seed"] = row.seed;
  run["version"] = row.version;
  run["cpu"] = row.cpu;
  run["pace"] = live != nullptr ? live->pace.to_json() : row.pace;
  run["input"] = row.input;
  run["tags"] = row.tags;
  run["note"] = row.note;
  run["created"] = to_rfc3339(row.created);
  run["started"] = time_json(live != nullptr && live->started ? live->started : row.started);
  run["ended"] = time_json(live != nullptr && live->ended ? live->ended : row.ended);
  run["progress"] = progress_json(row, live, look.run ? std::max(look.run->tick(), row.k) : row.k);
  run["epoch"] = services.hub.epoch(row.id);
  run["parent"] = row.parent ? Json{{"run", std::to_string(row.parent->run)}, {"k", row.parent->k}} : Json();
  run["viewers"] = services.hub.viewers(row.id);
  run["idle"] = live != nullptr && live->idle;
  return run;
}

void add_end(Json& run, const RunRow& row, const RunStatus* live) {
  run["faults"] = list_json(live != nullptr ? live->faults : row.faults);
  run["warnings"] = live != nullptr ? live->warnings : row.warnings;
  const std::string& error = live != nullptr && !live->error.empty() ? live->error : row.error;
  run["error"] = error.empty() ? Json() : Json(error);
  run["reproducible"] = row.reproducible;
  run["log"] = {{"gaps", row.gaps}};
  run["changes"] = row.changes;
}

}  // namespace

Json run_item(const RunRow& row, const Services& services) {
  const Look now = look(row, services);
  Json run = base(row, now, services);
  std::vector<MetricValue> metrics = now.status ? now.status->metrics : row.metrics;
  std::erase_if(metrics, [](const MetricValue& metric) { return !metric.node.empty(); });
  run["metrics"] = list_json(metrics);
  add_end(run, row, now.status.get());
  return run;
}

Json run_detail(const RunRow& row, const Services& services) {
  const Look now = look(row, services);
  Json run = base(row, now, services);
  run["metrics"] = list_json(now.status ? now.status->metrics : row.metrics);
  run["design"] = now.status ? now.status->design : row.design;
  run["designing"] = Json::array();
  for (const DesignItem& item : services.runs.designing(row.id)) run["designing"].push_back(to_json(item));
  add_end(run, row, now.status.get());
  run["commands"] = Json::array();
  for (const Command& command : row.commands) run["commands"].push_back({{"k", command.k}, {"body", command.body}});
  run["document"] = row.document;
  run["world"] = now.status ? now.status->world : row.world;
  run["view"] = row.document.is_object() && row.document.contains("view") ? row.document.at("view") : Json::object();
  return run;
}

RunRow run_row(const HttpRequest& request, const Services& services) {
  auto row = services.reader.run(request.id_param("id"));
  if (!row) throw HttpError(404, "There is no run " + request.params.at("id") + ".");
  return std::move(*row);
}

std::shared_ptr<LiveRun> live_run(const HttpRequest& request, const Services& services) {
  if (auto run = services.runs.find(request.id_param("id"))) return run;
  const RunRow row = run_row(request, services);
  const std::string end = row.state == "designing" ? "until its gains are found it can only be stopped or deleted."
                                                   : "it can no longer be changed.";
  throw HttpError(409, "Run " + request.params.at("id") + " is " + row.state + ": " + end);
}

}  // namespace vigil
