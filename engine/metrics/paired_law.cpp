#include "engine/metrics/paired_law.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/missing.hpp"

namespace vigil {
namespace {

constexpr std::size_t kExactRanks = 30;

/// The continued fraction of the incomplete beta function, by Lentz.
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  const auto guarded = [](double value) { return std::abs(value) < tiny ? tiny : value; };
  double c = 1, d = 1 / guarded(1 - (a + b) * x / (a + 1)), h = d;
  for (int m = 1; m < 10000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / guarded(1 + even * d);
    c = guarded(1 + even / c);
    h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / guarded(1 + odd * d);
    c = guarded(1 + odd / c);
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-16) break;
  }
  return h;
}

/// ln B(a, 1/2). Where a is large the gamma functions alone are so large that their difference has no digits left:
/// there ln(gamma(a + 1/2) / gamma(a)) is its asymptotic series.
double log_beta_half(double a) {
  const double half = std::lgamma(0.5);
  if (a < 50) return half + std::lgamma(a) - std::lgamma(a + 0.5);
  const double one = 1 / a, cube = one * one * one;
  return half - (0.5 * std::log(a) - one / 8 + cube / 192 - cube * one * one / 640);
}

/// Regularised incomplete beta function I_x(a, b), one of a and b 1/2; `rest` is 1 - x, given apart so that no digit of
/// it is lost.
double regular_beta(double a, double b, double x, double rest) {
  if (x <= 0) return 0;
  if (rest <= 0) return 1;
  const double log_x = rest < 0.5 ? std::log1p(-rest) : std::log(x);
  const double log_rest = x < 0.5 ? std::log1p(-x) : std::log(rest);
  const double scale = std::exp(a * log_x + b * log_rest - log_beta_half(a == 0.5 ? b : a));
  if (x < (a + 1) / (a + b + 2)) return scale * beta_fraction(a, b, x) / a;
  return 1 - scale * beta_fraction(b, a, rest) / b;
}

/// P(T > t), t >= 0: small values keep all their digits.
double upper_tail(double t, double degrees) {
  if (std::isinf(t)) return 0;
  const double whole = degrees + t * t;
  return 0.5 * regular_beta(degrees / 2, 0.5, degrees / whole, t * t / whole);
}

struct Ranked {
  double size = 0;
  bool positive = false;
  std::size_t twice_rank = 0;  ///< of equal sizes the mean, hence twice
};

std::vector<Ranked> ranked(std::span<const double> differences) {
  std::vector<Ranked> all;
  for (const double d : differences) {
    if (d != 0 && std::isfinite(d)) all.push_back({std::abs(d), d > 0, 0});
  }
  std::sort(all.begin(), all.end(), [](const Ranked& a, const Ranked& b) { return a.size < b.size; });
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].size == all[i].size) ++end;
    for (std::size_t j = i; j < end; ++j) all[j].twice_rank = i + 1 + end;
    i = end;
  }
  return all;
}

/// Every sign is as likely as its opposite: the law of the sum is that of a sum of independent halves.
double exact_p(const std::vector<Ranked>& all, std::size_t sum) {
  std::size_t most = 0;
  for (const Ranked& one : all) most += one.twice_rank;
  std::vector<double> share(most + 1, 0.0);
  share[0] = 1;
  for (const Ranked& one : all) {
    for (std::size_t s = most + 1; s-- > 0;) {
      share[s] = 0.5 * share[s] + (s >= one.twice_rank ? 0.5 * share[s - one.twice_rank] : 0);
    }
  }
  double below = 0, above = 0;
  for (std::size_t s = 0; s <= most; ++s) {
    if (s <= sum) below += share[s];
    if (s >= sum) above += share[s];
  }
  return std::min(1.0, 2 * std::min(below, above));
}

double normal_p(const std::vector<Ranked>& all, std::size_t sum) {
  double mean = 0, variance = 0;
  for (const Ranked& one : all) {
    const double rank = 0.5 * static_cast<double>(one.twice_rank);
    mean += 0.5 * rank;
    variance += 0.25 * rank * rank;  // mean ranks: this is the tie correction
  }
  const double distance = std::max(0.0, std::abs(0.5 * static_cast<double>(sum) - mean) - 0.5);
  return std::erfc(distance / std::sqrt(2 * variance));
}

}  // namespace

double student_cdf(double t, double degrees) {
  if (std::isnan(t) || !(degrees > 0)) return kMissing;
  return t < 0 ? upper_tail(-t, degrees) : 1 - upper_tail(t, degrees);
}

double student_quantile(double p, double degrees) {
  if (!(p > 0 && p < 1) || !(degrees > 0)) return kMissing;
  if (p == 0.5) return 0;
  const double tail = std::min(p, 1 - p);
  double low = 0, high = 1;
  while (upper_tail(high, degrees) > tail && high < 1e300) high *= 2;
  for (int i = 0; i < 2000 && high - low > 1e-14 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (upper_tail(middle, degrees) > tail ? low : high) = middle;
  }
  const double t = 0.5 * (low + high);
  return p < 0.5 ? -t : t;
}

double signed_rank_p(std::span<const double> differences) {
  const std::vector<Ranked> all = ranked(differences);
  if (all.empty()) return kMissing;
  std::size_t sum = 0;
  for (const Ranked& one : all) sum += one.positive ? one.twice_rank : 0;
  return all.size() <= kExactRanks ? exact_p(all, sum) : normal_p(all, sum);
}

}  // namespace vigil
