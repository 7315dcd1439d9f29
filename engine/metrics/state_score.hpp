/// How far an estimate is off, component by component. Specification of seed 003, section 7.4: rmse_state and
/// peak_error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/run/run.hpp"
#include "engine/world/plant.hpp"

namespace vigil {

/// Sums over the ticks from `from` on. A value: copies are forks.
class StateScore {
 public:
  StateScore() = default;
  StateScore(const Plant& plant, std::int64_t from) : from_(from), state_(plant.state()), squares_(state_.size()) {}

  /// estimate: states; the truth may have NaN.
  void note(std::int64_t k, const Eigen::VectorXd& truth, const double* estimate);
  /// rmse_state<suffix> (root of the mean square over ticks and components; and of each component, as variant) and
  /// peak_error<suffix> (largest component).
  void append_metrics(const std::string& lane, const std::string& suffix, std::vector<MetricValue>& metrics) const;

 private:
  std::int64_t from_ = 1, count_ = 0;
  std::vector<Component> state_;
  std::vector<double> squares_;
  double peak_ = 0;
};

}  // namespace vigil
