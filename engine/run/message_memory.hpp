/// What the nodes of a lane said, tick by tick: what an adversary can play back on links.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/adversary/attack.hpp"

namespace vigil {

class MessageMemory {
 public:
  MessageMemory() = default;
  /// ticks: how far it reaches back.
  MessageMemory(Eigen::Index message, Eigen::Index nodes, std::size_t links, std::int64_t ticks);

  /// messages: message size x nodes, of tick k.
  void note(std::int64_t k, const Eigen::MatrixXd& messages);
  /// What is played at tick k on a link whose sender is `from`; null where the record has nothing there. The record is
  /// copied at its first tick, so that it may be played for longer than the memory reaches.
  const double* play(std::int64_t k, std::size_t link, int from, const Playback& playback);

 private:
  struct Record {
    Eigen::MatrixXd values;  ///< message size x ticks
    std::int64_t from = -1, to = -1;
  };
  Eigen::Index message_ = 0;
  std::int64_t length_ = 1, newest_ = -1, oldest_ = -1;
  Eigen::MatrixXd ring_;  ///< message size * nodes x ticks
  std::vector<Record> records_;
};

}  // namespace vigil
