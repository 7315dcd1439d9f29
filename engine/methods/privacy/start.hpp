/// Where a fusion lane begins: what the local estimates are worth before the first reading, and what everybody thought
/// before them. Specification (privacy), sections 1.2 and 4.7.
#pragma once

#include <Eigen/Core>

#include "engine/methods/method.hpp"
#include "engine/methods/privacy/contamination.hpp"

namespace vigil::privacy {

/// Mean of the initial state; where it is not given that of the initial estimates.
Eigen::VectorXd prior_mean(const Knowledge& knowledge);

/// Stacked covariance of the initial local errors, (n L) x (n L): one error for all where all start alike, independent
/// ones of covariance P0 where each has its own start. `filters`: those of the stationary start, else null.
Eigen::MatrixXd start_covariance(const Knowledge& knowledge, const StationaryFilters* filters);

/// What the prior mean is worth beside local errors of covariance P.
Foresight prior_foresight(const Knowledge& knowledge, const Eigen::MatrixXd& P);

/// E[x x'] of a linear plant's state, as all may compute it beforehand: Lam of section 2.2.
class StateMoment {
 public:
  explicit StateMoment(const Knowledge& knowledge);

  bool known() const { return linear_; }  ///< false where the plant is not linear: the rest is meaningless then
  /// To the next tick. input: the plant's known one; empty: it has none.
  void step(const Eigen::VectorXd& input);
  const Eigen::MatrixXd& second() const { return second_; }  ///< n x n, the mean included
  bool settled() const { return settled_; }                  ///< the newest step changed it by less than 1e-12 relative

 private:
  std::shared_ptr<const Plant> plant_;
  bool linear_;
  Eigen::VectorXd no_input_, mean_;
  Eigen::MatrixXd A_, Q_, covariance_, second_;
  bool settled_ = false;
};

}  // namespace vigil::privacy
