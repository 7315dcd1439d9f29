/// A privacy mechanism of a lane and those who listen: what sits on the link channels between what a node says and what
/// a receiver makes of it. Seed 004; specification (privacy), sections 2-4.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/methods/privacy/lmv_fusion.hpp"
#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {

/// What everybody may know of a fusion lane at one tick, an eavesdropper too: what the filters linearise to, their
/// covariances and the nominal weights. Nothing of it depends on a protection.
struct PublicTick {
  std::int64_t k = 0;
  Eigen::VectorXd input;          ///< known input of the plant since the tick before; empty: it has none
  std::vector<LocalStep> steps;   ///< one a sensor; empty at tick 0
  std::vector<LocalGains> gains;  ///< one a sensor; empty at tick 0
  Eigen::MatrixXd P;              ///< stacked covariance of the local errors, (n L) x (n L)
  Fusion nominal;                 ///< W and P_f for P; where all start from one guess W = [I/L ..] at tick 0
  bool settled = false;           ///< P, gains and weights are those of the tick before (to 1e-12 relative)
};

/// One who overhears messages. Knows what it is made from (the public model and code) and what listen() tells it.
class Eavesdropper {
 public:
  virtual ~Eavesdropper() = default;
  virtual std::unique_ptr<Eavesdropper> clone() const = 0;
  /// messages: states x sensors, as sent; a column i with heard[i] == 0 is NaN. Called at every tick from 0 on.
  virtual void listen(const PublicTick& tick, const Eigen::MatrixXd& messages, std::span<const char> heard) = 0;
  /// Before listen(), in a tick in which Protection::published() is not null: what everybody may read.
  virtual void see(const PublicTick& /*tick*/, const Eigen::VectorXd& /*published*/) {}
  virtual const Eigen::VectorXd& estimate() const = 0;  ///< of the state, states
};

/// What the centre makes of what it received in one tick.
struct Decoded {
  Eigen::MatrixXd estimates;  ///< states x sensors
  Eigen::VectorXd h;          ///< n L; 1: a component to be fused, 0: the centre puts its own prediction there
  bool fused = false;         ///< it has fused by itself, as at every tick or none: mean and P are set, the rest is not
  Eigen::VectorXd mean;       ///< states
  Eigen::MatrixXd P;          ///< states x states; empty: not known
};

/// A value with memory; its secrets (masks, noise) never leave it but through encode().
class Protection {
 public:
  virtual ~Protection() = default;
  virtual std::unique_ptr<Protection> clone() const = 0;

  /// False where encode() looks at the messages and tick.k alone, so that it serves any lane whose nodes talk.
  virtual bool needs_centre() const { return true; }
  /// Replaces what the nodes say (message size x nodes; at a fusion centre the local estimates) by what they send.
  /// At a fusion centre called at every tick from 0 on; elsewhere from 1 on, and only tick.k is set.
  virtual void encode(const PublicTick& tick, Eigen::MatrixXd& messages) = 0;

  /// The legitimate user's side, at a fusion centre. received: states x sensors; column i is meaningless where lost[i].
  /// The default takes what came for local estimates and predicts what did not.
  virtual void decode(const PublicTick& tick, const Eigen::MatrixXd& received, std::span<const char> lost,
                      Decoded& decoded);
  /// What the centre has fused in this tick (states): after decode() and the method's fusion, at every tick from 0 on.
  virtual void release(const PublicTick& /*tick*/, const Eigen::VectorXd& /*fused*/) {}
  /// What the centre has published of it in this tick, states; null where it publishes nothing. Eavesdroppers see it,
  /// so they come after release().
  virtual const Eigen::VectorXd* published() const { return nullptr; }
  /// White noise that encode() adds to the local estimates and decode() leaves there: its stacked covariance, (n L) x
  /// (n L); empty: none.
  virtual Eigen::MatrixXd noise() const { return {}; }

  /// Those who listen, by their names in the contract ("fusing", "differencing", "window_mean", "zero"); the first is
  /// the one that the mechanism is meant against.
  virtual std::vector<std::string> eavesdroppers() const { return {"fusing", "zero"}; }
  virtual std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const = 0;
  /// False where the mechanism keeps an eavesdropper from decoding what the sensor sent in the newest tick.
  virtual bool audible(int /*sensor*/) const { return true; }
  /// Trace of that eavesdropper's error covariance at the newest encoded tick, NaN where the specification has none. An
  /// analyst's figure: it may use secrets.
  virtual double eavesdropper_trace(const PublicTick& /*tick*/, const std::string& /*variant*/) const {
    return std::numeric_limits<double>::quiet_NaN();
  }

  /// Own signals; `outputs` of the scope are the nodes, then "fused".
  virtual void declare(SignalScope& /*scope*/) {}
  virtual void publish(std::span<double> values) const { static_cast<void>(values); }
  /// Constants of the design by the names of the contract, section 6.
  virtual Json design() const { return Json::object(); }
  virtual std::vector<OwnMetric> metrics() const { return {}; }
  /// Sentences of the specification's section 6.
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// The model that the lane's filters share: A, Q as the process noise (B = I), every sensor's C and R, prior mean, P0
/// (empty where the lane starts in its stationary law). Throws InputError (pointer "") where plant or a sensor is not
/// linear.
FusionModel fusion_model(const Knowledge& knowledge);

}  // namespace vigil::privacy

namespace vigil {
/// Throws InputError with pointers relative to the protection's params.
using ProtectionMake = std::unique_ptr<privacy::Protection> (*)(const Params& params, const Knowledge& knowledge);
}  // namespace vigil
