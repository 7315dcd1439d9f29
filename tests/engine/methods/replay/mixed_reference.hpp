/// Section 4.5 of the specification (replay) again, independently: dense inverses in extended precision, and a search
/// over the gain itself that knows neither sigma nor K(sigma).
#pragma once

#include <Eigen/Core>
#include <utility>

#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil::replay::reference {

using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

struct Problem {
  Eigen::MatrixXd C, R, Mv, Qp, Mp;
  double mu = 0.5;
};

/// From and to the precision of what is tested.
Long extended(const Eigen::MatrixXd& M);
Eigen::MatrixXd rounded(const Long& M);
/// |ours - expected|, Frobenius, and |expected|.
double distance(const Eigen::MatrixXd& ours, const Long& expected);
double size(const Long& M);

/// n states, p channels, definite matrices of all sizes.
Problem random_problem(RandomMatrices& random, int n, int p);

/// K(sigma) = W C'(C W C' + S)^-1, the inverse written out; with more channels than states its equal (W^-1 + C'S^-1
/// C)^-1 C'S^-1, since the first loses all digits there for a small sigma.
Long gain(const Problem& problem, long double sigma);

/// tr X Mp X' and tr K Mv K'.
std::pair<long double, long double> traces(const Problem& problem, const Long& K);

long double slope(const Problem& problem, long double sigma);

/// J of a gain with a given sigma, and with the best one: the least trace of the sum.
long double stochastic_cost(const Problem& problem, const Long& K);
long double cost(const Problem& problem, const Long& K, long double sigma);
long double least_cost(const Problem& problem, const Long& K);

/// The two sets after an update with this gain: X Qp X' + K R K' and (1 + zeta) X Mp X' + (1 + 1/zeta) K Mv K'.
Long covariance(const Problem& problem, const Long& K);
Long shape(const Problem& problem, const Long& K, long double zeta);

/// The root of `slope` between the two ends, by halving.
long double best_sigma(const Problem& problem, long double low, long double high);

/// The least of `least_cost` that random directions from K find, with steps that shrink and grow. The cost is convex in
/// K: where nothing lower lies near, nothing lower lies anywhere.
long double searched_cost(const Problem& problem, Long K, RandomMatrices& random, int tries = 1500);

}  // namespace vigil::replay::reference
