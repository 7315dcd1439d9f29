#include "engine/run/sensor_channels.hpp"

#include <cmath>
#include <limits>

namespace vigil {
namespace {
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
}

SensorChannels::SensorChannels(const std::vector<std::shared_ptr<const Sensor>>& sensors,
                               std::optional<std::int64_t> last)
    : length_(last ? std::min(*last + 1, kMemory + 1) : kMemory + 1) {
  for (const auto& sensor : sensors) {
    Channel channel;
    channel.sensor = sensor;
    channel.memory = Eigen::MatrixXd::Constant(sensor->size(), length_, kMissing);
    channel.good = Eigen::VectorXd::Constant(sensor->size(), kMissing);
    channels_.push_back(std::move(channel));
  }
}

void SensorChannels::remember(std::int64_t k, const Eigen::VectorXd& sent, Channel& channel) const {
  for (Eigen::Index c = 0; c < sent.size(); ++c) {
    if (std::isfinite(sent[c])) channel.good[c] = sent[c];
  }
  channel.memory.col(k % length_) = channel.good;
}

void SensorChannels::play(std::int64_t k, const Playback& playback, Channel& channel, Eigen::VectorXd& arrived) const {
  const bool goes_on =
      channel.played == k - 1 && channel.record_from == playback.from && channel.record_to == playback.to;
  if (!goes_on) {  // the memory is a ring: what is played for long must be kept apart
    channel.record_from = playback.from;
    channel.record_to = playback.to;
    channel.record = Eigen::MatrixXd::Constant(arrived.size(), playback.to - playback.from + 1, kMissing);
    for (std::int64_t tick = playback.from; tick <= playback.to; ++tick) {
      if (tick >= 0 && tick < k && k - tick < length_)
        channel.record.col(tick - playback.from) = channel.memory.col(tick % length_);
    }
  }
  channel.played = k;
  const auto column = channel.record.col(playback.source - playback.from);
  for (Eigen::Index c = 0; c < arrived.size(); ++c) {
    if (playback.channel < 0 || playback.channel == c) arrived[c] = column[c];
  }
}

void SensorChannels::carry(std::int64_t k, const Readings& sent, const SensorEffects& effects, Readings& arrived) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    remember(k, sent[i], channels_[i]);
    arrived[i] = sent[i];
    if (effects.state[i] == SensorState::clean) continue;
    if (effects.playback[i].source >= 0) play(k, effects.playback[i], channels_[i], arrived[i]);
    for (Eigen::Index c = 0; c < arrived[i].size(); ++c) {
      const double period = channels_[i].sensor->channels()[static_cast<std::size_t>(c)].period;
      if (effects.injected[i][c] != 0) arrived[i][c] = wrap(arrived[i][c] + effects.injected[i][c], period);
    }
  }
}

}  // namespace vigil
