#include "engine/linalg/chi_square.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vigil::chi_square_test {
namespace {

struct Row {
  double p, degrees, quantile;
};

// To 15 digits by bisection of the incomplete gamma function in 40-digit arithmetic; the usual ones agree with the
// printed tables.
constexpr Row kTable[] = {
    {0.025, 1, 0.000982069117175256}, {0.5, 1, 0.454936423119573},     {0.95, 1, 3.84145882069413},
    {0.99, 1, 6.63489660102122},      {0.999, 1, 10.8275661706627},    {0.025, 2, 0.0506356159685798},
    {0.5, 2, 1.38629436111989},       {0.975, 2, 7.37775890822787},    {0.99, 2, 9.21034037197618},
    {0.025, 3, 0.215795282623898},    {0.975, 3, 9.34840360449615},    {0.99, 3, 11.3448667301444},
    {0.05, 10, 3.94029913611906},     {0.95, 10, 18.3070380532751},    {0.975, 16, 28.8453507234048},
    {0.025, 16, 6.907664353497},      {0.5, 100, 99.3341292359885},    {0.95, 100, 124.342113404004},
    {1e-6, 4, 0.00282976132295869},   {0.999999, 4, 33.3768415817198}, {0.9, 0.5, 1.50078574447367},
    {0.99, 1000, 1106.96899435222},
};

TEST(ChiSquare, HasTheQuantilesOfTheTables) {
  for (const Row& row : kTable) {
    EXPECT_NEAR(chi_square_quantile(row.p, row.degrees) / row.quantile, 1, 1e-11) << row.p << " " << row.degrees;
    EXPECT_NEAR(chi_square_cdf(row.quantile, row.degrees), row.p, 1e-12) << row.p << " " << row.degrees;
  }
}

TEST(ChiSquare, IsTheInverseOfItsCdf) {
  for (const double degrees : {0.3, 1.0, 2.0, 3.0, 12.0, 16.0, 300.0}) {
    double last = 0;
    for (double p = 0.001; p < 1; p += 0.0117) {
      const double x = chi_square_quantile(p, degrees);
      EXPECT_GT(x, last);
      EXPECT_NEAR(chi_square_cdf(x, degrees), p, 1e-11);
      last = x;
    }
  }
}

TEST(ChiSquare, TwoDegreesAreAnExponential) {
  for (double x = 0.01; x < 60; x *= 1.3) EXPECT_NEAR(chi_square_cdf(x, 2), -std::expm1(-x / 2), 1e-14);
}

TEST(ChiSquare, IsSilentOutside) {
  for (const double p : {0.0, 1.0, -0.1, 1.1, std::nan("")}) EXPECT_TRUE(std::isnan(chi_square_quantile(p, 2))) << p;
  for (const double degrees : {0.0, -1.0, std::nan("")})
    EXPECT_TRUE(std::isnan(chi_square_quantile(0.5, degrees))) << degrees;
  EXPECT_EQ(chi_square_cdf(0, 3), 0);
  EXPECT_EQ(chi_square_cdf(-1, 3), 0);
  EXPECT_EQ(chi_square_cdf(1e6, 3), 1);
}

}  // namespace
}  // namespace vigil::chi_square_test
