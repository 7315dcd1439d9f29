#include "engine/methods/privacy/two_step.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/input_error.hpp"
#include "engine/linalg/covariance.hpp"
#include "engine/methods/privacy/gaussian_mechanism.hpp"
#include "engine/methods/privacy/null_space.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr double kSlack = 1e-9;             // relative, of the inequality that the design meets with equality
constexpr std::int64_t kRecomputed = 1000;  // steps after which a running sum is made anew

void check(const FusionModel& model, const TwoStepSettings& settings) {
  if (settings.window < 1)
    throw InputError("/tq", fmt::format("tq is {}; expected 1 or more", settings.window), "1 or more");
  if (!(settings.zeta >= 0) || !std::isfinite(settings.zeta))
    throw InputError("/zeta", fmt::format("zeta is {:g}; expected 0 or more", settings.zeta), "0 or more");
  if (!(settings.q_alpha >= 0) || !std::isfinite(settings.q_alpha))
    throw InputError("/q_alpha", fmt::format("q_alpha is {:g}; expected 0 or more", settings.q_alpha), "0 or more");
  if (settings.H.size() != model.states() || (settings.H.array() * (1 - settings.H.array()) != 0).any())
    throw InputError("/H", fmt::format("H must have {} entries, each 0 or 1", model.states()), "0 or 1");
  const auto count = static_cast<std::size_t>(model.count());
  const auto bad = [](double q) { return !(q >= 0) || !std::isfinite(q); };
  const auto& q = settings.q_xi;
  if (!q.empty() && (q.size() != count || std::any_of(q.begin(), q.end(), bad)))
    throw InputError("/q_xi", fmt::format("q_xi must be {} numbers, none negative", count), "0 or more");
  if (!settings.Rg.empty() && settings.Rg.size() != count)
    throw InputError("/Rg", fmt::format("Rg must be {} matrices", count));
}

/// The first noise: its variances, and what it makes of the local estimates.
void first_noise(const TwoStepSettings& settings, TwoStep& design) {
  std::vector<MatrixXd> added;
  for (std::size_t i = 0; i < design.V.size(); ++i) {
    const MatrixXd spread = design.Rg[i] * design.Rg[i].transpose();
    const double least = least_eigenvalue(spread);
    if (!(least > 0)) throw InputError("/Rg", "a noise gain must be an invertible matrix", "an invertible matrix");
    design.sigma.push_back(spectral_norm(design.V[i]));
    const double deviation = design.gamma * design.sigma[i] * settings.zeta;
    design.q_xi.push_back(settings.q_xi.empty() ? deviation * deviation / (settings.window * least) : settings.q_xi[i]);
    added.push_back(design.q_xi[i] * spread);
  }
  design.Pp = design.filters.P + block_diagonal(added);
}

void check_theorem(const TwoStepSettings& settings, TwoStep& design) {
  const auto n = design.nominal.P.rows();
  for (std::size_t i = 0; i < design.V.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i) * n;
    design.Qphi.push_back(settings.window * design.q_xi[i] * design.Rg[i] * design.Rg[i].transpose() +
                          settings.q_alpha * design.Pi.block(at, at, n, n));
    const double asked = design.gamma * design.sigma[i] * settings.zeta;
    design.private_enough.push_back(least_eigenvalue(design.Qphi[i]) >= asked * asked * (1 - kSlack));
  }
}

}  // namespace

TwoStep design_two_step(const FusionModel& model, const TwoStepSettings& settings) {
  check(model, settings);
  const int n = model.states();
  TwoStep design;
  design.gamma = gamma_factor(settings.epsilon, settings.delta);
  auto filters = stationary_filters(model);
  if (!filters) throw InputError("", "a sensor's filter has no stationary law: the target is not detectable from it");
  design.filters = std::move(*filters);
  design.nominal = fuse(design.filters.P, n);
  design.Rg = settings.Rg;
  if (design.Rg.empty()) design.Rg.assign(static_cast<std::size_t>(model.count()), MatrixXd::Identity(n, n));
  for (const MatrixXd& KC : visible_gains(model, design.filters.gains))
    design.V.push_back(KC * settings.H.asDiagonal());
  first_noise(settings, design);
  design.compensated = fuse(design.Pp, n);
  design.Pi = null_projector(design.compensated.W);
  check_theorem(settings, design);
  const MatrixXd& W = design.nominal.W;
  design.at_once = (W * design.Pp * W.transpose()).trace();
  design.leak = settings.q_alpha * (W * design.Pi * W.transpose()).trace();
  design.slope = settings.window == 1 ? 0 : 2 * design.leak / settings.window;
  return design;
}

std::int64_t noises_carried(std::int64_t t, int window) {
  if (t < 1) return 0;
  if (window == 1) return 1;  // this noise telescopes too
  const std::int64_t rounds = (t - 1) / window;
  return 2 * (rounds + 1) - ((t - 1) % window == 0 ? 1 : 0);
}

double differencing_trace(const TwoStep& design, std::int64_t t, int window) {
  return design.at_once + static_cast<double>(noises_carried(t, window)) * design.leak;
}

// x - W s / tq = mean over the window of (x(t) - x(k)) + W (x~(k) - noise): all a linear image of the present and past
// of the stationary chain Y = (x, x~), Y+ = M Y + noise.
double window_mean_trace(const FusionModel& model, const TwoStep& design, const TwoStepSettings& settings) {
  const int n = model.states(), all = n + model.stacked(), window = settings.window;
  const auto S = state_covariance(model);
  if (!S) return std::numeric_limits<double>::infinity();
  MatrixXd Y(all, all), M = MatrixXd::Zero(all, all);
  Y.topLeftCorner(n, n) = *S;
  Y.bottomRightCorner(all - n, all - n) = design.filters.P;
  for (int i = 0; i < model.count(); ++i) {
    const MatrixXd own = design.filters.P.block(i * n, i * n, n, n);
    Y.block(n + i * n, 0, n, n) = own;
    Y.block(0, n + i * n, n, n) = own;
  }
  M.topLeftCorner(n, n) = model.A;
  M.bottomRightCorner(all - n, all - n) = block_diagonal(design.filters.Psi);
  std::vector<MatrixXd> image(static_cast<std::size_t>(window), MatrixXd::Zero(n, all));  // of Y(t - k)
  for (MatrixXd& part : image) part << -MatrixXd::Identity(n, n) / window, design.nominal.W / window;
  image.front().leftCols(n) += MatrixXd::Identity(n, n);
  double trace = 0;
  for (int j = 0; j < window; ++j) {
    MatrixXd ahead = Y;  // E[Y(t - k) Y(t - j)'] for k <= j
    for (int k = j; k >= 0; --k) {
      const double part =
          (image[static_cast<std::size_t>(k)] * ahead * image[static_cast<std::size_t>(j)].transpose()).trace();
      trace += k == j ? part : 2 * part;
      ahead = (M * ahead).eval();
    }
  }
  const MatrixXd& W = design.nominal.W;
  const double first = (W * (design.Pp - design.filters.P) * W.transpose()).trace();
  return trace + first / window + design.leak / (window * window);
}

const Eigen::VectorXd& TwoStepSender::send(const Eigen::VectorXd& xp, const Eigen::VectorXd& hidden) {
  const auto slot = static_cast<std::size_t>(t_ % window_);
  if (t_ == 0) {
    past_.assign(static_cast<std::size_t>(window_), xp);
    sum_ = window_ * xp;
    message_ = sum_;
  } else {
    oldest_ = past_[slot];
    sum_ += xp - oldest_;
    past_[slot] = xp;
    if (t_ % kRecomputed == 0) {
      sum_.setZero();
      for (const Eigen::VectorXd& term : past_) sum_ += term;
    }
    message_ = sum_ + hidden;
    if (printed_ && t_ > window_) message_ += oldest_;
  }
  ++t_;
  return message_;
}

const Eigen::VectorXd& TwoStepReceiver::receive(const Eigen::VectorXd& message) {
  const auto slot = static_cast<std::size_t>(t_ % window_);
  if (t_ == 0) {
    x_ = G_ * message / window_;
    past_.assign(static_cast<std::size_t>(window_), x_);
  } else {
    last_ = message - last_;
    x_ = past_[slot];  // of t - window, or of 0
    x_.noalias() += G_ * last_;
    past_[slot] = x_;
  }
  last_ = message;
  known_ = true;
  ++t_;
  return x_;
}

const Eigen::VectorXd& TwoStepReceiver::miss(const Eigen::VectorXd& guess) {
  x_ = guess;
  if (t_ == 0) past_.assign(static_cast<std::size_t>(window_), x_);
  past_[static_cast<std::size_t>(t_ % window_)] = x_;
  known_ = false;
  ++t_;
  return x_;
}

const Eigen::VectorXd& TwoStepReceiver::resume(const Eigen::VectorXd& message, const Eigen::VectorXd& guess) {
  miss(guess);
  last_ = message;
  known_ = true;
  return x_;
}

}  // namespace vigil::privacy
