/// The specification's network of seed 001 driven by hand: what its nodes know, and readings of a target on its way.
#pragma once

#include "tests/engine/methods/sparse/windows.hpp"

namespace vigil::target {

inline Knowledge known(const Json& patch = Json::object()) {
  const Scenario scenario = Scenario::preset("sparse").patched(patch);
  Knowledge knowledge = rig::knowledge_of(scenario);
  const Eigen::VectorXd start = Params(scenario.document()["initial"]).vector("truth");
  knowledge.estimates = start.replicate(1, knowledge.estimates.cols());
  return knowledge;
}

/// A world of its own: process noise as known, readings of every node.
class Target {
 public:
  explicit Target(const Knowledge& knowledge, std::uint64_t seed = 1)
      : known_(knowledge), seed_(seed), x_(knowledge.estimates.col(0)) {}

  /// The readings of the next tick; nodes of `attacked` get range and azimuth of type I.
  Readings next(const std::vector<int>& attacked = {}) {
    Eigen::VectorXd ahead(x_.size());
    known_.plant->advance(x_, Eigen::VectorXd(), ahead);
    x_ = ahead + symmetric_root(known_.Q) * windows::normals(seed_, "plant", ++k_, static_cast<int>(x_.size()));
    Readings readings = rig::readings_at(known_, x_, seed_, k_);
    const Draws lie(seed_, "lie");
    for (const int i : attacked) {
      auto& y = readings[static_cast<std::size_t>(i)];
      y[0] += 10 * lie.uniform(k_, static_cast<std::uint32_t>(2 * i)) - 5;
      y[1] = windows::turned(y[1] + 6.28 * lie.uniform(k_, static_cast<std::uint32_t>(2 * i + 1)));
    }
    return readings;
  }
  std::int64_t tick() const { return k_; }
  const Eigen::VectorXd& truth() const { return x_; }

 private:
  const Knowledge& known_;
  std::uint64_t seed_;
  std::int64_t k_ = 0;
  Eigen::VectorXd x_;
};

inline std::unique_ptr<Method> method(const char* id, const Knowledge& known, const Json& params = Json::object()) {
  return Registry<MethodMake>::find(id)->make(rig::completed(id, params), known);
}

}  // namespace vigil::target
