#include "engine/metrics/paired_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vigil::paired_law_test {
namespace {

// One and two degrees of freedom have closed forms, and so have their quantiles; four has a closed distribution.
TEST(StudentsLaw, IsItsClosedForms) {
  for (const double t : {-40.0, -3.0, -0.5, 0.0, 0.1, 1.0, 2.5, 12.0, 1e4}) {
    EXPECT_NEAR(student_cdf(t, 1), 0.5 + std::atan(t) / std::numbers::pi, 1e-14) << t;
    EXPECT_NEAR(student_cdf(t, 2), 0.5 + t / (2 * std::sqrt(2 + t * t)), 1e-14) << t;
    const double u = t / std::sqrt(4 + t * t);
    EXPECT_NEAR(student_cdf(t, 4), 0.5 + 0.75 * u * (1 - u * u / 3), 1e-14) << t;
  }
  for (const double p : {1e-6, 0.025, 0.3, 0.5, 0.9, 0.975, 0.9995}) {
    const double one = std::tan(std::numbers::pi * (p - 0.5));
    EXPECT_NEAR(student_quantile(p, 1), one, 1e-10 * std::max(1.0, std::abs(one))) << p;
    const double two = (2 * p - 1) / std::sqrt(2 * p * (1 - p));
    EXPECT_NEAR(student_quantile(p, 2), two, 1e-10 * std::max(1.0, std::abs(two))) << p;
  }
  EXPECT_EQ(student_quantile(0.5, 1), 0);
}

TEST(StudentsLaw, BecomesTheNormalLaw) {
  for (const double t : {-2.0, -0.3, 1.0, 1.959963984540054}) {
    EXPECT_NEAR(student_cdf(t, 1e9), 0.5 * std::erfc(-t / std::numbers::sqrt2), 1e-8) << t;
  }
  EXPECT_NEAR(student_quantile(0.975, 1e9), 1.959963984540054, 1e-7);
}

TEST(StudentsLaw, GoesThereAndBack) {
  for (const double degrees : {0.5, 1.0, 3.0, 7.5, 19.0, 300.0}) {
    for (const double p : {0.01, 0.2, 0.6, 0.975}) {
      EXPECT_NEAR(student_cdf(student_quantile(p, degrees), degrees), p, 1e-12) << degrees << " " << p;
    }
  }
  EXPECT_TRUE(std::isnan(student_quantile(0, 3)) && std::isnan(student_quantile(1, 3)));
  EXPECT_TRUE(std::isnan(student_quantile(0.5, 0)) && std::isnan(student_cdf(0, -1)));
}

TEST(SignedRanks, AllOfOneSignIsTwiceOneOfAllTheSigns) {
  std::vector<double> differences;
  for (int n = 1; n <= 12; ++n) {
    differences.push_back(n);
    EXPECT_DOUBLE_EQ(signed_rank_p(differences), std::min(1.0, 2 * std::pow(0.5, n))) << n;
  }
}

// n = 4, only the smallest is negative: sums 0 and 1 of 16 equally likely ones are as far out, on either side.
TEST(SignedRanks, CountsByHand) {
  EXPECT_DOUBLE_EQ(signed_rank_p(std::vector<double>{-1, 2, 3, 4}), 4.0 / 16);
  EXPECT_DOUBLE_EQ(signed_rank_p(std::vector<double>{1, -2, -3, -4}), 4.0 / 16);
  EXPECT_DOUBLE_EQ(signed_rank_p(std::vector<double>{1, -1}), 1);
  EXPECT_DOUBLE_EQ(signed_rank_p(std::vector<double>{0, 0, 5, 6}), 0.5) << "zeros are left out";
  // Three equal sizes share rank 2: the sum is 2, 4, … times the number of positives, one or none of three: 4 of 8.
  EXPECT_DOUBLE_EQ(signed_rank_p(std::vector<double>{3, -3, -3}), 1);
  EXPECT_DOUBLE_EQ(signed_rank_p(std::vector<double>{-3, -3, -3}), 0.25);
  EXPECT_TRUE(std::isnan(signed_rank_p(std::vector<double>{0, 0}))) << "nothing to judge";
}

// Thirty-one differences: mean n(n+1)/4 = 248, variance n(n+1)(2n+1)/24 = 2604.
TEST(SignedRanks, BecomeNormalWhereTheyAreMany) {
  std::vector<double> differences;
  for (int i = 1; i <= 31; ++i) differences.push_back(i % 3 == 0 ? -i : i);
  double positive = 0;
  for (const double d : differences) positive += d > 0 ? d : 0;
  const double z = (std::abs(positive - 248) - 0.5) / std::sqrt(2604.0);
  EXPECT_NEAR(signed_rank_p(differences), std::erfc(z / std::numbers::sqrt2), 1e-14);
}

}  // namespace
}  // namespace vigil::paired_law_test
