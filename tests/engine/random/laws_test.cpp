/// Every law against its distribution function. Seeds are fixed, so a test passes or fails for ever; the bounds are
/// what chance alone would break once in 10 000 laws (Kolmogorov-Smirnov: sqrt(n) D < 2.23) or once in 100 000 (moments
/// and tails: 4.5 standard errors).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/linalg/chi_square.hpp"
#include "engine/random/draws.hpp"

namespace vigil::laws_test {
namespace {

constexpr int kDraws = 100'000;
constexpr double kKolmogorov = 2.23;
constexpr double kErrors = 4.5;

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

std::vector<double> sample(const std::function<double(std::int64_t)>& draw) {
  std::vector<double> values(kDraws);
  for (int i = 0; i < kDraws; ++i) values[static_cast<std::size_t>(i)] = draw(i);
  return values;
}

/// sqrt(n) times the largest distance between the sample's and the law's distribution functions.
double distance(std::vector<double> values, const std::function<double(double)>& cdf) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double worst = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double p = cdf(values[i]);
    worst = std::max({worst, std::abs(p - static_cast<double>(i) / n), std::abs(static_cast<double>(i + 1) / n - p)});
  }
  return std::sqrt(n) * worst;
}

/// How many standard errors the sample's mean of g is off `expected`.
double errors_off(const std::vector<double>& values, double expected, const std::function<double(double)>& g) {
  double sum = 0, square = 0;
  for (const double value : values) {
    sum += g(value);
    square += g(value) * g(value);
  }
  const auto n = static_cast<double>(values.size());
  const double mean = sum / n;
  return std::abs(mean - expected) / std::sqrt((square / n - mean * mean) / n);
}

double share_errors_off(const std::vector<double>& values, double limit, double probability) {
  const auto beyond = std::count_if(values.begin(), values.end(), [&](double v) { return v > limit; });
  return std::abs(static_cast<double>(beyond) - kDraws * probability) /
         std::sqrt(kDraws * probability * (1 - probability));
}

struct Law {
  const char* name;
  std::function<double(const Draws&, std::int64_t)> draw;
  std::function<double(double)> cdf;
  double mean, variance;  ///< NaN where there is none
  double tail;            ///< a point whose upper tail is counted
};

double student1(double t) { return 0.5 + std::atan(t) / std::numbers::pi; }
double student4(double t) {
  const double u = t / std::sqrt(4 + t * t);
  return 0.5 + 0.75 * (u - u * u * u / 3);
}

double laplace_cdf(double x, double scale) {
  return x < 0 ? 0.5 * std::exp(x / scale) : 1 - 0.5 * std::exp(-x / scale);
}
double gamma_cdf(double x, double shape, double scale) { return chi_square_cdf(2 * x / scale, 2 * shape); }

const double kNone = std::nan("");

const std::vector<Law>& laws() {
  static const std::vector<Law> all{
      {"uniform", [](const Draws& d, std::int64_t k) { return d.uniform(k, 0); },
       [](double x) { return std::clamp(x, 0.0, 1.0); }, 0.5, 1 / 12.0, 0.999},
      {"normal_even", [](const Draws& d, std::int64_t k) { return d.normal(k, 0); }, normal_cdf, 0, 1, 3.5},
      {"normal_odd", [](const Draws& d, std::int64_t k) { return d.normal(k, 1); }, normal_cdf, 0, 1, 3.5},
      {"normal_along_index", [](const Draws& d, std::int64_t k) { return d.normal(1, static_cast<std::uint32_t>(k)); },
       normal_cdf, 0, 1, 3.5},
      {"laplace", [](const Draws& d, std::int64_t k) { return d.laplace(k, 0, 2.5); },
       [](double x) { return laplace_cdf(x, 2.5); }, 0, 12.5, 17},
      {"gamma_small", [](const Draws& d, std::int64_t k) { return d.gamma(k, 0, 0.4, 3); },
       [](double x) { return gamma_cdf(x, 0.4, 3); }, 1.2, 3.6, 15},
      {"gamma_one", [](const Draws& d, std::int64_t k) { return d.gamma(k, 0, 1, 1); },
       [](double x) { return gamma_cdf(x, 1, 1); }, 1, 1, 7},
      {"gamma_large", [](const Draws& d, std::int64_t k) { return d.gamma(k, 0, 7.5, 0.5); },
       [](double x) { return gamma_cdf(x, 7.5, 0.5); }, 3.75, 1.875, 9},
      {"student_1", [](const Draws& d, std::int64_t k) { return d.student(k, 0, 1); }, student1, kNone, kNone, 300},
      {"student_4", [](const Draws& d, std::int64_t k) { return d.student(k, 0, 4); }, student4, 0, kNone, 7},
      {"mixture", [](const Draws& d, std::int64_t k) { return d.mixture(k, 0, 0.1, 1, 8); },
       [](double x) { return 0.9 * normal_cdf(x) + 0.1 * normal_cdf(x / 8); }, 0, 0.9 + 6.4, 12},
  };
  return all;
}

class EveryLaw : public testing::TestWithParam<std::size_t> {};

TEST_P(EveryLaw, HasItsDistributionMomentsAndTail) {
  const Law& law = laws()[GetParam()];
  const Draws draws(2026, std::string("law.") + law.name);
  const auto values = sample([&](std::int64_t k) { return law.draw(draws, k); });
  EXPECT_LT(distance(values, law.cdf), kKolmogorov);
  if (!std::isnan(law.mean)) {
    EXPECT_LT(errors_off(values, law.mean, [](double v) { return v; }), kErrors);
  }
  if (!std::isnan(law.variance)) {
    EXPECT_LT(errors_off(values, law.variance, [&](double v) { return (v - law.mean) * (v - law.mean); }), kErrors);
  }
  EXPECT_LT(share_errors_off(values, law.tail, 1 - law.cdf(law.tail)), kErrors);
}

INSTANTIATE_TEST_SUITE_P(Draws, EveryLaw, testing::Range<std::size_t>(0, 11),
                         [](const auto& place) { return laws()[place.param].name; });

TEST(Draws, UniformStaysBelowOne) {
  const Draws draws(3, "u");
  for (std::int64_t k = 0; k < kDraws; ++k) {
    const double u = draws.uniform(k, 0);
    ASSERT_TRUE(u >= 0 && u < 1);
  }
}

TEST(Draws, BernoulliKeepsItsEnds) {
  const Draws draws(3, "b");
  int hits = 0;
  for (std::int64_t k = 0; k < kDraws; ++k) {
    ASSERT_FALSE(draws.bernoulli(k, 0, 0));
    ASSERT_TRUE(draws.bernoulli(k, 0, 1));
    hits += draws.bernoulli(k, 0, 0.037) ? 1 : 0;
  }
  EXPECT_LT(std::abs(hits - kDraws * 0.037), kErrors * std::sqrt(kDraws * 0.037 * 0.963));
}

TEST(Draws, FillTheUnitBall) {
  for (const int size : {1, 2, 3, 5}) {
    const Draws draws(17, "ball." + std::to_string(size));
    Eigen::VectorXd u(size);
    std::vector<double> volumes(kDraws), firsts(kDraws), angles(kDraws);
    for (int k = 0; k < kDraws; ++k) {
      draws.unit_ball(k, u);
      const auto i = static_cast<std::size_t>(k);
      volumes[i] = std::pow(u.norm(), size);
      firsts[i] = u[0];
      angles[i] = size == 2 ? std::atan2(u[1], u[0]) / (2 * std::numbers::pi) + 0.5 : 0;
    }
    EXPECT_LT(distance(volumes, [](double v) { return std::clamp(v, 0.0, 1.0); }), kKolmogorov) << size;
    EXPECT_LT(errors_off(firsts, 0, [](double v) { return v; }), kErrors) << size;
    EXPECT_LT(errors_off(firsts, 1.0 / (size + 2), [](double v) { return v * v; }), kErrors) << size;
    if (size == 2) {
      EXPECT_LT(distance(angles, [](double v) { return v; }), kKolmogorov);
    }
  }
}

/// Streams that differ in one part of their address must not resemble each other.
TEST(Draws, NeighboursAreUncorrelated) {
  const Draws here(1, "sensor.1"), other_seed(2, "sensor.1"), other_name(1, "sensor.2");
  const auto correlation = [](const std::function<double(std::int64_t)>& a,
                              const std::function<double(std::int64_t)>& b) {
    double sum = 0;
    for (std::int64_t k = 0; k < kDraws; ++k) sum += a(k) * b(k);
    return std::abs(sum) / std::sqrt(double{kDraws});
  };
  const auto mine = [&](std::int64_t k) { return here.normal(k, 0); };
  EXPECT_LT(correlation(mine, [&](std::int64_t k) { return other_seed.normal(k, 0); }), kErrors);
  EXPECT_LT(correlation(mine, [&](std::int64_t k) { return other_name.normal(k, 0); }), kErrors);
  EXPECT_LT(correlation(mine, [&](std::int64_t k) { return here.normal(k, 1); }), kErrors);
  EXPECT_LT(correlation(mine, [&](std::int64_t k) { return here.normal(k, 2); }), kErrors);
  EXPECT_LT(correlation(mine, [&](std::int64_t k) { return here.normal(k + 1, 0); }), kErrors);
  EXPECT_LT(correlation(mine, [&](std::int64_t k) { return std::sqrt(12.0) * (here.uniform(k, 0) - 0.5); }), kErrors);
}

}  // namespace
}  // namespace vigil::laws_test
