/// The solvers of a window as the specification of seed 001 words them, step by step and without regard for cost.
#pragma once

#include <functional>
#include <vector>

#include "tests/engine/methods/sparse/windows.hpp"

namespace vigil::windows {

/// Section 8 for a Gram matrix M and b = M r.
struct LiteralOmp {
  Eigen::VectorXd E;
  std::vector<int> support;  ///< in the order picked
  double residual = 0;       ///< of the vector b
};

/// Picks until `picks` are chosen or `remaining(E)` is at most `eps`.
LiteralOmp literal_omp(const Eigen::MatrixXd& M, const Eigen::VectorXd& b, int picks, double eps,
                       const std::function<double(const Eigen::VectorXd& E)>& remaining);

/// Section 11, A4.
Eigen::VectorXd literal_gradient(const Plain& w, int q, double nu, int most_steps, bool block);

/// Section 12, the extension: every set of channels of growing size, by a dense least squares each.
struct LiteralChannels {
  Eigen::VectorXd E;  ///< before the floor
  std::vector<int> channels;
};

LiteralChannels literal_channels(const Eigen::MatrixXd& M, const Eigen::VectorXd& r, int q, double eps);

/// The least ||r - Phi x||_1 over all x, which is the least ||E||_1 that explains the window: some x that meets n of
/// the rows attains it, so every n rows are tried.
double least_l1(const Plain& w);

}  // namespace vigil::windows
