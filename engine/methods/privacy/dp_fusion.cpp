#include "engine/methods/privacy/dp_fusion.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/gaussian_mechanism.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWorstCondition = 1e10;

void check(const FusionModel& model, const DpSettings& settings) {
  if (settings.kappa < 1)
    throw InputError("/kappa", fmt::format("kappa is {}; expected 1 or more", settings.kappa), "1 or more");
  if (!(settings.lambda >= 0) || !std::isfinite(settings.lambda))
    throw InputError("/lambda", fmt::format("lambda is {:g}; expected 0 or more", settings.lambda), "0 or more");
  if (settings.H.size() != model.states() || (settings.H.array() * (1 - settings.H.array()) != 0).any())
    throw InputError("/H", fmt::format("H must have {} entries, each 0 or 1", model.states()), "0 or 1");
  const auto& shares = settings.shares;
  if (shares.empty()) return;
  const bool fits = static_cast<int>(shares.size()) == model.count() &&
                    std::all_of(shares.begin(), shares.end(), [](double share) { return share >= 0; });
  if (!fits || !(std::abs(std::accumulate(shares.begin(), shares.end(), -1.0)) <= 1e-9))
    throw InputError("/shares", fmt::format("shares must be {} numbers, none negative, of sum 1", model.count()),
                     "sum 1");
}

double condition_of(const MatrixXd& W) {
  const Eigen::VectorXd singular = Eigen::JacobiSVD<MatrixXd>(W).singularValues();
  const double least = singular[singular.size() - 1];
  return least > 0 ? singular[0] / least : kInfinity;
}

/// G_i and what the sensors then send.
void spread_noise(DpFusion& design, const std::vector<double>& shares) {
  const auto n = design.nominal.P.rows();
  std::vector<MatrixXd> added;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const MatrixXd W = design.nominal.W.middleCols(static_cast<Eigen::Index>(i) * n, n);
    design.q.push_back(shares[i] * design.q_total);
    design.condition.push_back(condition_of(W));
    const bool noisy = design.q[i] > 0;
    if (noisy && !(design.condition[i] < kWorstCondition))
      throw InputError(fmt::format("/shares/{}", i),
                       fmt::format("the weights of sensor {} cannot be inverted (condition {:.3g}), so it cannot carry "
                                   "a share of the noise; give it 0",
                                   i + 1, design.condition[i]),
                       "0");
    design.G.push_back(noisy ? MatrixXd(W.inverse()) : MatrixXd::Zero(n, n));
    added.push_back(design.q[i] * design.G[i] * design.G[i].transpose());
  }
  design.Pc = design.filters.P + block_diagonal(added);
}

/// sqrt of the largest eigenvalue of a sum of M'M: the norm of all M stacked.
class StackedNorm {
 public:
  explicit StackedNorm(Eigen::Index n) : gram_(MatrixXd::Zero(n, n)) {}
  void add(const MatrixXd& M) { gram_ += M.transpose() * M; }
  double norm() const { return std::sqrt(spectral_norm(gram_)); }

 private:
  MatrixXd gram_;
};

/// || W sum of Psi^j KC H || over the lags of a window that ends `k` ticks after the difference, and its worst k.
void mean_views(const DpFusion& design, const DpSettings& settings, double root, DpViews& views) {
  const MatrixXd Psi = block_diagonal(design.filters.Psi), W = design.nominal.W;
  std::vector<MatrixXd> lags{column_of(design.KCH)};
  MatrixXd window = MatrixXd::Zero(lags.front().rows(), lags.front().cols());
  StackedNorm stream(window.cols());
  const auto kappa = static_cast<std::size_t>(settings.kappa);
  for (std::size_t k = 0; k < kMemory; ++k) {
    if (k > 0) lags.push_back(Psi * lags.back());
    window += lags[k];
    if (k >= kappa) window -= lags[k - kappa];
    stream.add(W * lags[k]);
    const double mu = settings.lambda * spectral_norm(W * window) / (root * std::sqrt(settings.kappa));
    if (k > 0 && !(mu > views.mean_worst * (1 + 1e-9))) continue;
    views.mean_worst = mu;
    views.worst_lag = static_cast<int>(k);
  }
  views.fused_stream = settings.lambda * stream.norm() / root;
}

/// Packets of one instant (memory 1) or of all from then on.
double packet_view(const DpFusion& design, const DpSettings& settings, int memory) {
  const auto n = design.nominal.P.rows();
  StackedNorm all(n);
  for (std::size_t i = 0; i < design.q.size(); ++i) {
    MatrixXd shift = design.KCH[i];
    if (settings.lambda * shift.norm() == 0) continue;
    if (!(design.q[i] > 0)) return kInfinity;
    const MatrixXd W = design.nominal.W.middleCols(static_cast<Eigen::Index>(i) * n, n);
    for (int k = 0; k < memory; ++k) {
      all.add(W * shift / std::sqrt(design.q[i]));
      shift = (design.filters.Psi[i] * shift).eval();
    }
  }
  return settings.lambda * all.norm();
}

}  // namespace

DpFusion design_dp_fusion(const FusionModel& model, const DpSettings& settings) {
  check(model, settings);
  DpFusion design;
  design.gamma = gamma_factor(settings.epsilon, settings.delta);
  auto filters = stationary_filters(model);
  if (!filters) throw InputError("", "a sensor's filter has no stationary law: the target is not detectable from it");
  design.filters = std::move(*filters);
  design.nominal = fuse(design.filters.P, model.states());
  for (const MatrixXd& KC : visible_gains(model, design.filters.gains))
    design.KCH.push_back(KC * settings.H.asDiagonal());
  design.sigma = spectral_norm(design.nominal.W * column_of(design.KCH));
  const double root = design.gamma * design.sigma * settings.lambda, kappa = settings.kappa;
  design.q_centre = root * root;
  design.q_centre_enough = design.q_centre / (kappa * kappa);
  design.q_total = design.q_centre / kappa;
  const auto count = static_cast<std::size_t>(model.count());
  const std::vector<double> alike(count, settings.at_centre ? 0 : 1.0 / model.count());
  spread_noise(design, settings.at_centre || settings.shares.empty() ? alike : settings.shares);
  design.compensated = fuse(design.Pc, model.states());
  design.public_P = design.nominal.P;
  design.public_P.diagonal().array() += design.q_total;
  return design;
}

DpViews dp_views(const DpFusion& design, const DpSettings& settings) {
  DpViews views;
  if (!(design.q_total > 0)) return views;  // nothing to hide
  const double root = std::sqrt(design.q_total);
  const double instant = settings.lambda * design.sigma / root;
  views.instant = instant;
  views.mean = instant / std::sqrt(settings.kappa);
  views.mean_difference = instant / std::sqrt(2.0);
  mean_views(design, settings, root, views);
  views.packets = packet_view(design, settings, 1);
  views.packet_stream = packet_view(design, settings, kMemory);
  const MatrixXd Psi = block_diagonal(design.filters.Psi);
  const MatrixXd lasting =
      (MatrixXd::Identity(Psi.rows(), Psi.cols()) - Psi).partialPivLu().solve(column_of(design.KCH));
  views.sustained = settings.lambda * spectral_norm(design.nominal.W * lasting) * std::sqrt(settings.kappa) / root;
  return views;
}

}  // namespace vigil::privacy
