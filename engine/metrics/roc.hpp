/// What a detector would have said at other thresholds: counts of its statistic over attacked and clean ticks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/bytes.hpp"

namespace vigil {

/// One point of a detection curve: the rates of an alarm at every tick whose value is at least `at`.
struct RocPoint {
  double at = 0;  ///< a threshold in the statistic's unit, or a factor of the detector's own
  double fpr = 0, tpr = 0;
};

/// From "never" (0, 0) to "always" (1, 1); between them the edges of bins at which a rate changes, falling in `at`.
struct RocCurve {
  std::vector<RocPoint> points;  ///< the first has at = infinity, the last at = 0
  double area = 0;               ///< by trapezoids; NaN where attacked or clean ticks are missing
};

/// Sums over ticks and trials; whole numbers, so that merging is exact in any order. Bins are sixteen to an octave,
/// from 2^-20 to 2^20, with one below (zero, negative, none in this tick) and one above; a statistic exactly at the
/// detector's threshold counts as above it here, though it raises no alarm.
class RocCounts {
 public:
  static constexpr int kPerOctave = 16, kOctaves = 20;
  static constexpr int kBins = 2 * kOctaves * kPerOctave + 2;

  /// statistic, threshold: NaN where there is none in this tick: no threshold would raise an alarm.
  void note(bool attacked, double statistic, double threshold, bool alarm);
  void merge(const RocCounts& other);
  bool empty() const { return ticks_[0] + ticks_[1] == 0; }

  RocCurve by_threshold() const { return curve(statistic_); }
  /// Every threshold times a factor; the detector as it is stands at 1.
  RocCurve by_factor() const { return curve(ratio_); }
  std::int64_t ticks(bool attacked) const { return ticks_[attacked ? 1 : 0]; }
  /// The detector's own alarms.
  std::int64_t alarms(bool attacked) const { return alarms_[attacked ? 1 : 0]; }

  void save(ByteWriter& out) const;
  void load(ByteReader& in);

 private:
  using Bins = std::array<std::vector<std::int64_t>, 2>;  ///< clean, attacked; empty before the first tick
  static void count(Bins& bins, bool attacked, double value);
  RocCurve curve(const Bins& bins) const;

  std::array<std::int64_t, 2> ticks_{}, alarms_{};  ///< clean, attacked
  Bins statistic_, ratio_;
};

}  // namespace vigil
