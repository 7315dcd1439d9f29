#include "engine/methods/privacy/published_mean.hpp"

#include <algorithm>

namespace vigil::privacy {

using Eigen::MatrixXd;

const Eigen::VectorXd& PublishedMean::add(const Eigen::VectorXd& fused) {
  const auto kappa = past_.cols();
  past_.col(static_cast<Eigen::Index>(count_ % kappa)) = fused;
  ++count_;
  const auto there = static_cast<Eigen::Index>(std::min<std::int64_t>(count_, kappa));
  mean_ = past_.leftCols(there).rowwise().mean();
  return mean_;
}

MeanTrace::MeanTrace(const FusionModel& model, const StationaryFilters& filters, const Fusion& nominal, int kappa)
    : states_(model.states()), kappa_(kappa) {
  const int n = model.states(), all = n + model.stacked();
  std::vector<MatrixXd> noise, F;
  for (std::size_t i = 0; i < filters.gains.size(); ++i) {
    const LocalGains& gains = filters.gains[i];
    F.push_back(gains.F);
    noise.push_back(gains.K * model.sensors[i].R * gains.K.transpose());
  }
  const MatrixXd enters = column_of({MatrixXd::Identity(n, n), column_of(F)});  // of the process noise
  driven_ = enters * model.noise() * enters.transpose();
  driven_.bottomRightCorner(all - n, all - n) += block_diagonal(noise);
  M_ = block_diagonal({model.A, block_diagonal(filters.Psi)});
  fused_.resize(n, all);
  fused_ << MatrixXd::Identity(n, n), -nominal.W;

  law_ = ahead_ = MatrixXd::Zero(all, all);
  law_.bottomRightCorner(all - n, all - n) = filters.P;
  if (const auto S = state_covariance(model)) {
    law_.topLeftCorner(n, n) = *S;
    for (int at = 0; at < all - n; at += n) {
      law_.block(n + at, 0, n, n) = filters.P.block(at, at, n, n);
      law_.block(0, n + at, n, n) = filters.P.block(at, at, n, n);
    }
  } else {
    law_.topLeftCorner(n, n) = model.x0 * model.x0.transpose();
  }
  with_.assign(static_cast<std::size_t>(kappa), MatrixXd::Zero(all, n));
  pairs_ = MatrixXd::Zero(kappa, kappa);
}

double MeanTrace::sum_over_window() const {
  const auto there = std::min<std::int64_t>(t_ + 1, kappa_);
  double sum = 0;
  for (std::int64_t back = 0; back < there; ++back) {  // the estimate of t - back with all before it
    const auto row = static_cast<Eigen::Index>((t_ - back) % kappa_);
    sum += pairs_(row, 0) + 2 * pairs_.row(row).segment(1, static_cast<Eigen::Index>(there - back - 1)).sum();
  }
  return sum;
}

double MeanTrace::step() {
  ++t_;
  if (t_ > 0) {
    ahead_.noalias() = M_ * law_;
    law_.noalias() = ahead_ * M_.transpose();
    law_ += driven_;
    for (std::size_t k = with_.size() - 1; k > 0; --k) with_[k].noalias() = M_ * with_[k - 1];
  }
  with_.front().noalias() = law_ * fused_.transpose();
  const auto there = static_cast<Eigen::Index>(std::min<std::int64_t>(t_ + 1, kappa_));
  const auto row = static_cast<Eigen::Index>(t_ % kappa_);
  double with_state = 0;
  for (Eigen::Index k = 0; k < there; ++k) {
    const MatrixXd& with = with_[static_cast<std::size_t>(k)];
    pairs_(row, k) = fused_.cwiseProduct(with.transpose()).sum();
    with_state += with.topRows(states_).trace();
  }
  const auto count = static_cast<double>(there);
  return law_.topLeftCorner(states_, states_).trace() - 2 * with_state / count + sum_over_window() / (count * count);
}

}  // namespace vigil::privacy
