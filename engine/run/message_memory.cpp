#include "engine/run/message_memory.hpp"

#include <cmath>
#include <limits>

namespace vigil {

MessageMemory::MessageMemory(Eigen::Index message, Eigen::Index nodes, std::size_t links, std::int64_t ticks)
    : message_(message), length_(ticks), ring_(Eigen::MatrixXd::Zero(message * nodes, ticks)), records_(links) {}

void MessageMemory::note(std::int64_t k, const Eigen::MatrixXd& messages) {
  if (oldest_ < 0) oldest_ = k;
  newest_ = k;
  ring_.col(k % length_) = messages.reshaped();
}

const double* MessageMemory::play(std::int64_t k, std::size_t link, int from, const Playback& playback) {
  Record& record = records_[link];
  if (record.from != playback.from || record.to != playback.to) {
    record.from = playback.from;
    record.to = playback.to;
    const std::int64_t ticks = playback.to - playback.from + 1;
    record.values = Eigen::MatrixXd::Constant(message_, ticks, std::numeric_limits<double>::quiet_NaN());
    for (std::int64_t tick = std::max(playback.from, oldest_); tick <= std::min(playback.to, newest_); ++tick) {
      if (tick < k && k - tick <= length_)
        record.values.col(tick - playback.from) = ring_.col(tick % length_).segment(from * message_, message_);
    }
  }
  const double* played = record.values.col(playback.source - playback.from).data();
  return std::isfinite(*played) ? played : nullptr;
}

}  // namespace vigil
