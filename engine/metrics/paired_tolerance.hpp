/// Does one series stay within a tolerance of another?
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace vigil {

/// At tick k the other may lie anywhere between the least x - m and the greatest x + m of the base's values x within
/// `shift` ticks of k, m = max(abs, rel |x|): the band that a small delay and a small error together allow.
struct Tolerance {
  double abs = 0;          ///< in the signal's unit
  double rel = 0;          ///< of the base's size
  std::int64_t shift = 0;  ///< ticks
};

struct ToleranceVerdict {
  struct Stretch {
    std::int64_t first = 0, last = 0;  ///< ticks, both included
  };
  std::int64_t ticks = 0;   ///< judged
  std::int64_t inside = 0;  ///< of those
  std::int64_t first = -1;  ///< tick that is the first outside; no meaning where none is
  /// Greatest distance from the base at the same tick, NaN where no tick has both; and its tick.
  double worst = std::numeric_limits<double>::quiet_NaN();
  std::int64_t worst_at = 0;
  std::vector<Stretch> outside;  ///< ticks in a row that are outside
  bool holds() const { return inside == ticks; }
};

/// k: ticks, rising; base and other: a value each, NaN where missing. Missing is inside where the base is missing, too,
/// within `shift` ticks; a number where the base has none within `shift` ticks is outside.
ToleranceVerdict judge_tolerance(std::span<const std::int64_t> k, std::span<const double> base,
                                 std::span<const double> other, const Tolerance& tolerance);

/// For truth values and categories: the other must be equal to a value of the base within `shift` ticks.
ToleranceVerdict judge_equal(std::span<const std::int64_t> k, std::span<const double> base,
                             std::span<const double> other, std::int64_t shift);

}  // namespace vigil
