#include "engine/run/sensor_channels.hpp"

#include <cmath>

#include "engine/core/missing.hpp"

namespace vigil {
SensorChannels::SensorChannels(const std::vector<std::shared_ptr<const Sensor>>& sensors,
                               std::optional<std::int64_t> last)
    : length_(last ? std::min(*last + 1, kMemory + 1) : kMemory + 1) {
  for (const auto& sensor : sensors) {
    Reading reading;
    reading.sensor = sensor;
    reading.memory = Eigen::MatrixXd::Constant(sensor->size(), length_, kMissing);
    reading.good = Eigen::VectorXd::Constant(sensor->size(), kMissing);
    reading.playback.resize(static_cast<std::size_t>(sensor->size()));
    readings_.push_back(std::move(reading));
  }
}

void SensorChannels::remember(std::int64_t k, const Eigen::VectorXd& sent, Reading& reading) const {
  for (Eigen::Index c = 0; c < sent.size(); ++c) {
    if (std::isfinite(sent[c])) reading.good[c] = sent[c];
  }
  reading.memory.col(k % length_) = reading.good;
}

double SensorChannels::play(std::int64_t k, const Playback& playback, Eigen::Index channel, Reading& reading) const {
  Record& record = reading.playback[static_cast<std::size_t>(channel)];
  if (record.from != playback.from || record.to != playback.to) {  // kept apart: the memory is a ring
    record.from = playback.from;
    record.to = playback.to;
    record.values = Eigen::VectorXd::Constant(playback.to - playback.from + 1, kMissing);
    for (std::int64_t tick = playback.from; tick <= playback.to; ++tick) {
      if (tick >= 0 && tick < k && k - tick < length_)
        record.values[tick - playback.from] = reading.memory(channel, tick % length_);
    }
  }
  return record.values[playback.source - playback.from];
}

void SensorChannels::tamper(std::int64_t k, const SensorEffects& effects, std::size_t node, Eigen::VectorXd& arrived) {
  for (Eigen::Index c = 0; c < arrived.size(); ++c) {
    const auto channel = static_cast<std::size_t>(c);
    const Playback& playback = effects.playback[node][channel];
    if (playback.source >= 0) arrived[c] = play(k, playback, c, readings_[node]);
    const double period = readings_[node].sensor->channels()[channel].period;
    if (effects.injected[node][c] != 0) arrived[c] = wrap(arrived[c] + effects.injected[node][c], period);
  }
}

void SensorChannels::carry(std::int64_t k, const World& world, const SensorEffects& effects, Course& course) {
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    remember(k, course.sent[i], readings_[i]);
    Eigen::VectorXd& arrived = course.received[i];
    arrived = course.sent[i];
    course.injected[i] = effects.injected[i];
    if (effects.state[i] == SensorState::clean) continue;
    tamper(k, effects, i, arrived);
    const Shaping& shaping = effects.shaping[i];
    if (shaping.moved != nullptr || shaping.direction != nullptr) {
      course.injected[i] -= arrived;
      insider_.shape(k, world, course, static_cast<int>(i), shaping, arrived);
      course.injected[i] += arrived;
    }
    for (std::size_t c = 0; c < effects.lost[i].size(); ++c) {
      if (effects.lost[i][c] == 0) continue;
      arrived[static_cast<Eigen::Index>(c)] = kMissing;
      course.injected[i][static_cast<Eigen::Index>(c)] = 0;
    }
  }
}

}  // namespace vigil
