/// The stacked linear maps of the observers.
#include <algorithm>
#include <cmath>

#include "engine/methods/observer/matched.hpp"
#include "engine/methods/observer/stacked.hpp"

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

double fastest_of(const Matrix& M) {
  double fastest = 0;
  for (const auto& pole : poles(M)) fastest = std::max(fastest, std::abs(pole));
  return fastest;
}

}  // namespace

/// Every quantity is a matrix of rows over [z; y; u]: sums and products of them are the equations as printed.
class ObserverBuilder {
 public:
  /// states: of every subsystem's observer.
  ObserverBuilder(const Network& network, std::vector<int> states) : network_(network), states_(std::move(states)) {
    made_.subsystems_ = network.subsystems;
    int at = 0;
    for (const int count : states_) {
      own_.push_back(at);
      at += count;
    }
    const int size = at;
    for (const Subsystem& s : network.subsystems) {
      output_.push_back(at);
      at += s.p();
    }
    made_.outputs_y_ = at - size;
    for (const Subsystem& s : network.subsystems) {
      input_.push_back(at);
      at += s.m();
    }
    columns_ = at;
    made_.slope_ = Matrix::Zero(size, columns_);
    made_.rows_.resize(states_.size());
  }

  const Subsystem& part(std::size_t i) const { return made_.subsystems_[i]; }
  StackedObserver::Rows& out(std::size_t i) { return made_.rows_[i]; }
  Matrix rows(int first, int count) const {
    Matrix chosen = Matrix::Zero(count, columns_);
    chosen.block(0, first, count, count).setIdentity();
    return chosen;
  }
  Matrix y(std::size_t i) const { return rows(output_[i], part(i).p()); }
  Matrix u(std::size_t i) const { return rows(input_[i], part(i).m()); }
  Matrix own(std::size_t i, int first, int count) const { return rows(own_[i] + first, count); }
  void slope(std::size_t i, int first, const Matrix& M) { made_.slope_.middleRows(own_[i] + first, M.rows()) = M; }

  /// alpha_i sum_j M_ij of(j).
  template <class Block, class Of>
  Matrix coupled(std::size_t i, int height, Block block, Of of) const {
    Matrix sum = Matrix::Zero(height, columns_);
    for (const Coupling& one : network_.couplings) {
      if (static_cast<std::size_t>(one.to) != i) continue;
      sum += part(i).alpha * (block(one) * of(static_cast<std::size_t>(one.from)));
    }
    return sum;
  }

  /// entrance: what Phi(xhat_i) adds to the slope of observer i, for every subsystem.
  void nonlinearities(const std::vector<Matrix>& entrances) {
    int arguments = 0, entries = 0;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (part(i).r() == 0 || entrances[i].isZero(0)) continue;
      made_.nonlinear_.push_back(static_cast<int>(i));
      arguments += part(i).n();
      entries += part(i).r();
    }
    made_.arguments_ = Matrix::Zero(arguments, columns_);
    made_.entrances_ = Matrix::Zero(made_.slope_.rows(), entries);
    int argument = 0, entry = 0;
    for (const int index : made_.nonlinear_) {
      const auto i = static_cast<std::size_t>(index);
      made_.arguments_.middleRows(argument, part(i).n()) = out(i).xhat;
      made_.entrances_.block(own_[i], entry, states_[i], part(i).r()) = entrances[i];
      argument += part(i).n();
      entry += part(i).r();
    }
  }

  StackedObserver finish(double fastest) {
    made_.fastest_ = fastest;
    made_.stacked_ = Eigen::VectorXd::Zero(columns_);
    made_.argument_ = Eigen::VectorXd::Zero(made_.arguments_.rows());
    made_.phi_ = Eigen::VectorXd::Zero(made_.entrances_.cols());
    return std::move(made_);
  }

 private:
  StackedObserver made_;
  const Network& network_;
  std::vector<int> states_, own_, output_, input_;
  int columns_ = 0;
};

StackedObserver StackedObserver::intermediate(const Network& network, const Gains& gains) {
  std::vector<int> states;
  std::vector<Augmented> augmented;
  for (const Subsystem& s : network.subsystems) {
    states.push_back(s.size());
    augmented.push_back(augment(s));
  }
  ObserverBuilder build(network, states);
  std::vector<Matrix> xi1hat, entrances;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Subsystem& s = build.part(i);
    const int xi = s.n() + s.g();
    const Augmented& a = augmented[i];
    Rows& out = build.out(i);
    xi1hat.push_back(build.own(i, 0, xi) + a.E2 * build.y(i));  // (12)
    out.xhat = xi1hat[i].topRows(s.n());
    out.fhat = xi1hat[i].bottomRows(s.g());
    out.what = build.own(i, xi, s.q()) + a.N * build.own(i, 0, xi);  // (11)
    out.innovation = build.y(i) - a.C1 * xi1hat[i];                  // (13)
    entrances.emplace_back(s.size(), s.r());
    entrances[i] << a.F2, -a.N * a.F2;
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Subsystem& s = build.part(i);
    const int xi = s.n() + s.g();
    const Augmented& a = augmented[i];
    const Rows& out = build.out(i);
    const Matrix core = a.A2 * xi1hat[i] + a.B2 * build.u(i) + a.D2 * out.what + a.J2 * build.y(i) -
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

StackedObserver StackedObserver::matched(const Network& network, const Gains& gains) {
  std::vector<int> states;
  std::vector<Matching> matchings;
  for (const Subsystem& s : network.subsystems) {
    states.push_back(s.n() + s.p());
    matchings.push_back(matching(s));
  }
  ObserverBuilder build(network, states);
  std::vector<Matrix> entrances;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Subsystem& s = build.part(i);
    Rows& out = build.out(i);
    out.xhat = build.own(i, 0, s.n()) + s.D * matchings[i].inverse * build.y(i);
    out.innovation = build.y(i) - s.C * out.xhat;
    out.fhat = Matrix::Zero(0, out.xhat.cols());
    entrances.push_back(Matrix::Zero(states[i], s.r()));
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Subsystem& s = build.part(i);
    Rows& out = build.out(i);
    const Matrix drift = s.A * out.xhat + s.B * build.u(i) -
                         build.coupled(
                             i, s.n(), [](const Coupling& one) -> const Matrix& { return one.H; },
                             [&](std::size_t j) { return build.out(j).xhat; });
    const Matrix rate = (build.y(i) - build.own(i, s.n(), s.p())) / kDerivativeTime;
    build.slope(i, 0, matchings[i].projection * drift + gains[i] * out.innovation);
    build.slope(i, s.n(), rate);
    out.what = matchings[i].inverse * (rate - s.C * drift);
  }
  build.nonlinearities(entrances);
  return build.finish(
      std::max(1 / kDerivativeTime, fastest_of(global_error_matrix(matched_error_system(network), gains))));
}

}  // namespace vigil::observer
