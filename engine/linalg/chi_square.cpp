#include "engine/linalg/chi_square.hpp"

#include <cmath>
#include <limits>

namespace vigil {
namespace {

/// Regularised lower incomplete gamma function P(a, x): series below a + 1, Lentz's continued fraction above.
double lower_gamma(double a, double x) {
  if (x <= 0) return 0;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-17; n += 1) sum += term *= x / n;
    return sum * scale;
  }
  constexpr double tiny = 1e-300;
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    const double factor = d * c;
    h *= factor;
    if (std::abs(factor - 1) < 1e-16) break;
  }
  return 1 - h * scale;
}

}  // namespace

double chi_square_cdf(double x, double degrees) { return lower_gamma(degrees / 2, x / 2); }

double chi_square_quantile(double p, double degrees) {
  if (!(p > 0 && p < 1) || !(degrees > 0)) return std::numeric_limits<double>::quiet_NaN();
  double low = 0, high = degrees + 10;
  while (chi_square_cdf(high, degrees) < p) high *= 2;
  // Bisection: sixty halvings are cheap at set-up time and cannot fail.
  for (int i = 0; i < 200 && high - low > 1e-13 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_square_cdf(middle, degrees) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace vigil
