/// Section 4.5 of the specification (replay) again, independently: dense inverses in extended precision, and a search
/// over the gain itself that knows neither sigma nor K(sigma).
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil::replay::reference {

using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

struct Problem {
  Eigen::MatrixXd C, R, Mv, Qp, Mp;
  double mu = 0.5;
};

/// n states, p channels, definite matrices of all sizes.
inline Problem random_problem(RandomMatrices& random, int n, int p) {
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

/// K(sigma) = W C'(C W C' + S)^-1, the inverse written out; with more channels than states its equal (W^-1 + C'S^-1
/// C)^-1 C'S^-1, since the first loses all digits there for a small sigma.
inline Long gain(const Problem& problem, long double sigma) {
  const long double mu = problem.mu;
  const Long C = problem.C.cast<long double>();
  const Long W = mu * problem.Qp.cast<long double>() + (1 - mu) / sigma * problem.Mp.cast<long double>();
  const Long S = mu * problem.R.cast<long double>() + (1 - mu) / (1 - sigma) * problem.Mv.cast<long double>();
  if (C.rows() <= C.cols()) return W * C.transpose() * (C * W * C.transpose() + S).inverse();
  const Long weighted = C.transpose() * S.inverse();
  return (W.inverse() + weighted * C).inverse() * weighted;
}

/// tr X Mp X' and tr K Mv K'.
inline std::pair<long double, long double> traces(const Problem& problem, const Long& K) {
  const Long X = Long::Identity(K.rows(), K.rows()) - K * problem.C.cast<long double>();
  return {(X * problem.Mp.cast<long double>() * X.transpose()).trace(),
          (K * problem.Mv.cast<long double>() * K.transpose()).trace()};
}

inline long double slope(const Problem& problem, long double sigma) {
  const auto [prediction, sensor] = traces(problem, gain(problem, sigma));
  return sensor / ((1 - sigma) * (1 - sigma)) - prediction / (sigma * sigma);
}

/// J of a gain with a given sigma, and with the best one: the least trace of the sum.
inline long double stochastic_cost(const Problem& problem, const Long& K) {
  const Long X = Long::Identity(K.rows(), K.rows()) - K * problem.C.cast<long double>();
  return (X * problem.Qp.cast<long double>() * X.transpose() + K * problem.R.cast<long double>() * K.transpose())
      .trace();
}
inline long double cost(const Problem& problem, const Long& K, long double sigma) {
  const auto [prediction, sensor] = traces(problem, K);
  return problem.mu * stochastic_cost(problem, K) + (1 - problem.mu) * (prediction / sigma + sensor / (1 - sigma));
}
inline long double least_cost(const Problem& problem, const Long& K) {
  const auto [prediction, sensor] = traces(problem, K);
  const long double reach = std::sqrt(prediction) + std::sqrt(sensor);
  return problem.mu * stochastic_cost(problem, K) + (1 - problem.mu) * reach * reach;
}

/// The root of `slope` between the two ends, by halving.
inline long double best_sigma(const Problem& problem, long double low, long double high) {
  for (int halving = 0; halving < 120; ++halving) {
    const long double middle = (low + high) / 2;
    (slope(problem, middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// The least of `least_cost` that random directions from K find, with steps that shrink and grow. The cost is convex in
/// K: where nothing lower lies near, nothing lower lies anywhere.
inline long double searched_cost(const Problem& problem, Long K, RandomMatrices& random, int tries = 1500) {
  long double best = least_cost(problem, K), step = 0.3L * (K.norm() + 1);
  for (int trial = 0; trial < tries; ++trial) {
    const Long direction = random.gaussian(K.rows(), K.cols()).cast<long double>();
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
