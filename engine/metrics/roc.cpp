#include "engine/metrics/roc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil {
namespace {

/// 0: below all edges; kBins - 1: at or above the last one.
std::size_t bin_of(double value) {
  if (!(value > 0)) return 0;  // also NaN
  const double place =
      std::floor(std::log2(value) * RocCounts::kPerOctave) + RocCounts::kOctaves * RocCounts::kPerOctave;
  return static_cast<std::size_t>(std::clamp(place + 1, 0.0, static_cast<double>(RocCounts::kBins - 1)));
}

/// Lower edge of a bin above the lowest.
double edge(std::size_t bin) {
  const double place = static_cast<double>(bin) - 1 - RocCounts::kOctaves * RocCounts::kPerOctave;
  return std::exp2(place / RocCounts::kPerOctave);
}

}  // namespace

void RocCounts::count(Bins& bins, bool attacked, double value) {
  auto& own = bins[attacked ? 1 : 0];
  if (own.empty()) own.assign(kBins, 0);
  ++own[bin_of(value)];
}

void RocCounts::note(bool attacked, double statistic, double threshold, bool alarm) {
  ++ticks_[attacked ? 1 : 0];
  alarms_[attacked ? 1 : 0] += alarm ? 1 : 0;
  count(statistic_, attacked, statistic);
  count(ratio_, attacked, threshold > 0 ? statistic / threshold : std::numeric_limits<double>::quiet_NaN());
}

void RocCounts::merge(const RocCounts& other) {
  const auto add = [](Bins& to, const Bins& from) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (from[side].empty()) continue;
      if (to[side].empty()) to[side].assign(kBins, 0);
      for (std::size_t b = 0; b < kBins; ++b) to[side][b] += from[side][b];
    }
  };
  for (std::size_t side = 0; side < 2; ++side) {
    ticks_[side] += other.ticks_[side];
    alarms_[side] += other.alarms_[side];
  }
  add(statistic_, other.statistic_);
  add(ratio_, other.ratio_);
}

RocCurve RocCounts::curve(const Bins& bins) const {
  const auto at = [&](std::size_t side, std::size_t bin) { return bins[side].empty() ? 0 : bins[side][bin]; };
  const auto rate = [](std::int64_t part, std::int64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  RocCurve curve;
  curve.points.push_back({std::numeric_limits<double>::infinity(), 0, 0});
  std::int64_t clean = 0, attacked = 0;
  for (std::size_t bin = kBins; bin-- > 0;) {
    if (at(0, bin) + at(1, bin) == 0) continue;
    clean += at(0, bin);
    attacked += at(1, bin);
    const RocPoint next{bin == 0 ? 0 : edge(bin), rate(clean, ticks_[0]), rate(attacked, ticks_[1])};
    const RocPoint& last = curve.points.back();
    curve.area += (next.fpr - last.fpr) * (next.tpr + last.tpr) / 2;
    curve.points.push_back(next);
  }
  if (curve.points.back().at > 0) curve.points.push_back({0, rate(clean, ticks_[0]), rate(attacked, ticks_[1])});
  if (ticks_[0] == 0 || ticks_[1] == 0) curve.area = std::numeric_limits<double>::quiet_NaN();
  return curve;
}

void RocCounts::save(ByteWriter& out) const {
  for (std::size_t side = 0; side < 2; ++side) {
    out.integer(ticks_[side]);
    out.integer(alarms_[side]);
    for (const Bins* bins : {&statistic_, &ratio_}) {
      const auto& own = (*bins)[side];
      out.word(static_cast<std::uint64_t>(std::count_if(own.begin(), own.end(), [](auto n) { return n != 0; })));
      for (std::size_t b = 0; b < own.size(); ++b) {
        if (own[b] == 0) continue;
        out.word(b);
        out.integer(own[b]);
      }
    }
  }
}

void RocCounts::load(ByteReader& in) {
  for (std::size_t side = 0; side < 2; ++side) {
    ticks_[side] = in.integer();
    alarms_[side] = in.integer();
    for (Bins* bins : {&statistic_, &ratio_}) {
      auto& own = (*bins)[side];
      const std::size_t items = in.count(16);
      own.assign(items == 0 ? 0 : kBins, 0);
      for (std::size_t i = 0; i < items; ++i) {
        const std::uint64_t bin = in.word();
        if (bin >= kBins) throw std::runtime_error("Saved counts have a bin that is not there.");
        own[bin] = in.integer();
      }
    }
  }
}

}  // namespace vigil
