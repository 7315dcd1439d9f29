/// The legitimate user at the fusion centre: fuses what came, puts its own prediction where nothing of use did, and
/// knows what that is worth. Seed 004, (2-23), (2-30)-(2-33), (2-41); specification (privacy), section 2.3.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/methods/privacy/contamination.hpp"
#include "engine/methods/privacy/protection.hpp"

namespace vigil::privacy {

/// Brings an estimate to the turn of `anchor` where a state is an angle (period not 0); both n long.
void to_turn_of(const Eigen::Ref<const Eigen::VectorXd>& anchor, const std::vector<double>& periods,
                Eigen::Ref<Eigen::VectorXd> estimate);
/// Of the plant's states, in their order.
std::vector<double> periods_of(const Plant& plant);

class Centre {
 public:
  /// start: the public tick 0.
  Centre(const Knowledge& knowledge, const PublicTick& start);

  /// One tick, from 0 on. noise: what the mechanism leaves on the local estimates, the same in all settled ticks.
  /// False where the estimate is no longer finite.
  bool take(const PublicTick& tick, const Decoded& decoded, const Protection& protection);

  const Eigen::VectorXd& mean() const { return mean_; }
  /// Of its error, n x n; empty: not known.
  const Eigen::MatrixXd& covariance() const { return user_.P; }
  /// From the first tick on in which the prediction stood for a component: what is fused in place of a message, states;
  /// null before.
  const double* compensated(int sensor) const;
  double compensated_trace(int sensor) const;

 private:
  void predict(const PublicTick& tick);
  void compensate(const Decoded& decoded);
  void weigh(const PublicTick& tick, const Eigen::VectorXd& h, const Protection& protection);

  std::shared_ptr<const Plant> plant_;
  std::vector<double> periods_;
  Eigen::MatrixXd Q_, Af_;
  Foresight prior_;
  Legitimate user_;
  Eigen::VectorXd mean_, predicted_, h_;
  Eigen::MatrixXd compensated_;  ///< states x sensors
  bool replaced_ = false;        ///< the prediction has stood for something
  bool steady_ = false;          ///< the weights stay what they are while the tick is settled and h_ is the same
};

}  // namespace vigil::privacy
