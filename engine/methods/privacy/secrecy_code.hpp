/// State-secrecy codes (Tsiamis, Gatsis and Pappas): a sensor sends its estimate less a multiple of its last one.
/// Specification (privacy), section 4.6.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/methods/privacy/lmv_fusion.hpp"
#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {

/// Code A (Lc = A): the covariance, in the long run, of what an eavesdropper fuses that misses each time step, all
/// sensors together, with probability `loss` (0..1) and predicts A xe then. Nothing where A is not stable.
std::optional<Eigen::MatrixXd> code_a_eavesdropper(const FusionModel& model, const StationaryFilters& filters,
                                                   const Fusion& nominal, double loss);

/// Code A from the first tick on: the same covariance in every tick, for local filters in their stationary law and a
/// state that begins in its own, jointly with them, where A is stable, else at the prior mean. The eavesdropper begins
/// at the prior mean; the first message is not coded, and it may miss it.
class CodeAError {
 public:
  CodeAError(const FusionModel& model, const StationaryFilters& filters, double loss);
  void step();
  /// For the nominal weights W, n x (n L): in the tick of the last step; before any, in tick 0.
  double trace(const Eigen::MatrixXd& W) const;

 private:
  Eigen::MatrixXd A_, Psi_, P_;
  Eigen::MatrixXd seen_;                 ///< how E[d x~'] comes to D through a missed correction
  Eigen::MatrixXd enters_G_, enters_D_;  ///< what a missed correction adds of its own
  Eigen::MatrixXd G_, D_;                ///< E[d x~'] and E[d d'], d = what the eavesdropper has not got of xhat
  Eigen::MatrixXd ahead_, mixed_;
};

/// Code L, one a sensor: Lc = S_i A^-T S_i^-1, S_i the covariance of the sensor's estimate; what is sent is then
/// uncorrelated with the newest estimate. Nothing where A is not stable or not invertible. Its eavesdropper is left
/// with the prior: state_covariance.
std::optional<std::vector<Eigen::MatrixXd>> code_l(const FusionModel& model, const StationaryFilters& filters);

/// The code with one Lc = S A^-T S^-1 for all sensors, from the covariance of the state: it leaks. Nothing as above.
std::optional<Eigen::MatrixXd> code_l_state(const FusionModel& model);

/// What is added to a sensor's messages to get its estimates back: a multiple of the newest one that was got. Sensor
/// and user run the same one (the sensor learns what arrived), so that what is lost to rounding is lost to both and
/// does not grow with the powers of an unstable Lc; an eavesdropper who has missed nothing runs it, too.
class CodeMemory {
 public:
  explicit CodeMemory(Eigen::MatrixXd Lc);
  /// To the next tick: Lc once more.
  void advance();
  /// What the sensor takes off its estimate in this tick, states: zero where it sends that as it is, because nothing
  /// has arrived yet or, so long ago was it, the multiple has passed 1e9 and would swallow the estimate's digits.
  const Eigen::VectorXd& base() const { return base_; }
  /// A message has arrived; its estimate.
  const Eigen::VectorXd& decode(const Eigen::Ref<const Eigen::VectorXd>& message);
  bool restarted() const { return restarted_; }  ///< for the second reason, ever

 private:
  Eigen::MatrixXd Lc_;
  Eigen::VectorXd base_, next_;
  bool restarted_ = false;
};

/// What the last messages of all sensors, coded as against what the user has of the tick before, are worth to one who
/// knows all of the model: the best linear estimate of the state, in the stationary law.
class RecentMessages {
 public:
  /// Lc: one a sensor. depth: messages of a sensor, >= 1.
  RecentMessages(const FusionModel& model, const StationaryFilters& filters, const Eigen::MatrixXd& S,
                 const std::vector<Eigen::MatrixXd>& Lc, int depth);
  struct Best {
    Eigen::MatrixXd gain;  ///< n x (depth n L), zero for what was not heard
    double trace = 0;      ///< of its error covariance
  };
  /// heard: depth x L entries, newest tick first, all sensors of a tick together; likewise the messages.
  Best best(const std::vector<char>& heard) const;
  int depth() const { return depth_; }

 private:
  int states_, depth_;
  Eigen::MatrixXd S_, Z_, X_;  ///< covariances of the state, of the messages, and E[state messages']
};

}  // namespace vigil::privacy
