/// The stacked linear maps of plant and observers.
#include <algorithm>
#include <cmath>

#include "engine/methods/observer/matched.hpp"
#include "engine/methods/observer/simulation.hpp"

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

double fastest_of(const Matrix& M) {
  double fastest = 0;
  for (const auto& pole : poles(M)) fastest = std::max(fastest, std::abs(pole));
  return fastest;
}

}  // namespace

/// Every quantity is a matrix of rows over [state; inputs]: sums and products of them are the equations as printed.
class SimulationBuilder {
 public:
  /// states: of every subsystem's observer.
  SimulationBuilder(const Network& network, std::vector<int> states) : states_(std::move(states)) {
    sim_.network_ = network;
    int state = 0, input = 0;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      plant_.push_back(state);
      state += part(i).n();
    }
    for (std::size_t i = 0; i < states_.size(); ++i) {
      observer_.push_back(state);
      state += states_[i];
    }
    for (std::size_t i = 0; i < states_.size(); ++i) {
      input_.push_back(state + input);
      input += part(i).m() + part(i).q() + part(i).dd() + part(i).g();
    }
    columns_ = state + input;
    sim_.map_ = Matrix::Zero(state, columns_);
    sim_.outputs_.resize(states_.size());
  }

  const Subsystem& part(std::size_t i) const { return sim_.network_.subsystems[i]; }
  NetworkSimulation::Outputs& out(std::size_t i) { return sim_.outputs_[i]; }
  Matrix rows(int first, int count) const {
    Matrix chosen = Matrix::Zero(count, columns_);
    chosen.block(0, first, count, count).setIdentity();
    return chosen;
  }
  Matrix u(std::size_t i) const { return rows(input_[i], part(i).m()); }
  Matrix own(std::size_t i, int first, int count) const { return rows(observer_[i] + first, count); }
  void slope(std::size_t i, int first, const Matrix& M) { sim_.map_.middleRows(observer_[i] + first, M.rows()) = M; }

  /// alpha_i sum_j M_ij of(j).
  template <class Block, class Of>
  Matrix coupled(std::size_t i, int height, Block block, Of of) const {
    Matrix sum = Matrix::Zero(height, columns_);
    for (const Coupling& one : sim_.network_.couplings) {
      if (static_cast<std::size_t>(one.to) != i) continue;
      sum += part(i).alpha * (block(one) * of(static_cast<std::size_t>(one.from)));
    }
    return sum;
  }

  /// Eq. (1), for every subsystem.
  void plant() {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Subsystem& s = part(i);
      int at = input_[i] + s.m();
      out(i).x = rows(plant_[i], s.n());
      out(i).w = rows(at, s.q());
      out(i).d = rows(at += s.q(), s.dd());
      out(i).f = rows(at += s.dd(), s.g());
      out(i).y = s.C * out(i).x + s.G * out(i).f;
    }
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Subsystem& s = part(i);
      const Matrix drawn = coupled(
          i, s.n(), [](const Coupling& one) -> const Matrix& { return one.H; },
          [&](std::size_t j) { return out(j).x; });
      sim_.map_.middleRows(plant_[i], s.n()) = s.A * out(i).x + s.B * u(i) + s.D * out(i).w + s.Dd * out(i).d - drawn;
    }
  }

  /// entrance: what Phi(xhat_i) adds to the slope of observer i, for every subsystem.
  void nonlinearities(const std::vector<Matrix>& entrances) {
    int arguments = 0, entries = 0;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (part(i).r() == 0) continue;
      sim_.nonlinear_.push_back(static_cast<int>(i));
      arguments += part(i).n();
      entries += part(i).r();
    }
    sim_.arguments_ = Matrix::Zero(2 * arguments, columns_);
    sim_.entrances_ = Matrix::Zero(sim_.map_.rows(), 2 * entries);
    int argument = 0, entry = 0;
    for (const int index : sim_.nonlinear_) {
      const auto i = static_cast<std::size_t>(index);
      const int n = part(i).n(), r = part(i).r();
      sim_.arguments_.middleRows(argument, n) = out(i).x;
      sim_.arguments_.middleRows(arguments + argument, n) = out(i).xhat;
      sim_.entrances_.block(plant_[i], entry, n, r) = part(i).F;
      sim_.entrances_.block(observer_[i], entries + entry, states_[i], r) = entrances[i];
      argument += n;
      entry += r;
    }
  }

  NetworkSimulation finish(double fastest_of_observers) {
    const int plant_states = observer_.empty() ? 0 : observer_.front();
    sim_.fastest_ = std::max(fastest_of_observers, fastest_of(sim_.map_.topLeftCorner(plant_states, plant_states)));
    sim_.stacked_ = Eigen::VectorXd::Zero(columns_);
    sim_.argument_ = Eigen::VectorXd::Zero(sim_.arguments_.rows());
    sim_.phi_ = Eigen::VectorXd::Zero(sim_.entrances_.cols());
    sim_.inputs_ = Eigen::VectorXd::Zero(sim_.inputs());
    sim_.rk4_ = Rk4(sim_.map_.rows());
    return std::move(sim_);
  }

 private:
  NetworkSimulation sim_;
  std::vector<int> states_, plant_, observer_, input_;
  int columns_ = 0;
};

NetworkSimulation NetworkSimulation::intermediate(const Network& network, const Gains& gains) {
  std::vector<int> states;
  std::vector<Augmented> augmented;
  for (const Subsystem& s : network.subsystems) {
    states.push_back(s.size());
    augmented.push_back(augment(s));
  }
  SimulationBuilder build(network, states);
  build.plant();
  std::vector<Matrix> xi1hat, entrances;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Subsystem& s = build.part(i);
    const int xi = s.n() + s.g();
    const Augmented& a = augmented[i];
    Outputs& out = build.out(i);
    xi1hat.push_back(build.own(i, 0, xi) + a.E2 * out.y);  // (12)
    out.xhat = xi1hat[i].topRows(s.n());
    out.fhat = xi1hat[i].bottomRows(s.g());
    out.what = build.own(i, xi, s.q()) + a.N * build.own(i, 0, xi);  // (11)
    out.innovation = out.y - a.C1 * xi1hat[i];                       // (13)
    entrances.emplace_back(s.size(), s.r());
    entrances[i] << a.F2, -a.N * a.F2;
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Subsystem& s = build.part(i);
    const int xi = s.n() + s.g();
    const Augmented& a = augmented[i];
    const Outputs& out = build.out(i);
    const Matrix core = a.A2 * xi1hat[i] + a.B2 * build.u(i) + a.D2 * out.what + a.J2 * out.y -
                        build.coupled(
                            i, xi, [&](const Coupling& one) { return augmented_coupling(network, one); },
                            [&](std::size_t j) { return xi1hat[j]; });
    const Matrix driven = s.mu * (gains[i] * out.innovation);
    build.slope(i, 0, core + driven.topRows(xi));               // (9)
    build.slope(i, xi, driven.bottomRows(s.q()) - a.N * core);  // (10)
  }
  build.nonlinearities(entrances);
  return build.finish(fastest_of(global_error_matrix(error_system(network), gains)));
}

NetworkSimulation NetworkSimulation::matched(const Network& network, const Gains& gains) {
  std::vector<int> states;
  std::vector<Matching> matchings;
  for (const Subsystem& s : network.subsystems) {
    states.push_back(s.n() + s.p());
    matchings.push_back(matching(s));
  }
  SimulationBuilder build(network, states);
  build.plant();
  std::vector<Matrix> entrances;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Subsystem& s = build.part(i);
    Outputs& out = build.out(i);
    out.xhat = build.own(i, 0, s.n()) + s.D * matchings[i].inverse * out.y;
    out.innovation = out.y - s.C * out.xhat;
    out.fhat = Matrix::Zero(0, out.y.cols());
    entrances.push_back(Matrix::Zero(states[i], s.r()));
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Subsystem& s = build.part(i);
    Outputs& out = build.out(i);
    const Matrix drift = s.A * out.xhat + s.B * build.u(i) -
                         build.coupled(
                             i, s.n(), [](const Coupling& one) -> const Matrix& { return one.H; },
                             [&](std::size_t j) { return build.out(j).xhat; });
    const Matrix rate = (out.y - build.own(i, s.n(), s.p())) / kDerivativeTime;
    build.slope(i, 0, matchings[i].projection * drift + gains[i] * out.innovation);
    build.slope(i, s.n(), rate);
    out.what = matchings[i].inverse * (rate - s.C * drift);
  }
  build.nonlinearities(entrances);
  return build.finish(
      std::max(1 / kDerivativeTime, fastest_of(global_error_matrix(matched_error_system(network), gains))));
}

}  // namespace vigil::observer
