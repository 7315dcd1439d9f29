#include "tests/engine/methods/replay/mixed_reference.hpp"

#include <Eigen/LU>
#include <cmath>

namespace vigil::replay::reference {
namespace {

// Few kinds of expression: each costs seconds to compile in this precision.

Long product(const Long& X, const Long& Y) { return X * Y; }

Long inverse(const Long& M) { return M.inverse(); }

/// X M X'.
Long sandwich(const Long& X, const Long& M) { return product(product(X, M), X.transpose()); }

/// X = I - K C.
Long remaining(const Problem& problem, const Long& K) {
  return Long::Identity(K.rows(), K.rows()) - product(K, extended(problem.C));
}

}  // namespace

Long extended(const Eigen::MatrixXd& M) { return M.cast<long double>(); }

Eigen::MatrixXd rounded(const Long& M) { return M.cast<double>(); }

double distance(const Eigen::MatrixXd& ours, const Long& expected) { return (ours - rounded(expected)).norm(); }

double size(const Long& M) { return static_cast<double>(M.norm()); }

Long covariance(const Problem& problem, const Long& K) {
  const Long X = remaining(problem, K);
  return sandwich(X, extended(problem.Qp)) + sandwich(K, extended(problem.R));
}

Long shape(const Problem& problem, const Long& K, long double zeta) {
  const Long X = remaining(problem, K);
  return (1 + zeta) * sandwich(X, extended(problem.Mp)) + (1 + 1 / zeta) * sandwich(K, extended(problem.Mv));
}

Problem random_problem(RandomMatrices& random, int n, int p) {
  const auto size = [&] { return random.log_uniform(0.03, 30); };
  Problem problem;
  problem.C = random.gaussian(p, n);
  problem.R = size() * random.definite(p);
  problem.Mv = size() * random.definite(p);
  problem.Qp = size() * random.definite(n);
  problem.Mp = size() * random.definite(n);
  problem.mu = 0.9 * random.uniform();
  return problem;
}

Long gain(const Problem& problem, long double sigma) {
  const long double mu = problem.mu;
  const Long C = extended(problem.C);
  const Long W = mu * extended(problem.Qp) + (1 - mu) / sigma * extended(problem.Mp);
  const Long S = mu * extended(problem.R) + (1 - mu) / (1 - sigma) * extended(problem.Mv);
  if (C.rows() <= C.cols()) return product(product(W, C.transpose()), inverse(sandwich(C, W) + S));
  const Long weighted = product(C.transpose(), inverse(S));
  return product(inverse(inverse(W) + product(weighted, C)), weighted);
}

std::pair<long double, long double> traces(const Problem& problem, const Long& K) {
  const Long X = remaining(problem, K);
  return {sandwich(X, extended(problem.Mp)).trace(), sandwich(K, extended(problem.Mv)).trace()};
}

long double slope(const Problem& problem, long double sigma) {
  const auto [prediction, sensor] = traces(problem, gain(problem, sigma));
  return sensor / ((1 - sigma) * (1 - sigma)) - prediction / (sigma * sigma);
}

long double stochastic_cost(const Problem& problem, const Long& K) { return covariance(problem, K).trace(); }

long double cost(const Problem& problem, const Long& K, long double sigma) {
  const auto [prediction, sensor] = traces(problem, K);
  return problem.mu * stochastic_cost(problem, K) + (1 - problem.mu) * (prediction / sigma + sensor / (1 - sigma));
}

long double least_cost(const Problem& problem, const Long& K) {
  const auto [prediction, sensor] = traces(problem, K);
  const long double reach = std::sqrt(prediction) + std::sqrt(sensor);
  return problem.mu * stochastic_cost(problem, K) + (1 - problem.mu) * reach * reach;
}

long double best_sigma(const Problem& problem, long double low, long double high) {
  for (int halving = 0; halving < 120; ++halving) {
    const long double middle = (low + high) / 2;
    (slope(problem, middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

long double searched_cost(const Problem& problem, Long K, RandomMatrices& random, int tries) {
  long double best = least_cost(problem, K), step = 0.3L * (K.norm() + 1);
  for (int trial = 0; trial < tries; ++trial) {
    const Long direction = extended(random.gaussian(K.rows(), K.cols()));
    bool better = false;
    for (const long double side : {step, -step}) {
      const Long next = K + side * direction;
      const long double value = least_cost(problem, next);
      if (value >= best) continue;
      best = value;
      K = next;
      better = true;
      break;
    }
    step *= better ? 1.6L : 0.85L;
    if (step < 1e-12L) step = 1e-3L;
  }
  return best;
}

}  // namespace vigil::replay::reference
