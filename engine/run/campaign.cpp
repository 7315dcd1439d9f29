#include "engine/run/campaign.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/missing.hpp"
#include "engine/run/campaign_state.hpp"

namespace vigil {

CampaignTable::CampaignTable() : state_(std::make_unique<State>()) {}
CampaignTable::CampaignTable(CampaignTable&&) noexcept = default;
CampaignTable& CampaignTable::operator=(CampaignTable&&) noexcept = default;
CampaignTable::~CampaignTable() = default;

void pool_block(std::vector<TrialResult>& trials, std::size_t first, std::size_t count) {
  std::vector<std::pair<std::string, BoundSums>> sums;
  for (std::size_t i = first; i < first + count; ++i) {
    if (!trials[i].extra) continue;
    for (const BoundRecord& record : trials[i].extra->bounds) {
      if (record.errors.empty()) continue;
      const auto same = [&](const auto& one) { return one.first == record.lane; };
      auto place = std::find_if(sums.begin(), sums.end(), same);
      if (place == sums.end()) place = sums.insert(place, {record.lane, {}});
      place->second.add(record);
    }
    trials[i].extra->bounds.clear();
  }
  if (sums.empty()) return;
  for (std::size_t i = first; i + 1 < first + count; ++i) trials[i].more = true;
  TrialResult& last = trials[first + count - 1];
  if (!last.extra) last.extra = std::make_unique<TrialResult::Extra>();
  last.extra->sums = std::move(sums);
}

BoundRatio& CampaignTable::State::ratio_of(const std::string& lane) {
  const auto [place, fresh] = bounds.try_emplace(lane);
  if (fresh) lanes.push_back(lane);
  return place->second;
}

void CampaignTable::add(const TrialResult& trial) {
  add_values(trial);
  if (trial.extra) add_extra(*trial.extra);
  if (state_->trials % kTrialBlock != 0) return;
  for (auto& [lane, ratio] : state_->bounds) ratio.close_block();
}

void CampaignTable::add_values(const TrialResult& trial) {
  const auto row = static_cast<std::size_t>(state_->trials++);
  for (const MetricValue& metric : trial.metrics) {
    const State::Key key{metric.lane, metric.node, metric.name, metric.variant};
    const auto [place, fresh] = state_->places.try_emplace(key, state_->series.size());
    if (fresh) state_->series.push_back({metric, {}});
    auto& values = state_->series[place->second].values;
    values.resize(row, kMissing);
    values.push_back(metric.value);
  }
}

void CampaignTable::add_extra(const TrialResult::Extra& extra) {
  for (const RatioRecord& ratio : extra.ratios) {
    auto& pool = state_->ratios[{ratio.lane, "", ratio.name, ratio.variant}];
    pool.above.push_back(ratio.above);
    pool.below.push_back(ratio.below);
  }
  for (const BoundRecord& record : extra.bounds) {
    if (!record.errors.empty()) state_->ratio_of(record.lane).add(record);
  }
  for (const auto& [lane, sums] : extra.sums) state_->ratio_of(lane).add(sums);
  for (const DetectionSummary& one : extra.detection) {
    auto& all = state_->detection;
    const auto same = [&](const DetectionSummary& sum) { return sum.lane == one.lane && sum.node == one.node; };
    const auto place = std::find_if(all.begin(), all.end(), same);
    if (place == all.end()) {
      all.push_back(one);
    } else {
      place->counts.merge(one.counts);
    }
  }
}

std::vector<MetricSummary> CampaignTable::summary() const {
  std::vector<MetricSummary> summary;
  for (const TrialSeries& series : state_->series) {
    summary.push_back(summarise(series));
    const auto& key = series.key;
    const auto pool = state_->ratios.find({key.lane, key.node, key.name, key.variant});
    if (pool != state_->ratios.end()) pool_ratio(pool->second, summary.back());
  }
  for (const std::string& lane : state_->lanes) {
    MetricSummary ratio;
    ratio.key = {lane, "", "bound_ratio_max", "", 0, false};
    ratio.mean = state_->bounds.at(lane).max();
    for (double* none :
         {&ratio.se, &ratio.median, &ratio.min, &ratio.max, &ratio.q05, &ratio.q25, &ratio.q75, &ratio.q95})
      *none = kMissing;  // one figure of all trials together
    ratio.n = state_->trials;
    summary.push_back(ratio);
  }
  return summary;
}

std::vector<PairedSummary> CampaignTable::paired() const {
  std::vector<std::string> lanes;
  for (const TrialSeries& series : state_->series) {
    if (std::find(lanes.begin(), lanes.end(), series.key.lane) == lanes.end()) lanes.push_back(series.key.lane);
  }
  std::vector<PairedSummary> all;
  for (std::size_t base = 0; base < lanes.size(); ++base) {
    for (std::size_t other = base + 1; other < lanes.size(); ++other) {
      for (const TrialSeries& a : state_->series) {
        if (a.key.lane != lanes[base]) continue;
        const auto place = state_->places.find({lanes[other], a.key.node, a.key.name, a.key.variant});
        if (place == state_->places.end()) continue;
        const TrialSeries& b = state_->series[place->second];
        PairedSummary pair{b.key, lanes[base], paired_difference(a.values, b.values)};
        if (pair.difference.n > 0) all.push_back(std::move(pair));
      }
    }
  }
  return all;
}

std::vector<DetectionSummary> CampaignTable::detection() const { return state_->detection; }

std::int64_t CampaignTable::trials() const { return state_->trials; }

std::string CampaignTable::save() const {
  ByteWriter out;
  out.word(state_->lanes.size());
  for (const std::string& lane : state_->lanes) {
    out.text(lane);
    state_->bounds.at(lane).save(out);
  }
  out.word(state_->detection.size());
  for (const DetectionSummary& one : state_->detection) {
    out.text(one.lane);
    out.text(one.node);
    one.counts.save(out);
  }
  return out.take();
}

void CampaignTable::load(std::string_view bytes) {
  state_->lanes.clear();
  state_->bounds.clear();
  state_->detection.clear();
  if (bytes.empty()) return;
  ByteReader in(bytes);
  for (std::size_t left = in.count(8); left > 0; --left) {
    state_->lanes.push_back(in.text());
    state_->bounds[state_->lanes.back()].load(in);
  }
  for (std::size_t left = in.count(8); left > 0; --left) {
    DetectionSummary& one = state_->detection.emplace_back();
    one.lane = in.text();
    one.node = in.text();
    one.counts.load(in);
  }
  if (!in.done()) throw std::runtime_error("Saved accumulators have something left over.");
}

}  // namespace vigil
