#include "engine/metrics/state_score.hpp"

#include <algorithm>
#include <cmath>

namespace vigil {

void StateScore::note(std::int64_t k, const Eigen::VectorXd& truth, const double* estimate) {
  if (k < from_ || !truth.allFinite()) return;
  ++count_;
  for (std::size_t c = 0; c < state_.size(); ++c) {
    const double e = wrap(estimate[c] - truth[static_cast<Eigen::Index>(c)], state_[c].period);
    squares_[c] += e * e;
    peak_ = std::max(peak_, std::abs(e));
  }
}

void StateScore::append_metrics(const std::string& lane, const std::string& suffix,
                                std::vector<MetricValue>& metrics) const {
  if (count_ == 0) return;
  const auto n = static_cast<double>(count_);
  double all = 0;
  for (const double square : squares_) all += square;
  metrics.push_back(
      {lane, "", "rmse_state" + suffix, "", std::sqrt(all / n / static_cast<double>(state_.size())), false});
  for (std::size_t c = 0; c < state_.size(); ++c)
    metrics.push_back({lane, "", "rmse_state" + suffix, state_[c].name, std::sqrt(squares_[c] / n), false});
  metrics.push_back({lane, "", "peak_error" + suffix, "", peak_, false});
}

}  // namespace vigil
