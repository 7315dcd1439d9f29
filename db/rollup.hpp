/// Extremes and means of buckets of rows, from which windows at any zoom are drawn.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace vigil {

/// Rows in a bucket of each level.
inline constexpr std::array<std::int64_t, 3> kRollupRows = {512, 8192, 131072};

/// Of some rows of one signal. lo and hi are NaN while n is 0.
struct Summary {
  double lo = std::numeric_limits<double>::quiet_NaN();
  double hi = std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  std::int64_t n = 0;    ///< numbers
  std::int64_t nan = 0;  ///< rows without a number

  void add(double value) {
    if (std::isnan(value)) {
      ++nan;
      return;
    }
    lo = n == 0 || value < lo ? value : lo;
    hi = n == 0 || value > hi ? value : hi;
    sum += value;
    ++n;
  }
  void merge(const Summary& other) {
    if (other.n > 0) {
      lo = n == 0 || other.lo < lo ? other.lo : lo;
      hi = n == 0 || other.hi > hi ? other.hi : hi;
    }
    sum += other.sum;
    n += other.n;
    nan += other.nan;
  }
  double mean() const { return n > 0 ? sum / static_cast<double>(n) : std::numeric_limits<double>::quiet_NaN(); }
};

struct RollupRow {
  int signal = 0;
  int level = 0;
  std::int64_t bucket = 0;
  Summary summary;
};

}  // namespace vigil
