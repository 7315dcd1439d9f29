#include "engine/metrics/paired_tolerance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace vigil::paired_tolerance_test {
namespace {

const double kNan = std::nan("");

std::vector<std::int64_t> ticks(std::size_t count, std::int64_t first = 0) {
  std::vector<std::int64_t> k(count);
  std::iota(k.begin(), k.end(), first);
  return k;
}

ToleranceVerdict judged(const std::vector<double>& base, const std::vector<double>& other, Tolerance tolerance,
                        std::int64_t first = 0) {
  return judge_tolerance(ticks(base.size(), first), base, other, tolerance);
}

TEST(Tolerance, OfNothingAsksForEquality) {
  EXPECT_TRUE(judged({1, 2, 3}, {1, 2, 3}, {}).holds());
  const ToleranceVerdict v = judged({1, 2, 3}, {1, 2, 3 + 1e-15}, {}, 10);
  EXPECT_FALSE(v.holds());
  EXPECT_EQ(v.first, 12);
  EXPECT_EQ(v.inside, 2);
  EXPECT_EQ(v.ticks, 3);
}

TEST(Tolerance, TakesTheWiderOfAbsoluteAndRelative) {
  const std::vector<double> base{100, 1, -100, 0}, other{109, 1.5, -89, 0.6};
  const ToleranceVerdict v = judged(base, other, {0.5, 0.1, 0}, 5);
  EXPECT_EQ(v.inside, 2) << "109 within 10 %, 1.5 at the very edge of 0.5";
  EXPECT_EQ(v.first, 7);
  EXPECT_EQ(v.worst, 11);
  EXPECT_EQ(v.worst_at, 7);
  ASSERT_EQ(v.outside.size(), 1u);
  EXPECT_EQ(v.outside[0].first, 7);
  EXPECT_EQ(v.outside[0].last, 8);
}

// A ramp of slope 1 that comes d ticks late differs by d everywhere: inside where the shift allows d.
TEST(Tolerance, AllowsADelay) {
  std::vector<double> base(50), late(50);
  for (int i = 0; i < 50; ++i) {
    base[static_cast<std::size_t>(i)] = i;
    late[static_cast<std::size_t>(i)] = i - 3;
  }
  EXPECT_EQ(judged(base, late, {0, 0, 2}).inside, 0);
  const ToleranceVerdict v = judged(base, late, {0, 0, 3});
  EXPECT_EQ(v.inside, 47) << "the first three ticks have no base before them";
  EXPECT_EQ(v.first, 0);
  EXPECT_EQ(v.worst, 3);
  EXPECT_EQ(judged(base, late, {0.5, 0, 2}).inside, 0);
  EXPECT_EQ(judged(base, late, {1, 0, 2}).inside, 48) << "ticks 0 and 1: -3 and -2 are below 0 - 1";
}

TEST(Tolerance, KnowsWhatIsMissing) {
  EXPECT_TRUE(judged({1, kNan, 3}, {1, kNan, 3}, {}).holds());
  const ToleranceVerdict extra = judged({1, kNan, 3}, {1, 2, 3}, {10, 0, 0});
  EXPECT_EQ(extra.inside, 2);
  EXPECT_EQ(extra.first, 1);
  EXPECT_EQ(extra.worst, 0);
  EXPECT_EQ(judged({1, 2, 3}, {1, kNan, 3}, {10, 0, 0}).first, 1);
  EXPECT_TRUE(judged({1, kNan, 3}, {kNan, 2, kNan}, {1, 0, 1}).holds());
  const ToleranceVerdict nothing = judged({}, {}, {});
  EXPECT_TRUE(nothing.holds());
  EXPECT_TRUE(std::isnan(nothing.worst));
}

TEST(Tolerance, CountsShiftInTicksWhereTicksAreLogged) {
  const std::vector<std::int64_t> k{0, 5, 10, 15};
  const std::vector<double> base{0, 1, 2, 3}, other{0, 0, 1, 2};
  EXPECT_EQ(judge_tolerance(k, base, other, {0, 0, 4}).inside, 1);
  EXPECT_EQ(judge_tolerance(k, base, other, {0, 0, 5}).inside, 4);
}

TEST(Tolerance, OfCategoriesIsEqualityWithinTheShift) {
  const std::vector<double> base{0, 0, 2, 2, 0}, other{0, 2, 2, 1, 0};
  const auto k = ticks(5);
  const ToleranceVerdict strict = judge_equal(k, base, other, 0), loose = judge_equal(k, base, other, 1);
  EXPECT_EQ(strict.inside, 3);
  EXPECT_EQ(strict.first, 1);
  EXPECT_EQ(loose.inside, 4) << "1 lies between 0 and 2 and is neither";
  EXPECT_EQ(loose.first, 3);
}

// The moving extremes against the definition, written as it is.
TEST(Tolerance, IsItsDefinitionOnRandomSeries) {
  std::mt19937 draw(1);
  std::uniform_int_distribution<int> small(-5, 5), gap(1, 3);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::int64_t> k;
    std::vector<double> base, other;
    for (int i = 0; i < 40; ++i) {
      k.push_back((k.empty() ? 0 : k.back()) + gap(draw));
      base.push_back(small(draw) == 5 ? kNan : small(draw));
      other.push_back(small(draw) == 5 ? kNan : small(draw));
    }
    const Tolerance tolerance{0.5 * (round % 4), 0.25 * (round % 3), round % 7};
    std::int64_t inside = 0;
    for (std::size_t i = 0; i < k.size(); ++i) {
      double low = INFINITY, high = -INFINITY;
      bool missing = false;
      for (std::size_t j = 0; j < k.size(); ++j) {
        if (std::abs(k[j] - k[i]) > tolerance.shift) continue;
        missing = missing || std::isnan(base[j]);
        if (std::isnan(base[j])) continue;
        const double m = std::max(tolerance.abs, tolerance.rel * std::abs(base[j]));
        low = std::min(low, base[j] - m);
        high = std::max(high, base[j] + m);
      }
      inside += std::isnan(other[i]) ? missing : other[i] >= low && other[i] <= high;
    }
    EXPECT_EQ(judge_tolerance(k, base, other, tolerance).inside, inside) << round;
  }
}

}  // namespace
}  // namespace vigil::paired_tolerance_test
