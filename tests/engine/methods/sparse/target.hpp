/// The specification's network of seed 001 driven by hand: what its nodes know, and readings of a target on its way.
#pragma once

#include "tests/engine/methods/sparse/windows.hpp"

namespace vigil::target {

Knowledge known(const Json& patch = Json::object());

/// A world of its own: process noise as known, readings of every node.
class Target {
 public:
  explicit Target(const Knowledge& knowledge, std::uint64_t seed = 1)
      : known_(knowledge), seed_(seed), x_(knowledge.estimates.col(0)) {}

  /// The readings of the next tick; nodes of `attacked` get range and azimuth of type I.
  Readings next(const std::vector<int>& attacked = {});
  std::int64_t tick() const { return k_; }
  const Eigen::VectorXd& truth() const { return x_; }

 private:
  const Knowledge& known_;
  std::uint64_t seed_;
  std::int64_t k_ = 0;
  Eigen::VectorXd x_;
};

std::unique_ptr<Method> method(const char* id, const Knowledge& known, const Json& params = Json::object());

}  // namespace vigil::target
