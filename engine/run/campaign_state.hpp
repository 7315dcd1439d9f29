/// Inside of campaigns: what a trial leaves for accumulators, and the table's series.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "engine/metrics/bound_ratio.hpp"
#include "engine/metrics/confidentiality_score.hpp"
#include "engine/run/campaign.hpp"

namespace vigil {

struct TrialResult::Extra {
  std::vector<BoundRecord> bounds;
  std::vector<std::pair<std::string, BoundSums>> sums;  ///< by lane: of this trial's whole block, in place of bounds
  std::vector<RatioRecord> ratios;
  std::vector<DetectionSummary> detection;
};

/// The values of one metric, one a trial, NaN where it has none; as long as the last trial that had the metric. Kept
/// whole: medians and pairs need them.
struct TrialSeries {
  MetricValue key;
  std::vector<double> values;
};

/// Above and below of a log-ratio, in trial order.
struct RatioPool {
  std::vector<double> above, below;
};

MetricSummary summarise(const TrialSeries& series);
/// log2 of the ratio of means; its standard error by the delta method, with the covariance of the two.
void pool_ratio(const RatioPool& pool, MetricSummary& summary);

struct CampaignTable::State {
  using Key = std::tuple<std::string, std::string, std::string, std::string>;
  std::map<Key, std::size_t> places;
  std::vector<TrialSeries> series;  ///< in the order first seen
  std::map<std::string, BoundRatio> bounds;
  std::map<Key, RatioPool> ratios;  ///< of the series with the same key
  std::vector<std::string> lanes;   ///< with a bound record, in order
  std::vector<DetectionSummary> detection;
  std::int64_t trials = 0;

  BoundRatio& ratio_of(const std::string& lane);
};

}  // namespace vigil
