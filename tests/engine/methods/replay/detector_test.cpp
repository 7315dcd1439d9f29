#include "engine/methods/replay/detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/engine/allocations.hpp"
#include "tests/engine/linalg/random_matrices.hpp"
#include "tests/engine/methods/replay/detector_reference.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::replay::detector_test {
namespace {

using Eigen::VectorXd;
using reference::Judged;
using reference::kNone;
using reference::Series;

VectorXd residual_of(double energy) { return VectorXd::Constant(1, std::sqrt(energy)); }

Judged by_the_detector(const Series& energies, const DetectorSettings& settings) {
  EnergyDetector detector(settings);
  Judged all;
  std::int64_t k = 0;
  for (const double energy : energies) {
    const Verdict verdict = detector.judge(++k, residual_of(energy));
    all.statistic.push_back(verdict.has_statistic ? verdict.statistic : kNone);
    all.threshold.push_back(verdict.has_threshold ? verdict.threshold : kNone);
    all.flag.push_back(verdict.flag);
  }
  return all;
}

void expect_same(const Series& got, const Series& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_EQ(std::isnan(got[i]), std::isnan(expected[i])) << i;
    if (std::isnan(got[i])) continue;
    EXPECT_NEAR(got[i], expected[i], 1e-12 * std::abs(expected[i])) << i;
  }
}

/// xi steps from a to b and stays; how many samples are flagged, and whether they are the first ones after the step.
int flagged_of_step(const DetectorSettings& settings, double a, double b) {
  Series energies(100, a);
  energies.resize(400, b);
  const auto flags = by_the_detector(energies, settings).flag;
  const auto begin = flags.begin() + 100;
  const auto count = std::count(flags.begin(), flags.end(), true);
  EXPECT_TRUE(std::all_of(begin, begin + count, [](bool flag) { return flag; }));
  return static_cast<int>(count);
}

TEST(Detector, AgreesWithTheTextOnRandomSeries) {
  int flags = 0;
  for (int number = 0; number < 240; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(number);
    const int windows[] = {1, 3, 5, 10};
    DetectorSettings settings;
    settings.window = windows[number % 4];
    settings.threshold = number % 2 == 0 ? Threshold::printed : Threshold::frozen;
    settings.dead_band = (number / 2) % 2 == 0 ? DeadBand::held : DeadBand::raw_step;
    settings.tau = 2 + random.below(39);
    settings.eta = 3 * random.uniform();
    settings.iota = number % 3 == 0 ? 0 : 0.5 * random.uniform();
    Series energies;
    for (int i = 0; i < 300; ++i) {
      energies.push_back(std::pow(random.normal(), 2) * (i > 150 && i < 200 ? 4 : 1) + 0.01 * (number % 5) * i);
    }
    const Judged expected = reference::by_the_text(energies, settings), got = by_the_detector(energies, settings);
    expect_same(got.statistic, expected.statistic);
    expect_same(got.threshold, expected.threshold);
    EXPECT_EQ(got.flag, expected.flag);
    flags += static_cast<int>(std::count(got.flag.begin(), got.flag.end(), true));
  }
  EXPECT_GT(flags, 1000);
}

// The table of section 5: tau, eta -> flagged samples.
TEST(Detector, AStepContaminatesItsOwnThreshold) {
  const struct {
    int tau;
    double eta;
    int flagged;
  } table[] = {{10, 2, 1}, {15, 2, 2}, {20, 2, 3}, {25, 2, 4}, {40, 2, 7},
               {10, 3, 0}, {15, 3, 1}, {20, 3, 1}, {25, 3, 2}, {40, 3, 3}};
  for (const auto& row : table) {
    SCOPED_TRACE(testing::Message() << "tau " << row.tau << " eta " << row.eta);
    for (const double b : {1.2, 2.0, 50.0}) {
      EXPECT_EQ(flagged_of_step({.window = 1, .tau = row.tau, .eta = row.eta, .iota = 0}, 1, b), row.flagged);
    }
    EXPECT_EQ(longest_step_flag(row.tau, row.eta), row.flagged);
    EXPECT_EQ(can_rise(row.tau, row.eta), row.flagged > 0);
  }
}

TEST(Detector, TheScenariosFlagAStepForAsLongAsTheSpecificationSays) {
  const int bare[] = {3, 2, 4}, with_dead_band[] = {9, 3, 12};
  for (int i = 0; i < 3; ++i) {
    const auto& scenario = tank::kScenarios[i];
    DetectorSettings settings{.window = 1, .tau = scenario.tau, .eta = scenario.eta, .iota = 0};
    EXPECT_EQ(flagged_of_step(settings, 1, 1.2), bare[i]);
    settings.iota = scenario.iota;
    EXPECT_EQ(flagged_of_step(settings, 1, 1.2), with_dead_band[i]);
  }
}

TEST(Detector, TheLawHoldsForEveryWindowAndMultiplier) {
  for (int tau = 2; tau <= 40; ++tau) {
    for (double eta = 0; eta <= 6; eta += 0.37) {
      int up = 0;
      for (int q = 1; q <= tau; ++q) up += q < tau / (1 + eta * eta * tau / (tau - 1.0)) ? 1 : 0;
      EXPECT_EQ(longest_step_flag(tau, eta), up);
      EXPECT_EQ(can_rise(tau, eta), up > 0);
      EXPECT_EQ(flagged_of_step({.window = 1, .tau = tau, .eta = eta, .iota = 0}, 1, 3), up);
    }
  }
}

TEST(Detector, AFrozenThresholdKeepsAStepFlagged) {
  EXPECT_EQ(flagged_of_step({.window = 1, .threshold = Threshold::frozen, .tau = 20, .iota = 0.3}, 1, 1.2), 300);
}

// The threshold held is compared: a slow ramp moves it. Comparing successive candidates never does.
TEST(Detector, ASlowRampMovesOnlyAHeldThreshold) {
  Series ramp;
  for (int i = 0; i < 400; ++i) ramp.push_back(1 + 0.01 * i);
  DetectorSettings settings{.window = 1, .tau = 20, .eta = 2, .iota = 0.3};
  const auto held = by_the_detector(ramp, settings);
  settings.dead_band = DeadBand::raw_step;
  const auto raw = by_the_detector(ramp, settings);
  EXPECT_GT(held.threshold.back(), ramp.back() - 0.3);
  EXPECT_EQ(raw.threshold.back(), raw.threshold[19]);
  EXPECT_TRUE(raw.flag.back());
}

TEST(Detector, TheFixedThresholdsAreTheLargestResidualOfTicks3To49) {
  for (const Threshold kind : {Threshold::fixed_norm, Threshold::fixed_square}) {
    RandomMatrices random(9);
    EnergyDetector detector({.window = 3, .threshold = kind});
    std::vector<VectorXd> residuals{VectorXd()};
    double largest = 0;
    for (std::int64_t k = 1; k <= 300; ++k) {
      residuals.push_back(random.vector(2) * (k < 3 || k > 200 ? 10 : 1));
      const VectorXd& r = residuals.back();
      if (k >= 3 && k <= 49) largest = std::max(largest, kind == Threshold::fixed_norm ? r.norm() : r.squaredNorm());
      const Verdict verdict = detector.judge(k, r);
      EXPECT_EQ(verdict.has_statistic, k >= 3);
      EXPECT_EQ(verdict.has_threshold, k >= 50);
      if (k < 50) {
        EXPECT_FALSE(verdict.flag);
        continue;
      }
      const auto i = static_cast<std::size_t>(k);
      const double xi =
          (residuals[i].squaredNorm() + residuals[i - 1].squaredNorm() + residuals[i - 2].squaredNorm()) / 3;
      EXPECT_NEAR(verdict.threshold, largest, 1e-14 * largest);
      EXPECT_NEAR(verdict.statistic, xi, 1e-14 * xi);
      EXPECT_EQ(verdict.flag, xi > verdict.threshold);
    }
  }
}

TEST(Detector, NothingLearntNothingFlagged) {
  EnergyDetector detector({.window = 1, .threshold = Threshold::fixed_square});
  for (std::int64_t k = 50; k < 80; ++k) {
    const Verdict verdict = detector.judge(k, residual_of(5));
    EXPECT_TRUE(verdict.has_statistic);
    EXPECT_FALSE(verdict.has_threshold || verdict.flag);
  }
}

TEST(Detector, ATickWithoutAReadingMovesNothing) {
  for (const Threshold kind : {Threshold::printed, Threshold::frozen}) {
    RandomMatrices random(10);
    const DetectorSettings settings{.window = 5, .threshold = kind, .tau = 10, .eta = 1, .iota = 0.1};
    EnergyDetector whole(settings), holed(settings);
    std::int64_t k = 0;
    for (int i = 0; i < 200; ++i) {
      if (i % 7 == 3) {
        const Verdict verdict =
            i % 2 == 0 ? holed.hold() : holed.judge(++k, VectorXd::Constant(2, i % 3 == 0 ? kNone : INFINITY));
        EXPECT_FALSE(verdict.has_statistic || verdict.flag);
        EXPECT_EQ(verdict.has_threshold, whole.hold().has_threshold);
        EXPECT_EQ(verdict.threshold, whole.hold().threshold);
      }
      const VectorXd r = random.vector(2) * (i > 100 ? 2 : 1);
      const Verdict expected = whole.judge(i + 1, r), got = holed.judge(++k, r);
      EXPECT_EQ(got.flag, expected.flag);
      EXPECT_EQ(got.statistic, expected.statistic);
      EXPECT_EQ(got.threshold, expected.threshold);
    }
  }
}

TEST(Detector, RoundOffRaisesNoFlag) {
  EnergyDetector detector({.window = 2, .tau = 4, .eta = 0, .iota = 0});
  RandomMatrices random(11);
  for (std::int64_t k = 1; k <= 100; ++k) {
    const Verdict verdict = detector.judge(k, 6e-8 * random.orthogonal(2).col(0));
    EXPECT_EQ(verdict.statistic, 0);
    EXPECT_FALSE(verdict.flag);
    EXPECT_EQ(detector.blind(), k >= 4);
  }
  detector.judge(101, VectorXd::Constant(1, 1.1e-7));
  EXPECT_FALSE(detector.blind());
  EXPECT_EQ(detector.residuals(), 101);
}

TEST(Detector, AConstantStatisticIsNeverAboveItsOwnMean) {
  for (const double level : {0.1, 0.3, 1.7e-3, 12345.678}) {
    for (const double eta : {0.0, 2.0}) {
      const auto judged = by_the_detector(Series(200, level), {.window = 7, .tau = 15, .eta = eta, .iota = 0});
      EXPECT_EQ(std::count(judged.flag.begin(), judged.flag.end(), true), 0);
    }
  }
}

TEST(Detector, NoResidualIsTooLarge) {
  EnergyDetector detector({.window = 1, .tau = 3, .eta = 2, .iota = 0.1});
  for (std::int64_t k = 1; k <= 30; ++k) {
    const Verdict verdict = detector.judge(k, VectorXd::Constant(2, std::pow(10.0, 10.0 * static_cast<double>(k))));
    EXPECT_TRUE(std::isfinite(verdict.statistic));
    EXPECT_TRUE(std::isfinite(verdict.threshold));
  }
}

TEST(Detector, NewSettingsKeepWhatTheyCan) {
  RandomMatrices random(12);
  const DetectorSettings settings{.window = 5, .tau = 10, .eta = 2, .iota = 0.1};
  EnergyDetector detector(settings);
  for (std::int64_t k = 1; k <= 40; ++k) detector.judge(k, random.vector(2));
  DetectorSettings changed = settings;
  changed.eta = 0;
  changed.iota = 0;
  detector.retune(changed);
  EXPECT_TRUE(detector.hold().has_threshold);
  changed.threshold = Threshold::frozen;
  detector.retune(changed);
  EXPECT_FALSE(detector.hold().has_threshold);
  const Verdict after = detector.judge(41, random.vector(2));
  EXPECT_TRUE(after.has_statistic);
  EXPECT_FALSE(after.has_threshold);
  changed.threshold = Threshold::fixed_square;
  detector.retune(changed);
  EXPECT_TRUE(detector.judge(50, random.vector(2)).has_threshold);  // learnt all along
  changed.window = 3;
  detector.retune(changed);
  EXPECT_FALSE(detector.judge(51, random.vector(2)).has_statistic);
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(Detector, JudgingAllocatesNothingAndCopiesAreIndependent) {
  EnergyDetector detector({.window = 5, .tau = 25});
  const VectorXd r = VectorXd::Ones(2);
  EXPECT_EQ(allocations_in([&] {
              for (std::int64_t k = 1; k <= 100; ++k) detector.judge(k, r);
            }),
            0);
  EnergyDetector copy = detector;
  copy.judge(101, 9 * r);
  EXPECT_EQ(detector.judge(101, r).statistic, r.squaredNorm());
}
#endif

}  // namespace
}  // namespace vigil::replay::detector_test
