#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/contamination.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMostSets = 20000;
constexpr double kTie = 1e-9;  // relative

/// The first set of the largest score, scores being zero or more.
template <class Score>
const ComponentSet& best(const std::vector<ComponentSet>& sets, Score score) {
  const ComponentSet* chosen = nullptr;
  double most = 0;
  for (const ComponentSet& set : sets) {
    const double value = score(set);
    if (chosen && !(value > most * (1 + kTie))) continue;
    chosen = &set;
    most = value;
  }
  return *chosen;
}

double spectral_norm(const MatrixXd& M) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(M.transpose() * M, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(eigen.eigenvalues()[M.cols() - 1], 0.0));
}

}  // namespace

std::vector<ComponentSet> component_sets(int stacked, int m) {
  if (m < 0 || m > stacked)
    throw InputError("/m", "m is " + std::to_string(m) + "; expected 0 to " + std::to_string(stacked),
                     "0 to " + std::to_string(stacked));
  double number = 1;
  for (int i = 0; i < m; ++i) number *= static_cast<double>(stacked - i) / (i + 1);
  if (number > kMostSets + 0.5)
    throw InputError("/m", "m is " + std::to_string(m) + ", which leaves more than 20000 sets to choose from",
                     "at most 20000 sets");
  ComponentSet set;
  for (int c = 0; c < m; ++c) set.push_back(c);
  std::vector<ComponentSet> sets{set};
  for (;;) {
    int at = m - 1;
    while (at >= 0 && set[static_cast<std::size_t>(at)] == stacked - m + at) --at;
    if (at < 0) return sets;
    int next = set[static_cast<std::size_t>(at)] + 1;
    for (; at < m; ++at) set[static_cast<std::size_t>(at)] = next++;
    sets.push_back(set);
  }
}

const ComponentSet& choose_set(const std::vector<ComponentSet>& sets, Selection mode, const Fusion& nominal,
                               const MatrixXd& P, const MatrixXd& Lam) {
  const auto stacked = static_cast<int>(P.rows());
  if (mode == Selection::exact) {
    return best(sets, [&](const ComponentSet& set) {
      return eavesdropper_covariance(nominal, P, Lam, kept(set, stacked)).trace();
    });
  }
  const MatrixXd Hm = second_moment_gain(nominal, Lam, static_cast<int>(P.rows() / Lam.rows()));
  return best(sets, [&](const ComponentSet& set) {
    MatrixXd rest = -Hm;
    rest.diagonal() += kept(set, stacked);
    return spectral_norm(rest);
  });
}

const ComponentSet& choose_worst_known(const std::vector<ComponentSet>& sets, const MatrixXd& P) {
  const auto stacked = static_cast<int>(P.rows());
  return best(sets, [&](const ComponentSet& set) { return P.diagonal().dot(kept(set, stacked)); });
}

}  // namespace vigil::privacy
