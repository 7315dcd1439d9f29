#include "engine/identify/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/run/run.hpp"

namespace vigil::identify {
namespace {

constexpr std::int64_t kFirst = 50;   ///< where false alarms begin to count: metrics.detection.from
constexpr double kUnreachable = 1e9;  ///< no cumulative sum restarts while its level is sought

const char* threshold_of(const std::string& type) { return type == "cusum" ? "threshold" : "level"; }

/// Collects the statistics of lanes in ticks that no label calls attacked.
class Statistics final : public Sink {
 public:
  explicit Statistics(const Catalogue& catalogue) {
    for (const Signal& signal : catalogue.all()) {
      if (signal.name.ends_with(".statistic") && !signal.lane.empty()) places_[signal.lane].push_back(signal.id);
      if (signal.name.starts_with("sensor.") && signal.name.ends_with(".state")) states_.push_back(signal.id);
    }
  }

  void frame(const Frame& frame) override {
    const auto at = [&](int id) { return frame.values[static_cast<std::size_t>(id)]; };
    if (frame.k < kFirst || std::any_of(states_.begin(), states_.end(), [&](int id) { return at(id) > 0; })) return;
    for (const auto& [lane, ids] : places_) {
      for (const int id : ids) {
        if (std::isfinite(at(id))) values_[lane].push_back(at(id));
      }
    }
  }
  void mark(const Mark& /*mark*/) override {}

  std::size_t outputs(const std::string& lane) const { return places_.contains(lane) ? places_.at(lane).size() : 0; }

  /// What the lane's statistics exceed in `rate` of the cases; NaN where there were none.
  double exceeded(const std::string& lane, double rate) {
    std::vector<double>& values = values_[lane];
    if (values.empty()) return std::nan("");
    const auto last = static_cast<double>(values.size() - 1);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::ceil((1 - rate) * last));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  }

 private:
  std::map<std::string, std::vector<int>> places_;
  std::map<std::string, std::vector<double>> values_;
  std::vector<int> states_;
};

std::string detector_of(const Json& lane) {
  const Json detector = lane.value("detector", Json::object());
  return detector.value("type", "none");
}

}  // namespace

Scenario calibrated(const Scenario& scenario, const std::shared_ptr<const Trace>& trace, double rate) {
  Json learning = Json::object();
  for (const auto& [id, lane] : scenario.document()["lanes"].items()) {
    if (detector_of(lane) == "cusum") learning["lanes"][id]["detector"]["params"]["threshold"] = kUnreachable;
  }
  Run run(scenario.patched(learning), {1, trace, {}});
  Statistics statistics(run.catalogue());
  while (!run.done()) run.step(statistics);
  Json patch = Json::object();
  for (const auto& [id, lane] : scenario.document()["lanes"].items()) {
    const std::string type = detector_of(lane);
    if (type != "cusum" && (type != "fixed" || statistics.outputs(id) != 1)) continue;
    const double level = statistics.exceeded(id, rate);
    if (std::isfinite(level)) patch["lanes"][id]["detector"]["params"][threshold_of(type)] = level;
  }
  return scenario.patched(patch);
}

}  // namespace vigil::identify
