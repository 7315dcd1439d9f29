/// Two noises in a row: white noise on the local estimates, then sums over a moving window with null-space noise that
/// the compensated weights do not let through. Seed 004, (4-11)-(4-29), with the corrections of the specification
/// (privacy), sections 4.1-4.5.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/methods/privacy/gaussian_mechanism.hpp"
#include "engine/methods/privacy/lmv_fusion.hpp"
#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {

struct TwoStepSettings {
  double epsilon = 0.69314718055994531;  ///< > 0; ln 2
  double delta = 0.1;                    ///< between 0 and 1/2
  double zeta = 0.1;                     ///< >= 0, how far two adjacent states are apart (2-norm)
  int window = 5;                        ///< >= 1, terms of a sum
  double q_alpha = 0.01;                 ///< >= 0, variance of the null-space noise
  Eigen::VectorXd H;                     ///< n entries 0 or 1: the components that may differ
  std::vector<Eigen::MatrixXd> Rg;       ///< noise gains, n x n, invertible; empty: I
  std::vector<double> q_xi;              ///< variances, >= 0, one a sensor; empty: as Theorem 4.1 asks
};

struct TwoStep {
  StationaryFilters filters;
  Fusion nominal;                  ///< W, which the eavesdropper uses
  std::vector<Eigen::MatrixXd> V;  ///< K_i C_i H, n x n
  std::vector<Eigen::MatrixXd> Rg;
  double gamma = 0;
  std::vector<double> sigma, q_xi;    ///< || V_i || and the variances of the first noise
  Eigen::MatrixXd Pp;                 ///< of the noisy estimates, (n L) x (n L)
  Fusion compensated;                 ///< Wc, and the legitimate covariance at all times
  Eigen::MatrixXd Pi;                 ///< projector on the null space of Wc
  std::vector<Eigen::MatrixXd> Qphi;  ///< noise covariance of one message
  std::vector<bool> private_enough;   ///< (4-14), one a sensor
  double at_once = 0;                 ///< trace of W Pp W': what the eavesdropper has without the second noise
  double leak = 0;                    ///< q_alpha tr(W Pi W'), added c(t) times
  double slope = 0;                   ///< of the eavesdropper's trace a step: 2 leak / window, 0 for a window of 1
};

/// Throws InputError where a setting is out of its range or a filter has no stationary law.
TwoStep design_two_step(const FusionModel& model, const TwoStepSettings& settings);

/// c(t), t >= 0: how many null-space noises the differencing eavesdropper's estimate carries.
std::int64_t noises_carried(std::int64_t t, int window);
/// tr(W Pp W') + c(t) leak, the differencing eavesdropper's trace at t >= 0.
double differencing_trace(const TwoStep& design, std::int64_t t, int window);
/// The trace of one who takes W s(t) / window for the state: bounded. t at least `window`.
double window_mean_trace(const FusionModel& model, const TwoStep& design, const TwoStepSettings& settings);

/// The messages s(t), t = 0, 1, 2 ..., stacked.
class TwoStepSender {
 public:
  /// printed: as (4-12) prints it, with window + 1 terms for t > window; what (4-18) makes of that does not telescope.
  explicit TwoStepSender(int window, bool printed = false) : window_(window), printed_(printed) {}
  /// xp: this tick's noisy estimates; hidden: Pi alpha, ignored at t = 0.
  const Eigen::VectorXd& send(const Eigen::VectorXd& xp, const Eigen::VectorXd& hidden);

 private:
  std::int64_t t_ = 0;
  int window_;
  bool printed_;
  std::vector<Eigen::VectorXd> past_;  ///< xp, a ring of `window`
  Eigen::VectorXd sum_, message_, oldest_;
};

/// x(t) = G (s(t) - s(t-1)) + x(max(t - window, 0)), x(0) = G s(0) / window: with Wc the legitimate user's (4-18), with
/// I the differencing eavesdropper's (4-20).
class TwoStepReceiver {
 public:
  TwoStepReceiver(Eigen::MatrixXd G, int window) : G_(std::move(G)), window_(window) {}
  const Eigen::VectorXd& receive(const Eigen::VectorXd& message);
  /// A message that did not come, or whose difference to the one before cannot be made because that did not come: x is
  /// `guess` in this tick, and what later ticks add up to goes on from there.
  const Eigen::VectorXd& miss(const Eigen::VectorXd& guess);
  /// The same, and this tick's message is known: the next difference can be made.
  const Eigen::VectorXd& resume(const Eigen::VectorXd& message, const Eigen::VectorXd& guess);
  /// False where the message before did not come: receive() would have nothing to subtract.
  bool in_step() const { return t_ == 0 || known_; }
  const Eigen::VectorXd& x() const { return x_; }

 private:
  std::int64_t t_ = 0;
  Eigen::MatrixXd G_;
  int window_;
  bool known_ = false;                 ///< last_ is the message of the tick before
  std::vector<Eigen::VectorXd> past_;  ///< x, a ring of `window`
  Eigen::VectorXd last_, x_;
};

/// What two trajectories that differ at one time t0 look like to one who watches a sensor's messages; noises of a
/// message, oldest first.
struct TwoStepViews {
  PrivacyLoss single;        ///< the message of that time (Theorem 4.1)
  PrivacyLoss single_worst;  ///< the later message with the largest shift
  int worst_lag = 0;
  PrivacyLoss difference;  ///< that message less the one before
  PrivacyLoss prefix;      ///< kAround earlier messages and that one
  PrivacyLoss stream;      ///< and kAround later ones
  static constexpr int kAround = 60;
};
TwoStepViews two_step_views(const TwoStep& design, const TwoStepSettings& settings, std::size_t sensor);

}  // namespace vigil::privacy
