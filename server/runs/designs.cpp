#include "server/runs/designs.hpp"

#include <algorithm>

#include "engine/core/describe.hpp"

namespace vigil {
namespace {

bool answers(const Json& record, const DesignTask& task) {
  return record.is_object() && record.contains("key") && record.at("key") == task.key;
}

/// The lane's own record, or another lane's of the same problem.
const Json* find(const Json& designs, const DesignTask& task) {
  const auto own = designs.find(task.lane);
  if (own != designs.end() && answers(*own, task)) return &*own;
  const auto other =
      std::find_if(designs.begin(), designs.end(), [&](const Json& record) { return answers(record, task); });
  return other == designs.end() ? nullptr : &*other;
}

}  // namespace

std::vector<DesignTask> open_tasks(RunOrder& order) {
  std::vector<DesignTask> open;
  Json kept = Json::object();
  for (DesignTask& task : design_tasks(order.scenario)) {
    if (const Json* record = find(order.designs, task)) {
      kept[task.lane] = *record;
    } else {
      open.push_back(std::move(task));
    }
  }
  order.designs = std::move(kept);
  return open;
}

void require_gains(const DesignTask& task, const DesignItem& item) {
  std::string why = item.reason;
  try {
    task.check(item.record);
    return;
  } catch (const InputError& error) {
    if (why.empty()) why = error.problems().front().detail;
  }
  throw InputError("/lanes/" + task.lane, "no certified gains: " + why);
}

void check_designs(const Scenario& scenario, const Json& designs) {
  if (designs.empty()) return;
  for (const DesignTask& task : design_tasks(scenario)) {
    const auto place =
        std::find_if(designs.begin(), designs.end(), [&](const Json& record) { return answers(record, task); });
    if (place == designs.end()) continue;
    const std::string pointer = child("/designs", place.key());
    try {
      task.check(*place);
    } catch (const InputError& error) {
      throw InputError(pointer, error.what());
    } catch (const Json::exception&) {
      throw InputError(pointer, "the record of lane " + in_quotes(place.key()) + " cannot be read",
                       "a record of gains");
    }
  }
}

}  // namespace vigil
