#include <Eigen/Core>
#include <cstdlib>

#include "engine/methods/privacy/gaussian_mechanism.hpp"
#include "engine/methods/privacy/two_step.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr int kAround = 60;   // messages before and after the difference
constexpr int kMemory = 400;  // lags looked at for the worst one

/// The shift of s(t0 + k), k = 0 .. last: the filter's memory of the difference, summed over the window.
std::vector<MatrixXd> shifts(const MatrixXd& Psi, const MatrixXd& V, int window, int last) {
  std::vector<MatrixXd> lags, sums;
  MatrixXd lag = V, sum = MatrixXd::Zero(V.rows(), V.cols());
  for (int k = 0; k <= last; ++k) {
    sum += lag;
    if (k >= window) sum -= lags[static_cast<std::size_t>(k - window)];
    lags.push_back(lag);
    sums.push_back(sum);
    lag = (Psi * lag).eval();
  }
  return sums;
}

}  // namespace

TwoStepViews two_step_views(const TwoStep& design, const TwoStepSettings& settings, std::size_t sensor) {
  const auto n = design.nominal.P.rows();
  const auto at = static_cast<Eigen::Index>(sensor) * n;
  const MatrixXd first = design.q_xi[sensor] * design.Rg[sensor] * design.Rg[sensor].transpose();
  const MatrixXd second = settings.q_alpha * design.Pi.block(at, at, n, n);
  const auto moved = shifts(design.filters.Psi[sensor], design.V[sensor], settings.window, kMemory);
  const auto mu = [&](const MatrixXd& D, const MatrixXd& S) { return PrivacyLoss(D, S, settings.zeta).mu(); };

  TwoStepViews views;
  views.single = mu(moved.front(), design.Qphi[sensor]);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const double lagged = mu(moved[k], design.Qphi[sensor]);
    if (k > 0 && !(lagged > views.single_worst * (1 + 1e-9))) continue;
    views.single_worst = lagged;
    views.worst_lag = static_cast<int>(k);
  }
  views.difference = mu(moved.front(), 2 * first + 2 * second);

  const int messages = 2 * kAround + 1;
  MatrixXd S = MatrixXd::Zero(messages * n, messages * n), D = MatrixXd::Zero(messages * n, n);
  for (int t = 0; t < messages; ++t) {
    for (int u = 0; u < messages; ++u) {
      const int shared = settings.window - std::abs(t - u);
      if (shared > 0) S.block(t * n, u * n, n, n) = shared * first;
    }
    S.block(t * n, t * n, n, n) += second;
    if (t >= kAround) D.middleRows(t * n, n) = moved[static_cast<std::size_t>(t - kAround)];
  }
  views.stream = mu(D, S);
  const auto until = (kAround + 1) * n;
  views.prefix = mu(D.topRows(until), S.topLeftCorner(until, until));
  return views;
}

}  // namespace vigil::privacy
