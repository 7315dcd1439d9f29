#include "server/runs/demo.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace vigil {
namespace {

constexpr const char* kSetting = "demo_runs";  // ids of the demo runs this log has, oldest first

Json forget_old(Json earlier, LogWriter& log, const LogReader& reader) {
  if (!earlier.is_array()) earlier = Json::array();
  Json kept = Json::array();
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    const RunId id = earlier[i].get<RunId>();
    const auto row = reader.run(id);
    if (!row || std::find(row->tags.begin(), row->tags.end(), "keep") != row->tags.end()) continue;
    if (i + 1 == earlier.size()) {
      kept.push_back(id);
    } else {
      log.delete_run(id);
    }
  }
  return kept;
}

}  // namespace

RunId start_demo(RunManager& runs, LogWriter& log, const LogReader& reader) {
  Json known = Json::array();
  try {
    known = forget_old(reader.setting(kSetting), log, reader);
  } catch (const std::exception& failure) {
    // A demo that cannot be tidied up must not keep the server from starting.
    spdlog::warn("old demo runs were not removed: {}", failure.what());
  }
  RunOrder order;
  // A merge patch deletes what is null; the endless run needs the null itself.
  order.scenario = Scenario::preset("consensus")
                       .with("time.steps", nullptr)
                       .patched(Json{{"log", {{"keep", 600}, {"policy", "live"}}}});
  order.pace = Pace{20.0};
  order.tags = {"demo"};
  order.sleeps_unwatched = true;
  const RunId id = runs.create(std::move(order)).id;
  known.push_back(id);
  log.set_setting(kSetting, known);
  return id;
}

}  // namespace vigil
