/// Least squares of several outputs on the same regressors, with a constant; ridge where regressors say the same.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace vigil::identify {

struct Regression {
  Eigen::MatrixXd weights;   ///< outputs x regressors
  Eigen::VectorXd constant;  ///< outputs
  std::vector<int> flat;     ///< regressors that never change: their weight is zero, the constant has their effect
  double ridge = 0;          ///< added to the correlations of the standardised regressors; 0: none was needed
};

/// Minimises |Y - Z W' - c|² over the rows, plus ridge |W S|² where the correlations of Z are worse conditioned than
/// 1e8 (S: the regressors' standard deviations). Z: rows x regressors, Y: rows x outputs, all finite, at least one row.
Regression regress(const Eigen::MatrixXd& Z, const Eigen::MatrixXd& Y);

}  // namespace vigil::identify
