/// The sensor channels of one world: what the sensors sent, what arrived, and what an adversary remembers of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/adversary/attack.hpp"
#include "engine/methods/method.hpp"
#include "engine/run/insider.hpp"

namespace vigil {

class SensorChannels {
 public:
  static constexpr std::int64_t kMemory = 1024;  ///< ticks

  SensorChannels() = default;
  /// last: the run's last tick, if it has one; the memory is no longer than that.
  SensorChannels(const std::vector<std::shared_ptr<const Sensor>>& sensors, std::optional<std::int64_t> last);

  /// Carries what the course's sensors sent at tick k to the receivers: a playback takes its place, injections are
  /// added, angles are wrapped after that; then an insider shapes it; what is jammed is missing. Where the record has a
  /// gap, the last good reading before it is played. Writes course.received and course.injected. No allocation but at
  /// the first tick of a playback or of an insider.
  void carry(std::int64_t k, const World& world, const SensorEffects& effects, Course& course);

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

  void tamper(std::int64_t k, const SensorEffects& effects, std::size_t node, Eigen::VectorXd& arrived);

  std::vector<Reading> readings_;  ///< one a node
  Insider insider_;
  std::int64_t length_ = 1;
};

}  // namespace vigil
