/// The left side of (17) as a function of its unknowns: what the problem is written from and what the certificate is
/// computed from. Specification (observer), section 5.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "engine/methods/observer/synthesis.hpp"

namespace vigil::observer {

/// One subsystem's unknowns; an empty matrix stands for zero.
struct Parts {
  Eigen::MatrixXd P, W;
  double gd2 = 0, gw2 = 0, kappa = 0;
};

/// Rows of a subsystem in Sigma: e, d, w' and Phi.
int sigma_order(const ErrorPart& part);
/// P (Abar + decay I) - mu W Cbar and its transpose.
Eigen::MatrixXd lyapunov_part(const ErrorPart& part, const Parts& parts);
/// Adds the terms of Sigma that are linear in subsystem i's unknowns. first: of every subsystem's rows, and the end.
void add_sigma(const ErrorSystem& system, std::size_t i, const Parts& parts, const std::vector<int>& first,
               Eigen::MatrixXd& sigma);
/// Adds the identity on the rows of e.
void add_sigma_constant(const ErrorPart& part, int first, Eigen::MatrixXd& sigma);

/// Row and column of every unknown of P_i in y, in order.
std::vector<std::pair<int, int>> places_of_p(const Synthesis& synthesis, std::size_t i);

}  // namespace vigil::observer
