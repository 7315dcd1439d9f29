#include "engine/methods/observer/simulation.hpp"

#include <limits>

namespace vigil::observer {

Eigen::VectorXd NetworkSimulation::initial(const std::vector<Eigen::VectorXd>& x0) const {
  Eigen::VectorXd state = Eigen::VectorXd::Zero(size());
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < network_.subsystems.size(); ++i) {
    const int n = network_.subsystems[i].n();
    if (i < x0.size()) state.segment(at, n) = x0[i];
    at += n;
  }
  return state;
}

void NetworkSimulation::read_inputs(const std::vector<SubsystemSignals>& signals, double t, double branch,
                                    Eigen::Ref<Eigen::VectorXd> inputs) const {
  Eigen::Index at = 0;
  const auto read = [&](const std::vector<Signal>& kind, int count) {
    for (int entry = 0; entry < count; ++entry, ++at) {
      const auto index = static_cast<std::size_t>(entry);
      inputs[at] = index < kind.size() ? kind[index].value(t, branch) : 0;
    }
  };
  static const SubsystemSignals kSilent;
  for (std::size_t i = 0; i < network_.subsystems.size(); ++i) {
    const Subsystem& s = network_.subsystems[i];
    const SubsystemSignals& of = i < signals.size() ? signals[i] : kSilent;
    read(of.u, s.m());
    read(of.w, s.q());
    read(of.d, s.dd());
    read(of.f, s.g());
  }
}

void NetworkSimulation::derivative(const Eigen::Ref<const Eigen::VectorXd>& state,
                                   const Eigen::Ref<const Eigen::VectorXd>& inputs, Eigen::Ref<Eigen::VectorXd> slope) {
  stacked_.head(size()) = state;
  stacked_.tail(this->inputs()) = inputs;
  slope.noalias() = map_ * stacked_;
  if (!nonlinear_.empty()) add_nonlinearities(slope);
}

void NetworkSimulation::add_nonlinearities(Eigen::Ref<Eigen::VectorXd> slope) {
  argument_.noalias() = arguments_ * stacked_;
  Eigen::Index argument = 0, entry = 0;
  for (int pass = 0; pass < 2; ++pass) {  // of the plant, of its observers
    for (const int i : nonlinear_) {
      const Subsystem& s = network_.subsystems[static_cast<std::size_t>(i)];
      nonlinearity(s, argument_.segment(argument, s.n()), phi_.segment(entry, s.r()));
      argument += s.n();
      entry += s.r();
    }
  }
  slope.noalias() += entrances_ * phi_;
}

bool NetworkSimulation::advance(Eigen::VectorXd& state, double t, double dt, int steps,
                                const std::vector<SubsystemSignals>& signals) {
  const double h = dt / steps;
  for (int step = 0; step < steps; ++step) {
    double read_at = std::numeric_limits<double>::quiet_NaN();  // the middle stages share their inputs
    rk4_.step(state, t + step * h, h, [&](double time, double branch, const Eigen::VectorXd& at, auto slope) {
      if (time != read_at) read_inputs(signals, time, branch, inputs_);
      read_at = time;
      derivative(at, inputs_, slope);
    });
  }
  return state.allFinite();
}

Snapshot NetworkSimulation::snapshot(int subsystem, const Eigen::Ref<const Eigen::VectorXd>& state,
                                     const Eigen::Ref<const Eigen::VectorXd>& inputs) const {
  Eigen::VectorXd stacked(map_.cols());
  stacked << state, inputs;
  const Outputs& out = outputs_[static_cast<std::size_t>(subsystem)];
  return {.x = out.x * stacked,
          .w = out.w * stacked,
          .d = out.d * stacked,
          .f = out.f * stacked,
          .y = out.y * stacked,
          .xhat = out.xhat * stacked,
          .what = out.what * stacked,
          .fhat = out.fhat * stacked,
          .innovation = out.innovation * stacked};
}

}  // namespace vigil::observer
