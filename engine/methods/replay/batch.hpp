/// The unbiased finite-impulse-response batch: a state from the last n readings and no prior. Seed 003, eqs. (2)-(3);
/// specification (replay), sections 4.1 and 4.3.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/methods/replay/mixed_update.hpp"

namespace vigil::replay {

/// Made once from A (n x n), B (n x m), C (p x n). The window holds samples m..e = m + n - 1.
class Batch {
 public:
  /// Nothing where no batch can start (`not_batch_observable`): A is singular, or the stacked H has rank below n.
  static std::optional<Batch> make(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C);

  int length() const { return static_cast<int>(G_.rows()); }  ///< n, in samples

  /// xh_e = G H' (Y - E U) + BN U. Y: p x n, the readings y_m..y_e; U: m x n, the inputs u_{m-1}..u_{e-1}. No
  /// allocation.
  BoundedVector estimate(const Eigen::Ref<const Eigen::MatrixXd>& Y, const Eigen::Ref<const Eigen::MatrixXd>& U) const;

  const Eigen::MatrixXd& G() const { return G_; }    ///< (H'H)^-1, n x n
  const Eigen::MatrixXd& GH() const { return GH_; }  ///< G H', n x pn

  /// Covariance and ellipsoid of the estimate's error. P, Mw: n x n of the process, R, Mv: p x p of the sensor.
  Bounds error(const Eigen::MatrixXd& P, const Eigen::MatrixXd& R, const Eigen::MatrixXd& Mw,
               const Eigen::MatrixXd& Mv) const;

 private:
  Batch() = default;
  Eigen::MatrixXd G_, GH_;
  Eigen::MatrixXd of_input_;    ///< BN - G H' E, n x mn
  Eigen::MatrixXd of_process_;  ///< T_w = DN - G H' F, n x nn
};

}  // namespace vigil::replay
