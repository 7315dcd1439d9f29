#include "engine/metrics/paired.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/metrics/paired_law.hpp"

namespace vigil::paired_test {
namespace {

const double kNan = std::nan("");

// Differences 1, 2, 3: mean 2, variance 1, se 1/sqrt(3); two degrees of freedom have a closed quantile.
TEST(PairedDifference, IsStudentsByHand) {
  const PairedDifference d = paired_difference(std::vector<double>{10, 20, 30}, std::vector<double>{11, 22, 33});
  EXPECT_EQ(d.n, 3);
  EXPECT_DOUBLE_EQ(d.mean, 2);
  EXPECT_DOUBLE_EQ(d.se, 1 / std::sqrt(3.0));
  const double t = 0.95 / std::sqrt(2 * 0.975 * 0.025);
  EXPECT_NEAR(d.lo, 2 - t / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(d.hi, 2 + t / std::sqrt(3.0), 1e-12);
  EXPECT_DOUBLE_EQ(d.p, 0.25);
  EXPECT_EQ(d.batches, 0);
}

TEST(PairedDifference, LeavesOutWhatHasNoPartner) {
  const PairedDifference d =
      paired_difference(std::vector<double>{1, kNan, 3, 4}, std::vector<double>{2, 7, kNan, 7, 100});
  EXPECT_EQ(d.n, 2);
  EXPECT_DOUBLE_EQ(d.mean, 2);
  EXPECT_DOUBLE_EQ(d.se, 1);
}

TEST(PairedDifference, SaysOnlyWhatItCan) {
  const PairedDifference none = paired_difference({}, {});
  EXPECT_EQ(none.n, 0);
  EXPECT_TRUE(std::isnan(none.mean) && std::isnan(none.se) && std::isnan(none.lo) && std::isnan(none.p));
  const PairedDifference one = paired_difference(std::vector<double>{1}, std::vector<double>{4});
  EXPECT_DOUBLE_EQ(one.mean, 3);
  EXPECT_TRUE(std::isnan(one.se) && std::isnan(one.lo) && std::isnan(one.hi));
  const PairedDifference same = paired_difference(std::vector<double>{1, 2}, std::vector<double>{1, 2});
  EXPECT_EQ(same.se, 0);
  EXPECT_EQ(same.lo, 0);
  EXPECT_EQ(same.hi, 0);
  EXPECT_TRUE(std::isnan(same.p));
}

// Forty differences: twenty batches of two with means 1, 2, …, 20. Their variance is 35, however the two differ.
TEST(PairedInTime, RestsOnItsBatchMeans) {
  std::vector<double> a(40, 0.0), b;
  for (int i = 1; i <= 20; ++i) {
    b.push_back(i + 100);
    b.push_back(i - 100);
  }
  const PairedDifference d = paired_in_time(a, b);
  EXPECT_EQ(d.n, 40);
  EXPECT_EQ(d.batches, 20);
  EXPECT_DOUBLE_EQ(d.mean, 10.5);
  EXPECT_NEAR(d.se, std::sqrt(35.0 / 20), 1e-12);
  EXPECT_NEAR(d.hi - d.lo, 2 * student_quantile(0.975, 19) * std::sqrt(35.0 / 20), 1e-9);
  // Of 1, 2, …, n about their mean: sum of products of neighbours over the sum of squares is (n - 3) / n.
  EXPECT_NEAR(d.lag1, 17.0 / 20, 1e-12);
}

TEST(PairedInTime, CutsWhatIsShortIntoFewerBatchesAndGivesUpBelowTwenty) {
  std::vector<double> a(25, 0.0), b;
  for (int i = 0; i < 25; ++i) b.push_back(i % 2 == 0 ? 1 : -1);
  const PairedDifference d = paired_in_time(a, b);
  EXPECT_EQ(d.batches, 12);
  EXPECT_DOUBLE_EQ(d.mean, 1.0 / 25);
  EXPECT_EQ(paired_in_time(std::span(a).first(20), std::span(b).first(20)).batches, 10);
  const PairedDifference few = paired_in_time(std::span(a).first(19), std::span(b).first(19));
  EXPECT_EQ(few.n, 19);
  EXPECT_DOUBLE_EQ(few.mean, 1.0 / 19);
  EXPECT_EQ(few.batches, 0);
  EXPECT_TRUE(std::isnan(few.se) && std::isnan(few.lo) && std::isnan(few.lag1));
}

TEST(PairedInTime, OfEqualSeriesIsZeroAndSure) {
  const std::vector<double> a(100, 3.5);
  const PairedDifference d = paired_in_time(a, a);
  EXPECT_EQ(d.mean, 0);
  EXPECT_EQ(d.lo, 0);
  EXPECT_EQ(d.hi, 0);
  EXPECT_TRUE(std::isnan(d.lag1)) << "no correlation of what does not vary";
}

}  // namespace
}  // namespace vigil::paired_test
