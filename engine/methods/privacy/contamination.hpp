/// Null-space contamination: some components of the local estimates are replaced by noise that the nominal weights do
/// not let through, and the legitimate user puts its own prediction in their place. Seed 004, (2-14)-(2-33), with the
/// corrections of the specification (privacy), section 2. Components count over all sensors, c = i n + j.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/methods/privacy/lmv_fusion.hpp"
#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {

using ComponentSet = std::vector<int>;  ///< contaminated components, ascending

/// 1 where kept, 0 where contaminated; n L.
Eigen::VectorXd kept(const ComponentSet& contaminated, int stacked);
/// All sets of m of `stacked` components, lexicographically. Throws InputError where m is not in 0..stacked or there
/// are more than 20000.
std::vector<ComponentSet> component_sets(int stacked, int m);

/// The null space the noise lives in: Pi of W (I - H), (n L) x (n L).
Eigen::MatrixXd contamination_projector(const Eigen::MatrixXd& W, const Eigen::VectorXd& h);
/// m - rank(W (I - H)): 0 means that the contaminated components carry exact zeros.
int contamination_null_dim(const Eigen::MatrixXd& W, const Eigen::VectorXd& h);
/// What is sent, xr = H xhat + (I - H) Pi a, for the stacked estimates and the white noise a (both n L).
Eigen::VectorXd contaminate(const Eigen::VectorXd& xhat, const Eigen::VectorXd& h, const Eigen::MatrixXd& Pi,
                            const Eigen::VectorXd& a);
/// What the legitimate user makes of it with its prediction p (n): xc = H xr + (I - H) e p.
Eigen::VectorXd compensate(const Eigen::VectorXd& xr, const Eigen::VectorXd& h, const Eigen::VectorXd& p);

/// The legitimate user's covariances, section 2.3.
struct Legitimate {
  Eigen::MatrixXd Wf;  ///< n x (n L)
  Eigen::MatrixXd P;   ///< of the fused error, n x n
  Eigen::MatrixXd X;   ///< E[fused error * local errors'], n x (n L)
  Eigen::MatrixXd S;   ///< of the compensated estimates, (n L) x (n L); empty before the first step
};
/// Where all start from the same guess.
Legitimate legitimate_start(const Eigen::MatrixXd& P0, int count);
/// Where the local filters have covariance P, not singular, and the user has fused them: the stationary start.
Legitimate legitimate_from(const Eigen::MatrixXd& P, int n);
/// What the user's prediction is worth.
struct Foresight {
  Eigen::MatrixXd P;  ///< of its error, n x n
  Eigen::MatrixXd X;  ///< E[local errors * its error'], (n L) x n
};
/// After the local filters' step: steps and gains are this tick's, Af the transition of the fused prediction.
Foresight foresee(std::span<const LocalStep> steps, const std::vector<LocalGains>& gains, const Eigen::MatrixXd& Qb,
                  const Eigen::MatrixXd& Af, const Legitimate& user);
/// Fuses what came, its prediction standing where h is 0. P: of the local errors; noise: what was added to the local
/// estimates before they were sent, (n L) x (n L) or empty.
void take_in(const Eigen::MatrixXd& P, const Foresight& prediction, const Eigen::VectorXd& h,
             const Eigen::MatrixXd& noise, Legitimate& user);
/// foresee() and then take_in() without noise: one step, where P is the local filters' covariance after it.
void step_legitimate(std::span<const LocalStep> steps, const std::vector<LocalGains>& gains, const Eigen::MatrixXd& Qb,
                     const Eigen::MatrixXd& P, const Eigen::MatrixXd& Af, const Eigen::VectorXd& h, Legitimate& user);

/// The eavesdropper's covariance, section 2.4, where the state's second moment is Lam (n x n, the mean included).
Eigen::MatrixXd eavesdropper_covariance(const Fusion& nominal, const Eigen::MatrixXd& P, const Eigen::MatrixXd& Lam,
                                        const Eigen::VectorXd& h);
/// The gain Hm of (2-22), as e [Lam (Lam + P_f)^-1] W.
Eigen::MatrixXd second_moment_gain(const Fusion& nominal, const Eigen::MatrixXd& Lam, int count);

enum class Selection : std::uint8_t {
  norm,   ///< largest || H - Hm ||, seed 004, Theorem 2.1: a heuristic
  exact,  ///< largest trace of the eavesdropper's covariance
};
/// Ties, to 1e-9 relative, go to the first set. `sets` is not empty.
const ComponentSet& choose_set(const std::vector<ComponentSet>& sets, Selection mode, const Fusion& nominal,
                               const Eigen::MatrixXd& P, const Eigen::MatrixXd& Lam);
/// The rule of the nonlinear plant, Theorem 2.2: keeps the components known worst; the same ties.
const ComponentSet& choose_worst_known(const std::vector<ComponentSet>& sets, const Eigen::MatrixXd& P);

}  // namespace vigil::privacy
