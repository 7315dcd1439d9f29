/// What a detector is worth: rates over the ticks of an attack and outside it. Specification of seed 003, section 6.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/run/run.hpp"

namespace vigil {

/// Sums over one output's ticks. A value: copies are forks.
class DetectionScore {
 public:
  enum class Counted { neither, clean, attacked };  ///< which rate a tick counts in

  /// from: the first tick that may count as a false alarm. tail: ticks after an attack that count as neither.
  DetectionScore(std::int64_t from, int tail) : from_(from), tail_(tail) {}

  /// attacked: the readings of tick k were. twin_alarm: of the same lane on the same draws without any attack.
  Counted note(std::int64_t k, bool attacked, bool alarm, bool twin_alarm);

  /// fpr, accuracy, and where there was an attack tpr, event, event_without_attack (if `twin`), delay (if any),
  /// longest.
  void append_metrics(const std::string& lane, const std::string& node, bool twin,
                      std::vector<MetricValue>& metrics) const;

 private:
  std::int64_t from_;
  int tail_;
  std::int64_t ticks_ = 0, right_ = 0;
  std::int64_t attacked_ = 0, hits_ = 0, twin_hits_ = 0;
  std::int64_t quiet_ = 0, false_alarms_ = 0;
  std::int64_t first_attacked_ = -1, last_attacked_ = -1, first_hit_ = -1;
  std::int64_t run_ = 0, longest_ = 0;
};

}  // namespace vigil
