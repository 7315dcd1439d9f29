#include "engine/run/campaign.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "engine/metrics/bound_ratio.hpp"
#include "engine/metrics/confidentiality_score.hpp"
#include "engine/run/state.hpp"

namespace vigil {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

class NullSink final : public Sink {
 public:
  void frame(const Frame& /*frame*/) override {}
  void mark(const Mark& /*mark*/) override {}
};

bool pooled(const std::string& name) { return name.starts_with("rmse_") || name.starts_with("rms_"); }

/// The values of one metric over trials, in trial order. Kept whole: medians need them, and a campaign's are few.
struct Series {
  MetricValue key;
  std::vector<double> values;
};

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Standard error of the mean; NaN with fewer than two values.
double error_of(const std::vector<double>& values, double mean) {
  if (values.size() < 2) return kNone;
  double square = 0;
  for (const double value : values) square += (value - mean) * (value - mean);
  const auto n = static_cast<double>(values.size());
  return std::sqrt(square / (n - 1) / n);
}

MetricSummary summarise(const Series& series) {
  MetricSummary summary;
  summary.key = series.key;
  summary.n = static_cast<std::int64_t>(series.values.size());
  if (series.values.empty()) {
    summary.mean = summary.se = summary.median = summary.min = summary.max = kNone;
    return summary;
  }
  std::vector<double> squares = series.values;
  const bool root = pooled(series.key.name);
  if (root) {
    for (double& value : squares) value *= value;
  }
  const double mean = mean_of(squares);
  const double error = error_of(squares, mean);
  summary.mean = root ? std::sqrt(mean) : mean;
  summary.se = root ? error / (2 * summary.mean) : error;  // delta method: d sqrt(m) = dm / (2 sqrt(m))
  std::vector<double> sorted = series.values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  summary.median = sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
  summary.min = sorted.front();
  summary.max = sorted.back();
  return summary;
}

/// Above and below of a log-ratio, in trial order.
struct RatioPool {
  std::vector<double> above, below;
};

/// log2 of the ratio of means; its standard error by the delta method, with the covariance of the two.
void pool_ratio(const RatioPool& pool, MetricSummary& summary) {
  const double above = mean_of(pool.above), below = mean_of(pool.below);
  std::vector<double> relative;  // of which the log of the ratio is the mean, to first order
  for (std::size_t i = 0; i < pool.above.size(); ++i) relative.push_back(pool.above[i] / above - pool.below[i] / below);
  summary.mean = std::log2(above / below);
  summary.se = error_of(relative, mean_of(relative)) / std::log(2.0);
}

}  // namespace

struct TrialResult::Extra {
  std::vector<BoundRecord> bounds;
  std::vector<RatioRecord> ratios;
};

TrialResult::TrialResult() = default;
TrialResult::TrialResult(TrialResult&&) noexcept = default;
TrialResult& TrialResult::operator=(TrialResult&&) noexcept = default;
TrialResult::~TrialResult() = default;

TrialResult run_trial(const Scenario& scenario, std::uint64_t seed, std::shared_ptr<const Trace> trace,
                      const Json& designs) {
  Run run(scenario, {seed, std::move(trace), {}, designs});
  if (!run.steps())
    throw InputError("/time/steps", "steps is null: a trial of a campaign must end by itself", "a whole number");
  NullSink sink;
  while (!run.done()) run.step(sink);
  TrialResult result;
  result.seed = seed;
  result.metrics = run.metrics();
  result.faults = run.faults();
  result.warnings = run.warnings();
  result.design = run.design();
  result.ticks = run.tick();
  result.extra = std::make_unique<TrialResult::Extra>();
  for (Lane& lane : TrialAccess::state(run).lanes) {
    result.extra->bounds.push_back(lane.take_record());
    if (const FusionSide* side = lane.fusion_side()) side->append_ratios(result.extra->ratios);
  }
  return result;
}

struct CampaignTable::State {
  using Key = std::tuple<std::string, std::string, std::string, std::string>;
  std::map<Key, std::size_t> places;
  std::vector<Series> series;  ///< in the order first seen
  std::map<std::string, BoundRatio> bounds;
  std::map<Key, RatioPool> ratios;  ///< of the series with the same key
  std::vector<std::string> lanes;   ///< with a bound record, in order
  std::int64_t trials = 0;
};

CampaignTable::CampaignTable() : state_(std::make_unique<State>()) {}
CampaignTable::~CampaignTable() = default;

void CampaignTable::add(const TrialResult& trial) {
  ++state_->trials;
  for (const MetricValue& metric : trial.metrics) {
    const State::Key key{metric.lane, metric.node, metric.name, metric.variant};
    const auto [place, fresh] = state_->places.try_emplace(key, state_->series.size());
    if (fresh) state_->series.push_back({metric, {}});
    if (std::isfinite(metric.value)) state_->series[place->second].values.push_back(metric.value);
  }
  if (!trial.extra) return;
  for (const RatioRecord& ratio : trial.extra->ratios) {
    auto& pool = state_->ratios[{ratio.lane, "", ratio.name, ratio.variant}];
    pool.above.push_back(ratio.above);
    pool.below.push_back(ratio.below);
  }
  for (const BoundRecord& record : trial.extra->bounds) {
    if (record.errors.empty()) continue;
    const auto [place, fresh] = state_->bounds.try_emplace(record.lane);
    if (fresh) state_->lanes.push_back(record.lane);
    place->second.add(record);
  }
}

std::vector<MetricSummary> CampaignTable::summary() const {
  std::vector<MetricSummary> summary;
  for (const Series& series : state_->series) {
    summary.push_back(summarise(series));
    const auto& key = series.key;
    const auto pool = state_->ratios.find({key.lane, key.node, key.name, key.variant});
    if (pool != state_->ratios.end()) pool_ratio(pool->second, summary.back());
  }
  for (const std::string& lane : state_->lanes) {
    MetricSummary ratio;
    ratio.key = {lane, "", "bound_ratio_max", "", 0, false};
    ratio.mean = state_->bounds.at(lane).max();
    ratio.se = ratio.median = ratio.min = ratio.max = kNone;  // one figure of all trials together
    ratio.n = state_->trials;
    summary.push_back(ratio);
  }
  return summary;
}

std::int64_t CampaignTable::trials() const { return state_->trials; }

Json to_json(const MetricSummary& summary) {
  const auto text = [](const std::string& value) { return value.empty() ? Json(nullptr) : Json(value); };
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  return {{"lane", text(summary.key.lane)},   {"node", text(summary.key.node)},
          {"name", summary.key.name},         {"variant", text(summary.key.variant)},
          {"mean", number(summary.mean)},     {"se", number(summary.se)},
          {"median", number(summary.median)}, {"min", number(summary.min)},
          {"max", number(summary.max)},       {"n", summary.n}};
}

}  // namespace vigil
