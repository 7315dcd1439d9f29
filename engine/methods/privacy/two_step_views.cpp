#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/linalg/covariance.hpp"
#include "engine/methods/privacy/gaussian_mechanism.hpp"
#include "engine/methods/privacy/two_step.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

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

/// The joint covariance of the noises of so many messages in a row: they share terms of their windows.
Eigen::SparseMatrix<double> stream_noise(const MatrixXd& first, const MatrixXd& second, int window, int messages) {
  const auto n = static_cast<int>(first.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0; t < messages; ++t) {
    for (int u = std::max(0, t - window + 1); u < std::min(messages, t + window); ++u) {
      MatrixXd block = (window - std::abs(t - u)) * first;
      if (t == u) block += second;
      for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) entries.emplace_back(t * n + r, u * n + c, block(r, c));
      }
    }
  }
  Eigen::SparseMatrix<double> S(messages * n, messages * n);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

}  // namespace

TwoStepViews two_step_views(const TwoStep& design, const TwoStepSettings& settings, std::size_t sensor) {
  const auto n = static_cast<int>(design.nominal.P.rows());
  const auto at = static_cast<Eigen::Index>(sensor) * n;
  const MatrixXd first = design.q_xi[sensor] * design.Rg[sensor] * design.Rg[sensor].transpose();
  const MatrixXd second = settings.q_alpha * design.Pi.block(at, at, n, n);
  const auto moved = shifts(design.filters.Psi[sensor], design.V[sensor], settings.window, kMemory);
  const auto loss = [&](const MatrixXd& D, const MatrixXd& S) { return PrivacyLoss(D, S, settings.zeta); };

  const PrivacyLoss single = loss(moved.front(), design.Qphi[sensor]);
  TwoStepViews views{.single = single,
                     .single_worst = single,
                     .difference = loss(moved.front(), 2 * first + 2 * second),
                     .prefix = single,
                     .stream = single};
  const double reach = settings.zeta / std::sqrt(std::max(least_eigenvalue(design.Qphi[sensor]), 0.0));
  for (std::size_t k = 1; k < moved.size(); ++k) {
    if (moved[k].norm() * reach <= views.single_worst.mu()) continue;  // too small a shift whatever its direction
    const PrivacyLoss lagged = loss(moved[k], design.Qphi[sensor]);
    if (!(lagged.mu() > views.single_worst.mu() * (1 + 1e-9))) continue;
    views.single_worst = lagged;
    views.worst_lag = static_cast<int>(k);
  }

  const int around = TwoStepViews::kAround, messages = 2 * around + 1;
  MatrixXd D = MatrixXd::Zero(messages * n, n);
  for (int t = around; t < messages; ++t) D.middleRows(t * n, n) = moved[static_cast<std::size_t>(t - around)];
  const auto until = (around + 1) * n;
  views.prefix =
      PrivacyLoss::banded(D.topRows(until), stream_noise(first, second, settings.window, around + 1), settings.zeta);
  views.stream = PrivacyLoss::banded(D, stream_noise(first, second, settings.window, messages), settings.zeta);
  return views;
}

}  // namespace vigil::privacy
