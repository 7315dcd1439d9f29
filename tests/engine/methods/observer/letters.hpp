/// Theorem 1's unknowns and its left side, written out once more from the paper's letters.
#pragma once

#include <gtest/gtest.h>

#include "engine/methods/observer/certificate.hpp"
#include "tests/engine/methods/observer/networks.hpp"

namespace vigil::observer {

Eigen::VectorXd some_y(const Synthesis& synthesis, int number);

/// Entry-wise, what a subsystem's unknowns are at y: the specification's order.
struct Letters {
  Eigen::MatrixXd P, W;
  double gd2 = 0, gw2 = 0, nu = 0, kappa = 0;
};
std::vector<Letters> letters(const ErrorSystem& system, const Eigen::VectorXd& y, bool free_kappa);

/// Sigma_ii, from the plant's own matrices.
Eigen::MatrixXd printed_diagonal(const Subsystem& s, const ErrorPart& part, const Letters& y);

/// P_i alpha_i Nbar_i H3_ij.
Eigen::MatrixXd printed_coupling(const Network& network, const std::vector<Letters>& all, int i, int j);

/// (17) as printed.
Eigen::MatrixXd printed_sigma(const Network& network, const std::vector<Letters>& all);

/// Relative to b's largest entry; infinite for other sizes.
double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace vigil::observer
