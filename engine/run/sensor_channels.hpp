/// The sensor channels of one world: what the sensors sent, what arrived, and what an adversary remembers of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/adversary/attack.hpp"
#include "engine/methods/method.hpp"

namespace vigil {

class SensorChannels {
 public:
  static constexpr std::int64_t kMemory = 1024;  ///< ticks

  SensorChannels() = default;
  /// last: the run's last tick, if it has one; the memory is no longer than that.
  SensorChannels(const std::vector<std::shared_ptr<const Sensor>>& sensors, std::optional<std::int64_t> last);

  /// Carries what was sent at tick k to the receivers: a playback takes its place, injections are added, angles are
  /// wrapped after that. Where the record has a gap, the last good reading before it is played. No allocation but at
  /// the first tick of a playback.
  void carry(std::int64_t k, const Readings& sent, const SensorEffects& effects, Readings& arrived);

 private:
  struct Record {
    Eigen::VectorXd values;
    std::int64_t from = -1, to = -1;
  };
  struct Reading {
    std::shared_ptr<const Sensor> sensor;
    Eigen::MatrixXd memory;        ///< channels x ticks, a ring by tick
    Eigen::VectorXd good;          ///< the last finite value of each channel
    std::vector<Record> playback;  ///< of each channel: the one played last
  };
  void remember(std::int64_t k, const Eigen::VectorXd& sent, Reading& reading) const;
  double play(std::int64_t k, const Playback& playback, Eigen::Index channel, Reading& reading) const;

  std::vector<Reading> readings_;  ///< one a node
  std::int64_t length_ = 1;
};

}  // namespace vigil
