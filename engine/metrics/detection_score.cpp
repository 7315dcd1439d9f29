#include "engine/metrics/detection_score.hpp"

#include <algorithm>

namespace vigil {

DetectionScore::Counted DetectionScore::note(std::int64_t k, bool attacked, bool alarm, bool twin_alarm) {
  ++ticks_;
  right_ += alarm == attacked ? 1 : 0;
  if (!attacked) {
    run_ = 0;
    const bool in_tail = last_attacked_ >= 0 && k <= last_attacked_ + tail_;
    if (k < from_ || in_tail) return Counted::neither;
    ++quiet_;
    false_alarms_ += alarm ? 1 : 0;
    return Counted::clean;
  }
  if (first_attacked_ < 0) first_attacked_ = k;
  last_attacked_ = k;
  ++attacked_;
  hits_ += alarm ? 1 : 0;
  twin_hits_ += twin_alarm ? 1 : 0;
  if (alarm && first_hit_ < 0) first_hit_ = k;
  run_ = alarm ? run_ + 1 : 0;
  longest_ = std::max(longest_, run_);
  return Counted::attacked;
}

void DetectionScore::append_metrics(const std::string& lane, const std::string& node, bool twin,
                                    std::vector<MetricValue>& metrics) const {
  const auto add = [&](const char* name, double value) { metrics.push_back({lane, node, name, "", value, false}); };
  const auto share = [&](const char* name, std::int64_t part, std::int64_t whole) {
    if (whole > 0) add(name, static_cast<double>(part) / static_cast<double>(whole));
  };
  share("tpr", hits_, attacked_);
  share("fpr", false_alarms_, quiet_);
  share("accuracy", right_, ticks_);
  if (attacked_ == 0) return;
  add("event", hits_ > 0 ? 1 : 0);
  if (twin) add("event_without_attack", twin_hits_ > 0 ? 1 : 0);
  if (first_hit_ >= 0) add("delay", static_cast<double>(first_hit_ - first_attacked_));
  add("longest", static_cast<double>(longest_));
}

}  // namespace vigil
