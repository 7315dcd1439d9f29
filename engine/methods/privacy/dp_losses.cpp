#include "engine/methods/privacy/dp_losses.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kForgotten = 1e-10;  // of the largest shift; what is smaller is no longer waited for

/// How a difference at one time, or at all times, moves the stacked estimates.
class Shifts {
 public:
  Shifts(const DpFusion& design, const DpSettings& settings) : design_(design), kappa_(settings.kappa) {
    const MatrixXd Psi = block_diagonal(design.filters.Psi), first = column_of(design.KCH);
    double largest = first.norm();
    lags_.push_back(first);
    for (int k = 1; k < kMemory; ++k) {
      MatrixXd next = Psi * lags_.back();
      largest = std::max(largest, next.norm());
      if (next.norm() <= kForgotten * largest) break;
      lags_.push_back(std::move(next));
    }
    lasting_ = (MatrixXd::Identity(Psi.rows(), Psi.cols()) - Psi).partialPivLu().solve(first);
  }

  int memory() const { return static_cast<int>(lags_.size()); }
  MatrixXd fused(int k) const { return design_.nominal.W * lag(k); }
  /// Of the published mean, k ticks after the difference.
  MatrixXd mean(int k) const {
    MatrixXd sum = MatrixXd::Zero(lags_.front().rows(), lags_.front().cols());
    for (int j = std::max(0, k - kappa_ + 1); j <= k; ++j) sum += lag(j);
    return design_.nominal.W * sum / kappa_;
  }
  MatrixXd sustained() const { return design_.nominal.W * lasting_; }
  /// Of the packets, each times its W_i, so that its noise is xi_i.
  MatrixXd packets(int k) const {
    const auto n = design_.nominal.W.rows();
    MatrixXd shift = lag(k);
    for (Eigen::Index at = 0; at < shift.rows(); at += n)
      shift.middleRows(at, n) = (design_.nominal.W.middleCols(at, n) * shift.middleRows(at, n)).eval();
    return shift;
  }

 private:
  MatrixXd lag(int k) const {
    return k < memory() ? lags_[static_cast<std::size_t>(k)]
                        : MatrixXd::Zero(lags_.front().rows(), lags_.front().cols());
  }
  const DpFusion& design_;
  int kappa_;
  std::vector<MatrixXd> lags_;
  MatrixXd lasting_;
};

template <class Shift>
MatrixXd in_a_row(int count, const Shift& shift) {
  std::vector<MatrixXd> blocks;
  for (int k = 0; k < count; ++k) blocks.push_back(shift(k));
  return column_of(blocks);
}

PrivacyLoss alike(const MatrixXd& D, double q, double bound) {
  return PrivacyLoss::white(D, VectorXd::Constant(D.rows(), q), bound);
}

/// Weights of the fused noise (n) made those of xi, which sum up to it.
LossView at_the_sensors(LossView view, int sensors) {
  view.weights = view.weights.replicate(sensors, 1).eval();
  return view;
}

}  // namespace

std::vector<LossView> dp_sensor_losses(const DpFusion& design, const DpSettings& settings) {
  const Shifts shifts(design, settings);
  const auto n = static_cast<int>(design.nominal.W.rows()), L = static_cast<int>(design.q.size());
  const int kappa = settings.kappa, memory = shifts.memory();
  const double q = design.q_total, bound = settings.lambda;
  std::vector<LossView> views;
  const auto add = [&](const char* name, const MatrixXd& D, double variance) -> LossView& {
    views.push_back(at_the_sensors(view_of(alike(D, variance, bound), name, L, n, 0, n), L));
    return views.back();
  };
  const auto over_the_window = [&](LossView& view) { view.weights = view.weights.replicate(1, kappa).eval() / kappa; };
  over_the_window(add("mean", shifts.mean(0), q / kappa));
  over_the_window(add("mean_worst", shifts.mean(dp_views(design, settings).worst_lag), q / kappa));
  LossView& difference = add("mean_difference", shifts.mean(0), 2 * q / (kappa * kappa));
  const MatrixXd weights = difference.weights / kappa;  // of the newest fused estimate less the one that leaves
  difference.weights = MatrixXd::Zero(n * L, kappa + 1);
  difference.weights.col(0) = weights;
  difference.weights.col(kappa) = -weights;
  add("instant", shifts.fused(0), q);
  add("fused_stream", in_a_row(memory, [&](int k) { return shifts.fused(k); }), q);
  over_the_window(add("sustained", shifts.sustained(), q / kappa));

  VectorXd variances(n * L);
  for (int i = 0; i < L; ++i) variances.segment(i * n, n).setConstant(design.q[static_cast<std::size_t>(i)]);
  const auto packets = [&](const char* name, int count) {
    const MatrixXd D = in_a_row(count, [&](int k) { return shifts.packets(k); });
    views.push_back(view_of(PrivacyLoss::white(D, variances.replicate(count, 1), bound), name, L, n * L, 0, n * L));
  };
  packets("packets", 1);
  packets("packet_stream", memory);
  for (LossView& view : views) view.first = view.weights.cols() - 1;
  return views;
}

std::vector<LossView> dp_centre_losses(const DpFusion& design, const DpSettings& settings, double q) {
  const Shifts shifts(design, settings);
  const auto n = static_cast<int>(design.nominal.W.rows()), L = static_cast<int>(design.q.size());
  std::vector<LossView> views;
  const auto add = [&](const char* name, const MatrixXd& D, double variance) -> LossView& {
    views.push_back(view_of(alike(D, variance, settings.lambda), name, L, n, 0, n));
    return views.back();
  };
  const int worst = dp_views(design, settings).worst_lag, memory = shifts.memory() + settings.kappa - 1;
  add("mean", shifts.mean(0), q);
  add("mean_worst", shifts.mean(worst), q);
  LossView& difference = add("mean_difference", shifts.mean(0), 2 * q);
  difference.weights.conservativeResize(Eigen::NoChange, 2);
  difference.weights.col(1) = -difference.weights.col(0);
  add("mean_stream", in_a_row(memory, [&](int k) { return shifts.mean(k); }), q);
  add("sustained", shifts.sustained(), q);
  for (LossView& view : views) view.first = settings.kappa - 1 + view.weights.cols() - 1;
  for (const auto& [name, count] : {std::pair{"packets", 1}, std::pair{"packet_stream", shifts.memory()}}) {
    const MatrixXd D = in_a_row(count, [&](int k) { return shifts.packets(k); });
    views.push_back(
        {.name = name, .output = L, .mu = alike(D, 0, settings.lambda).mu(), .weights = {}, .shift = {}, .first = 0});
    if (views.back().mu == 0) views.back().weights = MatrixXd::Zero(n, 1);
  }
  return views;
}

}  // namespace vigil::privacy
