/// The privacy loss of every tick for each of those who watch a mechanism, sampled with the noise that was really
/// drawn. Specification (privacy), sections 1.6, 3.5 and 4.5.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/methods/privacy/gaussian_mechanism.hpp"

namespace vigil::privacy {

/// One observer. What it sees of two adjacent trajectories differs by a linear image of the noises of the last ticks,
/// so its loss is their product with weights, and mu^2/2.
struct LossView {
  std::string name;         ///< as in the contract's `loss.<name>`
  int output = -1;          ///< whose it is: a node, or the number of nodes for what is published
  double mu = 0;            ///< infinite: seen for certain, nothing to sample
  Eigen::MatrixXd weights;  ///< size x lags; column j is for the noise of j ticks ago
  Eigen::VectorXd shift;    ///< how far apart the newest outputs of the worst neighbours are
  std::int64_t first = 0;   ///< tick of the first loss: the noise of all its lags has its lasting law by then
};

/// A view of the loss of `lags` noises of size `rows`, oldest first as the loss has them; `offset` of `size` entries is
/// where they begin in the mechanism's noise.
LossView view_of(const PrivacyLoss& loss, std::string name, int output, int size, int offset, int rows);

class LossMeter {
 public:
  LossMeter() = default;
  LossMeter(int size, double epsilon, double delta, std::vector<LossView> views);

  /// The noise of the next tick, beginning with tick 0; size.
  void add(const Eigen::VectorXd& noise);
  /// Of the newest tick; NaN where it cannot be judged yet or mu is infinite.
  double loss(std::size_t view) const { return losses_[view]; }
  const std::vector<LossView>& views() const { return views_; }

  void declare(SignalScope& scope);  ///< loss.<view>, of those that can be sampled
  void publish(std::span<double> values) const;
  /// p_loss of each: the share of the judged ticks whose loss was above epsilon.
  std::vector<OwnMetric> metrics() const;
  /// {view: {node: {mu, p_loss, eps_at_delta}}}, exact; an infinite mu is null, with "infinite": true.
  Json design(const std::vector<std::string>& nodes) const;

 private:
  int size_ = 0;
  double epsilon_ = 1, delta_ = 0.1;
  std::vector<LossView> views_;
  std::vector<int> ids_;
  std::int64_t ticks_ = 0;
  Eigen::MatrixXd ring_;  ///< size x the longest memory; tick t in column t mod that
  std::vector<double> losses_;
  std::vector<std::int64_t> judged_, above_;
};

}  // namespace vigil::privacy
