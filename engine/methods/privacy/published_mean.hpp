/// The mean of the last fused estimates, which a centre publishes. Specification (privacy), section 3.1.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/methods/privacy/lmv_fusion.hpp"
#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {

/// Of the last `kappa`; before there are that many, of those there are.
class PublishedMean {
 public:
  PublishedMean(int states, int kappa) : past_(states, kappa), mean_(states) {}
  const Eigen::VectorXd& add(const Eigen::VectorXd& fused);

 private:
  std::int64_t count_ = 0;
  Eigen::MatrixXd past_;  ///< a ring, states x kappa
  Eigen::VectorXd mean_;
};

/// How far from the state that mean is: the trace of its error's second moment, its lag behind the state included.
/// Exact for local filters in their stationary error law and a state that begins in its own, jointly with them, where A
/// is stable, else at the prior mean.
class MeanTrace {
 public:
  MeanTrace(const FusionModel& model, const StationaryFilters& filters, const Fusion& nominal, int kappa);
  /// To the next tick; the first call is tick 0.
  double step();

 private:
  double sum_over_window() const;

  int states_, kappa_;
  std::int64_t t_ = -1;
  Eigen::MatrixXd M_, driven_;         ///< Y = (x, x~ of all sensors): Y+ = M Y + noise of that covariance
  Eigen::MatrixXd fused_;              ///< the fused estimate as an image of Y, n x (n + n L)
  Eigen::MatrixXd law_;                ///< E[Y(t) Y(t)']
  std::vector<Eigen::MatrixXd> with_;  ///< E[Y(t) fused(t - k)']
  Eigen::MatrixXd pairs_;              ///< kappa x kappa: row s mod kappa, column k: trace of E[fused(s) fused(s - k)']
  Eigen::MatrixXd ahead_;
};

}  // namespace vigil::privacy
