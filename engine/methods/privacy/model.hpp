/// The linear plants of seed 004 and the sensors that watch them, as data. Specification (privacy), sections 1.2, 2.5,
/// 3.4 and 4.7.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace vigil::privacy {

struct SensorModel {
  Eigen::MatrixXd C;  ///< m x n
  Eigen::MatrixXd R;  ///< m x m, positive definite
};

/// x+ = A x + B w, y_i = C_i x + v_i; w ~ N(0, Q), v_i ~ N(0, R_i), all white and independent.
struct FusionModel {
  Eigen::MatrixXd A, B, Q;
  std::vector<SensorModel> sensors;
  Eigen::VectorXd x0;
  Eigen::MatrixXd P0;  ///< empty where the local filters start in their stationary error law

  int states() const { return static_cast<int>(A.rows()); }
  int count() const { return static_cast<int>(sensors.size()); }
  int stacked() const { return states() * count(); }
  Eigen::MatrixXd noise() const { return B * Q * B.transpose(); }  ///< Qb, n x n
};

/// (2-44)-(2-46): position and velocity, both seen by both sensors; step in s.
FusionModel linear_robot(double step = 1);
/// (3-34)-(3-36): position and velocity in a plane, turning at `rate` rad/s; step in s.
FusionModel turning_target(double rate = 0.1, double step = 1);
/// (4-30)-(4-32): three deviations of an engine's state, one noise input.
FusionModel engine_model();

/// e = [I; ...; I], (n count) x n.
Eigen::MatrixXd stack(int n, int count);
/// The blocks one below the other along the diagonal, zero elsewhere.
Eigen::MatrixXd block_diagonal(const std::vector<Eigen::MatrixXd>& blocks);
/// The blocks one below the other; all of the same width.
Eigen::MatrixXd column_of(const std::vector<Eigen::MatrixXd>& blocks);

}  // namespace vigil::privacy
