/// The statistics of a campaign's series.
#include <algorithm>
#include <cmath>

#include "engine/core/missing.hpp"
#include "engine/run/campaign_state.hpp"

namespace vigil {
namespace {

bool pooled(const std::string& name) { return name.starts_with("rmse_") || name.starts_with("rms_"); }

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Standard error of the mean; NaN with fewer than two values.
double error_of(const std::vector<double>& values, double mean) {
  if (values.size() < 2) return kMissing;
  double square = 0;
  for (const double value : values) square += (value - mean) * (value - mean);
  const auto n = static_cast<double>(values.size());
  return std::sqrt(square / (n - 1) / n);
}

/// Linear between order statistics: place p (n - 1) of the values in their order.
double quantile(const std::vector<double>& sorted, double p) {
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  if (part == 0 || below + 1 == sorted.size()) return sorted[below];
  return (1 - part) * sorted[below] + part * sorted[below + 1];
}

Json text_or_null(const std::string& value) { return value.empty() ? Json(nullptr) : Json(value); }
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json curve_json(const RocCurve& curve) {
  Json points = Json::array();
  for (const RocPoint& point : curve.points) points.push_back({number_or_null(point.at), point.fpr, point.tpr});
  return {{"area", number_or_null(curve.area)}, {"points", std::move(points)}};
}

}  // namespace

MetricSummary summarise(const TrialSeries& series) {
  MetricSummary summary;
  summary.key = series.key;
  std::vector<double> values;
  std::copy_if(series.values.begin(), series.values.end(), std::back_inserter(values),
               [](double value) { return std::isfinite(value); });
  summary.n = static_cast<std::int64_t>(values.size());
  if (values.empty()) {
    for (double* none : {&summary.mean, &summary.se, &summary.median, &summary.min, &summary.max, &summary.q05,
                         &summary.q25, &summary.q75, &summary.q95})
      *none = kMissing;
    return summary;
  }
  std::vector<double> squares = values;
  const bool root = pooled(series.key.name);
  if (root) {
    for (double& value : squares) value *= value;
  }
  const double mean = mean_of(squares);
  const double error = error_of(squares, mean);
  summary.mean = root ? std::sqrt(mean) : mean;
  summary.se = root ? error / (2 * summary.mean) : error;  // delta method: d sqrt(m) = dm / (2 sqrt(m))
  std::sort(values.begin(), values.end());
  summary.median = quantile(values, 0.5);
  summary.q05 = quantile(values, 0.05);
  summary.q25 = quantile(values, 0.25);
  summary.q75 = quantile(values, 0.75);
  summary.q95 = quantile(values, 0.95);
  summary.min = values.front();
  summary.max = values.back();
  return summary;
}

void pool_ratio(const RatioPool& pool, MetricSummary& summary) {
  const double above = mean_of(pool.above), below = mean_of(pool.below);
  std::vector<double> relative;  // of which the log of the ratio is the mean, to first order
  for (std::size_t i = 0; i < pool.above.size(); ++i) relative.push_back(pool.above[i] / above - pool.below[i] / below);
  summary.mean = std::log2(above / below);
  summary.se = error_of(relative, mean_of(relative)) / std::log(2.0);
}

Json to_json(const MetricSummary& s) {
  const auto number = number_or_null;
  Json quantiles{{"0.05", number(s.q05)}, {"0.25", number(s.q25)}, {"0.75", number(s.q75)}, {"0.95", number(s.q95)}};
  return {{"lane", text_or_null(s.key.lane)},
          {"node", text_or_null(s.key.node)},
          {"name", s.key.name},
          {"variant", text_or_null(s.key.variant)},
          {"mean", number(s.mean)},
          {"se", number(s.se)},
          {"median", number(s.median)},
          {"min", number(s.min)},
          {"max", number(s.max)},
          {"quantiles", std::move(quantiles)},
          {"n", s.n}};
}

Json to_json(const PairedSummary& s) {
  const auto number = number_or_null;
  const PairedDifference& d = s.difference;
  return {{"base", s.base},
          {"lane", text_or_null(s.key.lane)},
          {"node", text_or_null(s.key.node)},
          {"name", s.key.name},
          {"variant", text_or_null(s.key.variant)},
          {"mean", number(d.mean)},
          {"se", number(d.se)},
          {"lo", number(d.lo)},
          {"hi", number(d.hi)},
          {"p", number(d.p)},
          {"n", d.n}};
}

Json to_json(const DetectionSummary& s) {
  const auto share = [&](bool attacked) {
    const auto whole = static_cast<double>(s.counts.ticks(attacked));
    return number_or_null(static_cast<double>(s.counts.alarms(attacked)) / whole);
  };
  return {{"lane", s.lane},
          {"node", text_or_null(s.node)},
          {"attacked", s.counts.ticks(true)},
          {"clean", s.counts.ticks(false)},
          {"own", {{"fpr", share(false)}, {"tpr", share(true)}}},
          {"by_factor", curve_json(s.counts.by_factor())},
          {"by_threshold", curve_json(s.counts.by_threshold())}};
}

}  // namespace vigil
