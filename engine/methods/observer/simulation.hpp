/// A plant and one lane's observers as one differential equation. Specification (observer), sections 3, 7 and 8.2.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/methods/observer/augment.hpp"
#include "engine/world/interconnected/rk4.hpp"
#include "engine/world/interconnected/signals.hpp"

namespace vigil::observer {

/// Truth and estimates of one subsystem at one moment.
struct Snapshot {
  Eigen::VectorXd x, w, d, f, y;     ///< truth, and what is measured
  Eigen::VectorXd xhat, what, fhat;  ///< fhat is empty where the observer has none
  Eigen::VectorXd innovation;        ///< y - C xhat - G fhat
};

/// The stacked state is [every x; every subsystem's observer states]; its linear part and that of the inputs are
/// precomputed, the nonlinearities come on top. A step allocates nothing.
class NetworkSimulation {
 public:
  /// Seed 002, (9)-(13), by gains L = [L1; L2]; observers start at zero.
  static NetworkSimulation intermediate(const Network& network, const Gains& gains);
  /// The matched unknown-input observer; L: n x p. It knows no nonlinearity: for plants without one.
  static NetworkSimulation matched(const Network& network, const Gains& gains);

  int size() const { return static_cast<int>(map_.rows()); }
  /// x0: one a subsystem; observers at zero.
  Eigen::VectorXd initial(const std::vector<Eigen::VectorXd>& x0) const;
  /// The fastest pole of plant and observers, 1/s: for steps_per_tick.
  double fastest() const { return fastest_; }

  /// All inputs stacked: [u w d f] of subsystem 1, of 2, …
  int inputs() const { return static_cast<int>(map_.cols() - map_.rows()); }
  void read_inputs(const std::vector<SubsystemSignals>& signals, double t, double branch,
                   Eigen::Ref<Eigen::VectorXd> inputs) const;
  void derivative(const Eigen::Ref<const Eigen::VectorXd>& state, const Eigen::Ref<const Eigen::VectorXd>& inputs,
                  Eigen::Ref<Eigen::VectorXd> slope);
  /// From t to t + dt in `steps` steps. False where the state is no longer finite: stop, status "diverged".
  bool advance(Eigen::VectorXd& state, double t, double dt, int steps, const std::vector<SubsystemSignals>& signals);

  Snapshot snapshot(int subsystem, const Eigen::Ref<const Eigen::VectorXd>& state,
                    const Eigen::Ref<const Eigen::VectorXd>& inputs) const;

  /// Rows over [state; inputs].
  struct Outputs {
    Eigen::MatrixXd x, w, d, f, y, xhat, what, fhat, innovation;
  };

 private:
  friend class SimulationBuilder;
  NetworkSimulation() = default;
  void add_nonlinearities(Eigen::Ref<Eigen::VectorXd> slope);

  Network network_;
  Eigen::MatrixXd map_;         ///< state' = map [state; inputs] + nonlinearities
  Eigen::MatrixXd arguments_;   ///< every x, then every xhat, of subsystems with a nonlinearity
  Eigen::MatrixXd entrances_;   ///< where their Phi enter the slope
  std::vector<int> nonlinear_;  ///< those subsystems
  std::vector<Outputs> outputs_;
  double fastest_ = 0;
  Eigen::VectorXd stacked_, argument_, phi_, inputs_;
  Rk4 rk4_{0};
};

}  // namespace vigil::observer
