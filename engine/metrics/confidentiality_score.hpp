/// What a fusion lane is worth to its user and to those who listen: mean squared errors over the whole state, and the
/// confidentiality index. Seed 004, (4-10); specification (privacy), section 1.7.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/run.hpp"

namespace vigil {

/// A log-ratio that a campaign pools: log2 of the mean of `above` over the mean of `below`, over trials.
struct RatioRecord {
  std::string lane, name, variant;
  double above = 0, below = 0;
};

/// The squared errors of one estimate, tick by tick.
class SquareTally {
 public:
  /// last: the run's last tick; late ticks are its last fifth, where it has no end all from tick 1 on.
  explicit SquareTally(std::optional<std::int64_t> last = std::nullopt);
  /// NaN: there was no estimate; not counted.
  void add(std::int64_t k, double square);
  double now() const { return now_; }
  double late_mean() const;            ///< NaN where no late tick was counted
  double sum() const { return sum_; }  ///< from tick 1 on

 private:
  std::int64_t late_from_ = 1;
  double now_, late_ = 0, sum_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace vigil
