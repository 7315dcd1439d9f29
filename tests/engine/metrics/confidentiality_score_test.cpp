// What is last, what is late.
#include "engine/metrics/confidentiality_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vigil::confidentiality_score_test {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(SquareTally, CountsTheLastFifth) {
  SquareTally tally(100);
  EXPECT_TRUE(std::isnan(tally.now()));
  EXPECT_TRUE(std::isnan(tally.late_mean()));
  for (int k = 0; k <= 100; ++k) tally.add(k, k);
  EXPECT_EQ(tally.now(), 100);
  EXPECT_EQ(tally.late_mean(), (81 + 100) / 2.);
  EXPECT_EQ(tally.sum(), 5050);
}

TEST(SquareTally, WithoutAnEndEveryTickButTheFirstIsLate) {
  SquareTally tally;
  for (int k = 0; k <= 4; ++k) tally.add(k, 10 - k);
  EXPECT_EQ(tally.late_mean(), 7.5);
}

TEST(SquareTally, WhatIsMissingIsNotCounted) {
  SquareTally tally(10);
  tally.add(9, 4);
  tally.add(10, kNone);
  EXPECT_TRUE(std::isnan(tally.now()));
  EXPECT_EQ(tally.late_mean(), 4);
  EXPECT_EQ(tally.sum(), 4);
}

}  // namespace
}  // namespace vigil::confidentiality_score_test
