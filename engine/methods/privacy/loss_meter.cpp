#include "engine/methods/privacy/loss_meter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vigil::privacy {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool sampled(const LossView& view) { return std::isfinite(view.mu); }

}  // namespace

LossView view_of(const PrivacyLoss& loss, std::string name, int output, int size, int offset, int rows) {
  LossView view{.name = std::move(name),
                .output = output,
                .mu = loss.mu(),
                .weights = {},
                .shift = loss.shift().tail(rows),
                .first = 0};
  const auto lags = loss.weights().size() / rows;
  view.weights = Eigen::MatrixXd::Zero(size, lags);
  view.weights.middleRows(offset, rows) = loss.weights().reshaped(rows, lags).rowwise().reverse();
  return view;
}

LossMeter::LossMeter(int size, double epsilon, double delta, std::vector<LossView> views)
    : size_(size), epsilon_(epsilon), delta_(delta), views_(std::move(views)) {
  Eigen::Index longest = 1;
  for (const LossView& view : views_) longest = std::max(longest, view.weights.cols());
  ring_ = Eigen::MatrixXd::Zero(size, longest);
  losses_.assign(views_.size(), kNaN);
  judged_.assign(views_.size(), 0);
  above_.assign(views_.size(), 0);
}

void LossMeter::add(const Eigen::VectorXd& noise) {
  const auto memory = ring_.cols();
  const auto now = static_cast<Eigen::Index>(ticks_ % memory);
  ring_.col(now) = noise;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    const LossView& view = views_[v];
    if (!sampled(view) || ticks_ < view.first) continue;
    double loss = 0.5 * view.mu * view.mu;
    for (Eigen::Index lag = 0; lag < view.weights.cols(); ++lag)
      loss += view.weights.col(lag).dot(ring_.col(now >= lag ? now - lag : now - lag + memory));
    losses_[v] = loss;
    ++judged_[v];
    above_[v] += loss > epsilon_ ? 1 : 0;
  }
  ++ticks_;
}

void LossMeter::declare(SignalScope& scope) {
  ids_.clear();
  for (const LossView& view : views_)
    ids_.push_back(sampled(view) ? scope.add(view.output, "loss." + view.name, "", SignalKind::scalar) : -1);
}

void LossMeter::publish(std::span<double> values) const {
  for (std::size_t v = 0; v < ids_.size(); ++v) {
    if (ids_[v] >= 0) values[static_cast<std::size_t>(ids_[v])] = losses_[v];
  }
}

std::vector<OwnMetric> LossMeter::metrics() const {
  std::vector<OwnMetric> metrics;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    if (judged_[v] == 0) continue;
    const double share = static_cast<double>(above_[v]) / static_cast<double>(judged_[v]);
    metrics.push_back({views_[v].output, "p_loss", share, false, views_[v].name});
  }
  return metrics;
}

Json LossMeter::design(const std::vector<std::string>& nodes) const {
  Json design = Json::object();
  for (const LossView& view : views_) {
    const auto output = static_cast<std::size_t>(view.output);
    const std::string& node = output < nodes.size() ? nodes[output] : std::string("fused");
    Json& mine = design[view.name][node];
    mine["p_loss"] = loss_probability(epsilon_, view.mu);
    if (std::isfinite(view.mu)) {
      mine["mu"] = view.mu;
      mine["eps_at_delta"] = exact_epsilon(view.mu, delta_);
    } else {
      mine["mu"] = nullptr;
      mine["eps_at_delta"] = nullptr;
      mine["infinite"] = true;
    }
  }
  return design;
}

}  // namespace vigil::privacy
