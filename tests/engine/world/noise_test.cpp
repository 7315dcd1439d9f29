/// Noise of plants and sensors. Seeds are fixed, so a test passes or fails for ever; the bounds are what chance alone
/// would break once in 100 000 figures (4.5 standard errors) or once in 10 000 (Kolmogorov-Smirnov: sqrt(n) D < 2.23).
#include "engine/world/noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace vigil::noise_test {
namespace {

constexpr int kDraws = 200'000;
constexpr double kErrors = 4.5;
constexpr double kKolmogorov = 2.23;

const Eigen::MatrixXd kNone2 = Eigen::MatrixXd::Zero(2, 2);

Eigen::MatrixXd one(double value) { return Eigen::MatrixXd::Constant(1, 1, value); }

/// Draws of ticks 1 to kDraws, one a column.
Eigen::MatrixXd sample(const NoiseSource& source, int size) {
  Eigen::MatrixXd result(size, kDraws);
  Eigen::VectorXd out(size);
  for (int k = 0; k < kDraws; ++k) {
    source.draw(k + 1, out);
    result.col(k) = out;
  }
  return result;
}

/// How many standard errors the mean of the values is off `expected`.
double errors_off(const Eigen::ArrayXd& values, double expected) {
  const double mean = values.mean();
  const double deviation = std::sqrt((values - mean).square().mean() / static_cast<double>(values.size()));
  return std::abs(mean - expected) / deviation;
}

double distance(Eigen::ArrayXd values, const std::function<double(double)>& cdf) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double worst = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double p = cdf(values[i]);
    worst = std::max({worst, std::abs(p - static_cast<double>(i) / n), std::abs(static_cast<double>(i + 1) / n - p)});
  }
  return std::sqrt(n) * worst;
}

double normal(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// Distribution functions of the table in section 3 of the specification, standardised to mean 0 and variance 1.
double gmix(double x) { return 0.9 * normal(x * std::sqrt(3.4)) + 0.1 * normal(x * std::sqrt(3.4) / 5); }
double skewmix(double x) {
  const double raw = x * std::sqrt(1.4);
  return 0.8 * normal((raw + 0.5) / 0.5) + 0.2 * normal(raw - 2);
}
double laplace(double x) {
  const double tail = 0.5 * std::exp(-std::abs(x) * std::numbers::sqrt2);
  return x < 0 ? tail : 1 - tail;
}
double gamma2(double x) {
  const double raw = x * std::numbers::sqrt2 + 2;
  return raw <= 0 ? 0 : 1 - std::exp(-raw) * (1 + raw);
}
double student5(double x) {  // Abramowitz and Stegun, 26.7.3
  const double t = x * std::sqrt(5.0 / 3), angle = std::atan(t / std::sqrt(5.0)), cosine = std::cos(angle);
  const double two_sided =
      2 / std::numbers::pi * (angle + std::sin(angle) * (cosine + 2.0 / 3 * cosine * cosine * cosine));
  return 0.5 + 0.5 * two_sided;
}

struct Shape {
  double skewness, fourth;  ///< standardised moments; the fourth NaN where chance alone cannot judge it
  double (*cdf)(double);
};

Shape shape(Law law) {
  switch (law) {
    case Law::gauss:
      return {0, 3, normal};
    case Law::gmix:
      return {0, 3 * (0.9 + 0.1 * 625) / (3.4 * 3.4), gmix};
    case Law::skewmix:
      return {(0.8 * (-0.125 - 0.375) + 0.2 * (8 + 6)) / std::pow(1.4, 1.5),
              (0.8 * (0.0625 + 6 * 0.25 * 0.25 + 3 * 0.0625) + 0.2 * (16 + 6 * 4 + 3)) / 1.96, skewmix};
    case Law::laplace:
      return {0, 6, laplace};
    case Law::gamma:
      return {std::numbers::sqrt2, 6, gamma2};
    case Law::student:
      return {0, std::nan(""), student5};
  }
  return {};
}

class EveryNoiseLaw : public testing::TestWithParam<std::string> {};

TEST_P(EveryNoiseLaw, IsStandardisedAndOfItsShape) {
  const Law law = law_of(GetParam());
  const Eigen::ArrayXd x =
      sample(NoiseSource(one(1), law, one(0), BoundedLaw::uniform, 2026, "noise"), 1).row(0).transpose();
  const Shape expected = shape(law);
  EXPECT_LT(errors_off(x, 0), kErrors);
  EXPECT_LT(errors_off(x.square(), 1), kErrors);
  if (law != Law::student) {
    EXPECT_LT(errors_off(x.cube(), expected.skewness), kErrors);
  }
  if (!std::isnan(expected.fourth)) {
    EXPECT_LT(errors_off(x.square().square(), expected.fourth), kErrors);
  }
  EXPECT_LT(distance(x, expected.cdf), kKolmogorov);
}

// Each law through the factor of a full matrix: the covariance is the one that was asked for.
TEST_P(EveryNoiseLaw, HasItsCovariance) {
  const Eigen::Matrix2d P{{2, -0.9}, {-0.9, 0.5}};
  const Eigen::MatrixXd draws = sample(NoiseSource(P, law_of(GetParam()), kNone2, BoundedLaw::uniform, 7, "noise"), 2);
  for (int r = 0; r < 2; ++r) {
    EXPECT_LT(errors_off(draws.row(r).transpose().array(), 0), kErrors);
    for (int c = 0; c <= r; ++c)
      EXPECT_LT(errors_off(draws.row(r).transpose().array() * draws.row(c).transpose().array(), P(r, c)), kErrors)
          << r << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, EveryNoiseLaw, testing::ValuesIn(law_names()),
                         [](const auto& tested) { return tested.param; });

// The factor is Cholesky's, as the specification has it: the first component is a multiple of one standard draw.
TEST(Noise, TakesTheLowerFactor) {
  const Eigen::Matrix2d P{{4, 2}, {2, 5}};
  const NoiseSource plain(Eigen::MatrixXd::Identity(2, 2), Law::laplace, kNone2, BoundedLaw::uniform, 3, "noise"),
      shaped(P, Law::laplace, kNone2, BoundedLaw::uniform, 3, "noise");
  Eigen::VectorXd a(2), b(2);
  for (int k = 1; k < 50; ++k) {
    plain.draw(k, a);
    shaped.draw(k, b);
    EXPECT_NEAR(b[0], 2 * a[0], 1e-14);
    EXPECT_NEAR(b[1], a[0] + 2 * a[1], 1e-14);
  }
}

TEST(Noise, OfASingularCovarianceStaysInItsRange) {
  const Eigen::Matrix2d P{{1, 2}, {2, 4}};
  for (const std::string& law : law_names()) {
    const Eigen::MatrixXd draws = sample(NoiseSource(P, law_of(law), kNone2, BoundedLaw::uniform, 7, "noise"), 2);
    EXPECT_LT((draws.row(1) - 2 * draws.row(0)).cwiseAbs().maxCoeff(), 1e-6 * draws.cwiseAbs().maxCoeff()) << law;
    EXPECT_LT(errors_off(draws.row(0).transpose().array().square(), 1), kErrors) << law;
  }
}

Eigen::ArrayXd levels(const Eigen::MatrixXd& draws, const Eigen::MatrixXd& shape) {
  const Eigen::LLT<Eigen::MatrixXd> factor(shape);
  return factor.matrixL().solve(draws).colwise().squaredNorm().transpose();
}

TEST(BoundedNoise, FillsItsEllipsoidUniformly) {
  const Eigen::MatrixXd shapes[] = {one(0.5), Eigen::Matrix2d{{0.5, 0}, {0, 0.5}}, Eigen::Matrix2d{{2, 0.9}, {0.9, 1}},
                                    Eigen::Matrix3d{{2, 0.3, 0.1}, {0.3, 1, -0.4}, {0.1, -0.4, 3}}};
  for (const Eigen::MatrixXd& Mw : shapes) {
    const auto n = static_cast<int>(Mw.rows());
    const Eigen::MatrixXd draws =
        sample(NoiseSource(Eigen::MatrixXd::Zero(n, n), Law::gmix, Mw, BoundedLaw::uniform, 11, "noise"), n);
    const Eigen::ArrayXd level = levels(draws, Mw);
    EXPECT_LE(level.maxCoeff(), 1 + 1e-12);
    EXPECT_GT(level.maxCoeff(), 0.999);
    EXPECT_LT(distance(level, [&](double v) { return std::pow(v, 0.5 * n); }), kKolmogorov) << "volume below a level";
    for (int r = 0; r < n; ++r) {
      EXPECT_LT(errors_off(draws.row(r).transpose().array(), 0), kErrors);
      for (int c = 0; c <= r; ++c)
        EXPECT_LT(errors_off(draws.row(r).transpose().array() * draws.row(c).transpose().array(), Mw(r, c) / (n + 2)),
                  kErrors)
            << n << ": " << r << c;
    }
  }
}

TEST(BoundedNoise, OnTheSurfaceStaysOnIt) {
  const Eigen::Matrix2d Mw{{2, 0.9}, {0.9, 1}};
  const Eigen::MatrixXd draws = sample(NoiseSource(kNone2, Law::gmix, Mw, BoundedLaw::surface, 11, "noise"), 2);
  EXPECT_LT((levels(draws, Mw) - 1).abs().maxCoeff(), 1e-12);
  for (int r = 0; r < 2; ++r) {
    EXPECT_LT(errors_off(draws.row(r).transpose().array(), 0), kErrors);
    EXPECT_LT(errors_off(draws.row(r).transpose().array().square(), Mw(r, r) / 2), kErrors);
  }
}

// rad = 1, angle 0.7 k + a phase that the seed and the stream decide.
TEST(BoundedNoise, OfTheSineTurns) {
  const Eigen::Matrix2d Mw{{4, 0}, {0, 9}};
  double phases[2][2];
  for (int seed = 0; seed < 2; ++seed) {
    for (int stream = 0; stream < 2; ++stream) {
      const NoiseSource source(kNone2, Law::gmix, Mw, BoundedLaw::sine, 20 + static_cast<std::uint64_t>(seed),
                               stream == 0 ? "plant" : "sensor.1");
      Eigen::VectorXd first(2), out(2);
      source.draw(1, first);
      const double phase = std::atan2(first[1] / 3, first[0] / 2) - 0.7;
      phases[seed][stream] = phase;
      for (int k = 2; k < 400; ++k) {
        source.draw(k, out);
        EXPECT_NEAR(out[0], 2 * std::cos(0.7 * k + phase), 1e-11) << k;
        EXPECT_NEAR(out[1], 3 * std::sin(0.7 * k + phase), 1e-11) << k;
      }
    }
  }
  EXPECT_GT(std::abs(phases[0][0] - phases[0][1]), 1e-3);
  EXPECT_GT(std::abs(phases[0][0] - phases[1][0]), 1e-3);
}

/// Correlation of two series in standard errors of zero.
double correlation(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
  return std::abs((a * b).mean() - a.mean() * b.mean()) /
         std::sqrt((a - a.mean()).square().mean() * (b - b.mean()).square().mean() / static_cast<double>(a.size()));
}

// Plant, sensors, the random and the bounded part, their components and ticks: values and squares know nothing of each
// other.
TEST(Noise, StreamsAreIndependent) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(2, 2);
  std::vector<Eigen::ArrayXd> series;
  for (const char* stream : {"plant", "sensor.1", "sensor.2"}) {
    for (const bool random : {true, false}) {
      const Eigen::MatrixXd draws =
          sample(NoiseSource(random ? I : kNone2, Law::gmix, random ? kNone2 : I, BoundedLaw::uniform, 5, stream), 2);
      series.emplace_back(draws.row(0).transpose());
      series.emplace_back(draws.row(1).transpose());
    }
  }
  for (std::size_t a = 0; a < series.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_LT(correlation(series[a], series[b]), kErrors) << a << " " << b;
      // Two components of one draw in the disk depend on each other through its rim.
      if (a / 2 == b / 2) continue;
      EXPECT_LT(correlation(series[a].square(), series[b].square()), kErrors) << a << " " << b;
    }
    const Eigen::Index n = series[a].size() - 1;
    EXPECT_LT(correlation(series[a].head(n), series[a].tail(n)), kErrors) << a << " beside itself a tick later";
    EXPECT_LT(correlation(series[a].head(n).square(), series[a].tail(n).square()), kErrors) << a;
  }
}

TEST(Noise, OfBothPartsIsTheirSum) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(2, 2);
  for (const std::string& law : law_names()) {
    for (const std::string& bounded : bounded_law_names()) {
      const auto source = [&](const Eigen::MatrixXd& P, const Eigen::MatrixXd& Mw) {
        return NoiseSource(P, law_of(law), Mw, bounded_law_of(bounded), 9, "noise");
      };
      const NoiseSource both = source(I, 0.5 * I), random = source(I, kNone2), bound = source(kNone2, 0.5 * I);
      Eigen::VectorXd sum(2), a(2), b(2);
      for (const std::int64_t k : {0, 1, 77, 1'000'000'000}) {
        both.draw(k, sum);
        random.draw(k, a);
        bound.draw(k, b);
        EXPECT_LT((sum - a - b).norm(), 1e-14) << law << " " << bounded;
      }
    }
  }
}

// A draw depends on seed, stream, tick and place: not on what was drawn before, nor on another dimension's size.
TEST(Noise, IsADrawAtAnAddress) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(2, 2);
  for (const std::string& law : law_names()) {
    const NoiseSource one_source(I, law_of(law), I, BoundedLaw::uniform, 9, "plant"),
        same = one_source, seed(I, law_of(law), I, BoundedLaw::uniform, 10, "plant");
    Eigen::VectorXd a(2), b(2), c(2);
    one_source.draw(5, c);
    for (const std::int64_t k : {5, 3, 5}) {
      one_source.draw(k, a);
      same.draw(k, b);
      EXPECT_EQ(a, b);
      if (k == 5) {
        EXPECT_EQ(a, c);
      }
    }
    seed.draw(5, a);
    EXPECT_NE(a, c) << law;
  }
}

TEST(Noise, OfNothingIsZero) {
  const NoiseSource none(kNone2, Law::gmix, kNone2, BoundedLaw::surface, 9, "plant");
  Eigen::VectorXd out = Eigen::VectorXd::Ones(2);
  none.draw(3, out);
  EXPECT_TRUE(out.isZero(0));
}

}  // namespace
}  // namespace vigil::noise_test
