/// A plant and one lane's observers as one differential equation, without a run around it: what the engine's plant and
/// observers do together, for tests that look at every moment.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/methods/observer/stacked.hpp"
#include "engine/world/interconnected/plant.hpp"
#include "engine/world/interconnected/rk4.hpp"
#include "engine/world/interconnected/signals.hpp"

namespace vigil::observer {

/// Truth and estimates of one subsystem at one moment.
struct Snapshot {
  Eigen::VectorXd x, w, d, f, y, xhat, what, fhat, innovation;
};

class NetworkSimulation {
 public:
  NetworkSimulation(const Network& network, StackedObserver observer)
      : plant_(network, 1e-3),
        observer_(std::move(observer)),
        rk4_(size()),
        v_(Eigen::VectorXd::Zero(plant_.drives())),
        y_(Eigen::VectorXd::Zero(plant_.outputs())),
        u_(Eigen::VectorXd::Zero(plant_.inputs())) {}
  static NetworkSimulation intermediate(const Network& network, const Gains& gains) {
    return {network, StackedObserver::intermediate(network, gains)};
  }
  static NetworkSimulation matched(const Network& network, const Gains& gains) {
    return {network, StackedObserver::matched(network, gains)};
  }

  int size() const { return plant_.states() + observer_.size(); }
  int inputs() const { return plant_.drives(); }
  double fastest() const { return std::max(plant_.fastest(), observer_.fastest()); }

  /// x0: one a subsystem; observers at zero.
  Eigen::VectorXd initial(const std::vector<Eigen::VectorXd>& x0) const {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(size());
    for (std::size_t i = 0; i < x0.size(); ++i)
      state.segment(plant_.first_state(static_cast<int>(i)), x0[i].size()) = x0[i];
    return state;
  }

  void read_inputs(const std::vector<SubsystemSignals>& signals, double t, double branch,
                   Eigen::Ref<Eigen::VectorXd> v) const {
    v.setZero();
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const DrivePorts& ports = plant_.ports()[i];
      const auto read = [&](const std::vector<Signal>& kind, int first) {
        for (std::size_t c = 0; c < kind.size(); ++c) v[first + static_cast<int>(c)] = kind[c].value(t, branch);
      };
      read(signals[i].u, ports.first);
      read(signals[i].w, ports.at_w());
      read(signals[i].d, ports.at_d());
      read(signals[i].f, ports.at_f());
    }
  }

  void derivative(const Eigen::Ref<const Eigen::VectorXd>& state, const Eigen::Ref<const Eigen::VectorXd>& v,
                  Eigen::Ref<Eigen::VectorXd> slope) {
    const int n = plant_.states();
    plant_.slope(state.head(n), v, slope.head(n));
    hear(state, v);
    observer_.slope(state.tail(observer_.size()), y_, u_, slope.tail(observer_.size()));
  }

  /// False where the state is no longer finite.
  bool advance(Eigen::VectorXd& state, double t, double dt, int steps, const std::vector<SubsystemSignals>& signals) {
    const double h = dt / steps;
    for (int step = 0; step < steps; ++step) {
      rk4_.step(state, t + step * h, h, [&](double time, double branch, const Eigen::VectorXd& at, auto slope) {
        read_inputs(signals, time, branch, v_);
        derivative(at, v_, slope);
      });
    }
    return state.allFinite();
  }

  Snapshot snapshot(int subsystem, const Eigen::Ref<const Eigen::VectorXd>& state,
                    const Eigen::Ref<const Eigen::VectorXd>& v) const {
    hear(state, v);
    observer_.say(state.tail(observer_.size()), y_, u_, said_);
    const auto i = static_cast<std::size_t>(subsystem);
    const DrivePorts& ports = plant_.ports()[i];
    int output = 0;
    for (std::size_t j = 0; j < i; ++j) output += plant_.network().subsystems[j].p();
    return {.x = state.segment(plant_.first_state(subsystem), plant_.network().subsystems[i].n()),
            .w = v.segment(ports.at_w(), ports.w),
            .d = v.segment(ports.at_d(), ports.d),
            .f = v.segment(ports.at_f(), ports.f),
            .y = y_.segment(output, plant_.network().subsystems[i].p()),
            .xhat = said_[i].xhat,
            .what = said_[i].what,
            .fhat = said_[i].fhat,
            .innovation = said_[i].innovation};
  }

 private:
  void hear(const Eigen::Ref<const Eigen::VectorXd>& state, const Eigen::Ref<const Eigen::VectorXd>& v) const {
    plant_.output(state.head(plant_.states()), v, y_);
    Eigen::Index entry = 0;
    for (const DrivePorts& ports : plant_.ports()) {
      for (int c = 0; c < ports.u; ++c) u_[entry++] = v[ports.first + c];
    }
  }

  InterconnectedPlant plant_;
  mutable StackedObserver observer_;  // what a moment says is worked out in its buffers
  Rk4 rk4_;
  Eigen::VectorXd v_;
  mutable Eigen::VectorXd y_, u_;
  mutable std::vector<StackedObserver::Said> said_;
};

}  // namespace vigil::observer
