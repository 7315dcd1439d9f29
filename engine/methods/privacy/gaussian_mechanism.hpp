/// Differential privacy by Gaussian noise and what it costs. Seed 004, Lemma 3.1 and (3-16) (Le Ny and Pappas, 2014);
/// specification (privacy), section 1.6. mu is the distance of two adjacent outputs in standard deviations of the
/// noise.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace vigil::privacy {

/// P(N(0,1) > z).
double normal_tail(double z);
/// The z with normal_tail(z) = p, 0 < p < 1; NaN outside.
double normal_tail_inverse(double p);

/// Noise of standard deviation Gamma times the sensitivity is (epsilon, delta)-private. Throws InputError at
/// /epsilon or /delta where epsilon > 0 or 0 < delta < 1/2 does not hold.
double gamma_factor(double epsilon, double delta);

/// P(privacy loss > epsilon); 0 at mu = 0 (for epsilon >= 0), 1 at mu = infinity.
double loss_probability(double epsilon, double mu);
/// The least delta for which noise at mu is (epsilon, delta)-private, epsilon >= 0.
double exact_delta(double epsilon, double mu);
/// The least epsilon >= 0 for that delta, 0 < delta < 1, to 1e-12 relative; infinity at mu = infinity.
double exact_epsilon(double mu, double delta);

/// The privacy loss of an output whose shift between worst adjacent trajectories is D u, ||u|| <= bound, under noise of
/// covariance S.
class PrivacyLoss {
 public:
  /// D: outputs x n; S: outputs x outputs, positive semidefinite.
  PrivacyLoss(const Eigen::MatrixXd& D, const Eigen::MatrixXd& S, double bound);
  /// The same for a noise that few outputs share, such as that of a long stream of messages: O(outputs) where S has a
  /// band.
  static PrivacyLoss banded(const Eigen::MatrixXd& D, const Eigen::SparseMatrix<double>& S, double bound);
  /// The same for independent outputs of those variances, each >= 0.
  static PrivacyLoss white(const Eigen::MatrixXd& D, const Eigen::VectorXd& variances, double bound);
  /// Infinite where a shift meets no noise.
  double mu() const { return mu_; }
  const Eigen::VectorXd& shift() const { return shift_; }  ///< the worst one
  const Eigen::VectorXd& weights() const { return weights_; }
  /// ln of how much likelier the output is under the trajectory it came from than under its neighbour, given the noise
  /// that was drawn (outputs). Its law is N(mu^2/2, mu^2). Only where mu is finite.
  double sampled(const Eigen::VectorXd& noise) const { return weights_.dot(noise) + 0.5 * mu_ * mu_; }

 private:
  PrivacyLoss() = default;
  /// For the shift D and S^-1 D.
  void take(const Eigen::MatrixXd& D, const Eigen::MatrixXd& solved, double bound);

  Eigen::VectorXd shift_, weights_;  ///< weights: S^-1 shift
  double mu_ = 0;
};

/// The largest singular value.
double spectral_norm(const Eigen::MatrixXd& M);

}  // namespace vigil::privacy
