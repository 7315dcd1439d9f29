/// How far two sequences lie apart on average, pair by pair, and how sure that is.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace vigil {

/// Of the differences b - a. What there is too little for is NaN.
struct PairedDifference {
  std::int64_t n = 0;  ///< pairs in which both are finite
  double mean = std::numeric_limits<double>::quiet_NaN();
  double se = std::numeric_limits<double>::quiet_NaN();  ///< standard error of the mean
  double lo = std::numeric_limits<double>::quiet_NaN();  ///< 95 % confidence interval of the mean, Student's t
  double hi = std::numeric_limits<double>::quiet_NaN();
  double p = std::numeric_limits<double>::quiet_NaN();  ///< Wilcoxon's signed-rank test, two-sided
  int batches = 0;                                      ///< batch means that se, lo, hi and p rest on; 0: the pairs
  /// Correlation of neighbouring batch means. Beyond 2 / sqrt(batches) the batches are too short to count as
  /// independent, and the interval is narrower than it should be.
  double lag1 = std::numeric_limits<double>::quiet_NaN();
};

/// Pairs that are independent of one another (runs of different seeds). se and the interval need two pairs.
PairedDifference paired_difference(std::span<const double> a, std::span<const double> b);

/// Neighbouring ticks of one run, which are not independent: the differences are cut into 10 to 20 batches of
/// consecutive pairs, equal but for one, and their means count as independent (non-overlapping batch means; Schmeiser,
/// Batch size effects in the analysis of simulation output, 1982). Fewer than 20 pairs give a mean only.
PairedDifference paired_in_time(std::span<const double> a, std::span<const double> b);

}  // namespace vigil
