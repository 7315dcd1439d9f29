#include "server/cli/gain_finder.hpp"

#include <chrono>
#include <future>

#include "server/cli/progress.hpp"

namespace vigil {

void GainFinder::add_to(CLI::App& command) {
  command.add_option("--design-limit", limit_, "seconds that finding a lane's gains may take, 120 without")
      ->check(CLI::Range(0.01, 1e6));
}

Json GainFinder::find(const DesignTask& task) {
  if (const auto place = known_.find(task.key); place != known_.end()) return place->second;
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  ChildSolver solver;
  std::future<Json> record = std::async(std::launch::async, [&] { return task.solve(solver, limit_); });
  {
    Progress progress("gains of " + task.lane + ": second", static_cast<std::int64_t>(limit_));
    while (record.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) {
      progress.at(static_cast<std::int64_t>(elapsed()));
    }
  }
  const Json& found = known_[task.key] = record.get();
  seconds_[task.lane] += elapsed();
  return found;
}

void GainFinder::complete(RunOrder& order) {
  for (const DesignTask& task : open_tasks(order)) order.designs[task.lane] = find(task);
}

void GainFinder::require(RunOrder& order) {
  for (const DesignTask& task : open_tasks(order)) {
    Json record = find(task);
    require_gains(task, settle({.lane = task.lane, .key = task.key, .limit = limit_}, record));
    order.designs[task.lane] = std::move(record);
  }
}

Json GainFinder::timing() const {
  if (seconds_.empty()) return {};
  double sum = 0;
  for (const auto& [lane, seconds] : seconds_) sum += seconds;
  return {{"seconds", sum}, {"lanes", seconds_}};
}

void drop_seconds(Json& design, const Json& designs) {
  if (!design.is_object()) return;
  for (const auto& [lane, record] : designs.items()) {
    if (design.contains(lane) && design.at(lane).is_object()) design.at(lane).erase("seconds");
  }
}

}  // namespace vigil
