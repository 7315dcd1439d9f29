#include "engine/run/design.hpp"

#include "engine/run/adversary.hpp"
#include "engine/run/setup.hpp"

namespace vigil {

std::vector<DesignTask> design_tasks(const Scenario& scenario) {
  const Json& document = scenario.document();
  std::vector<DesignTask> tasks;
  std::shared_ptr<const Plant> plant;
  for (const auto& [id, lane] : document["lanes"].items()) {
    const auto* entry = Registry<DesignMake>::find(lane["method"].get<std::string>());
    if (entry == nullptr || !lane.value("enabled", true)) continue;
    if (plant == nullptr) {
      const auto& kind = entry_of<PlantMake>(document["plant"]["type"].get<std::string>(), "/plant/type");
      const double dt = document["time"]["dt"].get<double>();
      plant = under("/plant/params", [&] { return kind.make(Params(document["plant"]["params"]), dt); });
    }
    tasks.push_back(under("/lanes/" + id + "/params", [&] { return entry->make(Params(lane["params"]), *plant); }));
    tasks.back().lane = id;
  }
  return tasks;
}

void check_design(const DesignTask& task, const Json& record) {
  under("/lanes/" + task.lane, [&] { task.check(record); });
}

}  // namespace vigil
