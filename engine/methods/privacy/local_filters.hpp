/// Every sensor's own Kalman filter and how their errors are correlated. Seed 004, (2-10), (2-11), (3-7)-(3-9), with
/// the corrections of the specification (privacy), section 1.3. Errors are truth minus estimate; P stacks their
/// covariances, (n L) x (n L).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/methods/privacy/model.hpp"

namespace vigil::privacy {

inline constexpr int kMemory = 400;  ///< ticks of a stationary filter's memory that are counted

/// Whether a covariance moves no more: to 1e-12, relative.
template <class Matrix>
bool settled(const Matrix& now, const Matrix& before) {
  return (now - before).norm() <= 1e-12 * now.norm();
}

/// What one sensor's filter linearises its step to; for a linear plant A and C are the model's.
struct LocalStep {
  Eigen::MatrixXd A, C, R;
};
std::vector<LocalStep> local_steps(const FusionModel& model);

struct LocalGains {
  Eigen::MatrixXd K;  ///< n x m
  Eigen::MatrixXd F;  ///< I - K C, n x n
};

/// The gain of a filter whose prediction has covariance Pz. Nothing where the innovation's is not positive definite.
std::optional<LocalGains> local_gains(const Eigen::MatrixXd& Pz, const Eigen::MatrixXd& C, const Eigen::MatrixXd& R);

/// Where all filters start alike from a guess with covariance P0: P_ij = P0 for all i, j.
Eigen::MatrixXd common_start(const Eigen::MatrixXd& P0, int count);

/// One step of P, whose diagonal blocks are the filters' own covariances. Nothing, and P unchanged, where an
/// innovation's covariance is not positive definite.
std::optional<std::vector<LocalGains>> step_local(std::span<const LocalStep> steps, const Eigen::MatrixXd& Qb,
                                                  Eigen::MatrixXd& P);
/// The same with gains that are given, whatever they are: P is what the errors then have.
void step_errors(std::span<const LocalStep> steps, const std::vector<LocalGains>& gains, const Eigen::MatrixXd& Qb,
                 Eigen::MatrixXd& P);

struct StationaryFilters {
  std::vector<LocalGains> gains;
  std::vector<Eigen::MatrixXd> Psi;  ///< F_i A, n x n: what is left of an error a step later
  Eigen::MatrixXd P;                 ///< (n L) x (n L)
};
/// Nothing where a sensor's Riccati equation has no stabilising solution: (A, C_i) is not detectable or a mode of
/// modulus 1 is not driven by the noise.
std::optional<StationaryFilters> stationary_filters(const FusionModel& model);

/// K_i C_i, each n x n: what a step's state does to that step's local estimate.
std::vector<Eigen::MatrixXd> visible_gains(const FusionModel& model, const std::vector<LocalGains>& gains);

/// X = M X N' + W for spectral radii whose product is below 1, by doubling. Nothing where it does not settle.
std::optional<Eigen::MatrixXd> solve_stein(Eigen::MatrixXd M, Eigen::MatrixXd N, Eigen::MatrixXd W);
/// S = A S A' + Qb: the law of the state of a stable plant. Nothing where A is not stable.
std::optional<Eigen::MatrixXd> state_covariance(const FusionModel& model);

}  // namespace vigil::privacy
