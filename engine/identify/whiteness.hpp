/// Are residuals white? Ljung and Box, "On a measure of lack of fit in time series models", Biometrika 65, 1978.
#pragma once

#include <Eigen/Core>

namespace vigil::identify {

struct Whiteness {
  double statistic = 0;
  int lags = 0;
  int degrees = 0;  ///< lags minus what was fitted
  double p = 1;     ///< probability of a larger statistic if they are white; NaN where it cannot be said
};

/// Q = n (n + 2) sum_h r_h² / (n - h) of one output's residuals, h = 1 to lags, against chi-square with lags - fitted
/// degrees of freedom. NaN entries are left out, with the pairs they belong to.
Whiteness ljung_box(const Eigen::Ref<const Eigen::VectorXd>& residuals, int lags, int fitted);

}  // namespace vigil::identify
