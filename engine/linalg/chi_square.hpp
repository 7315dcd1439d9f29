/// The chi-square law, for gates and consistency bounds.
#pragma once

namespace vigil {

/// P(X <= x) for X ~ chi-square with `degrees` > 0 degrees of freedom (need not be whole). 0 for x <= 0.
double chi_square_cdf(double x, double degrees);

/// The x with P(X <= x) = p, 0 < p < 1, to 1e-12 relative; NaN outside.
double chi_square_quantile(double p, double degrees);

}  // namespace vigil
