/// The two laws that paired differences are judged by: Student's t and Wilcoxon's signed ranks.
#pragma once

#include <span>

namespace vigil {

/// P(T <= t) for Student's t with `degrees` > 0 degrees of freedom (need not be whole).
double student_cdf(double t, double degrees);

/// The t with P(T <= t) = p, 0 < p < 1, to 1e-12 relative; NaN outside.
double student_quantile(double p, double degrees);

/// Two-sided p of Wilcoxon's signed-rank test that the differences are symmetric about 0. Zeros are left out, equal
/// sizes share their mean rank. Exact up to 30 differences (the law of the ranks that are there), the normal
/// approximation with continuity and tie correction beyond. NaN where no difference is left.
double signed_rank_p(std::span<const double> differences);

}  // namespace vigil
