/// The model in the form that runs: x+ = A x + B [u; 1] + w, y = C x + v.
#pragma once

#include <Eigen/Core>

#include "engine/identify/arx.hpp"

namespace vigil::identify {

/// The state is the last `order` rows of outputs, newest first; C picks the newest. The last column of B is the
/// constant: the effect of an input that is always one.
struct StateSpace {
  Eigen::MatrixXd A, B, C;
  Eigen::MatrixXd Q;     ///< of w, states x states, semidefinite: no noise reaches the older rows
  Eigen::VectorXd R;     ///< variances of v, one an output, above zero
  Eigen::VectorXd mean;  ///< of the recorded states
  Eigen::MatrixXd P0;    ///< their covariance
};

/// reading_share: which share of each residual's variance is laid to the reading (R), in (0, 0.45]. The rest is Q, so
/// that a steady filter's innovation has the covariance of the residuals: Q = S - R - sum A_i R A_i', made
/// semidefinite.
StateSpace state_space(const Arx& model, const Records& records, const Eigen::MatrixXd& residuals,
                       double reading_share);

}  // namespace vigil::identify
