// Runge and Kutta's steps, and signals closed on the right. Specification (observer), section 7.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/world/interconnected/examples.hpp"
#include "engine/world/interconnected/rk4.hpp"

namespace vigil::observer::integration_test {
namespace {

using std::numbers::pi;

/// x' = -x + signal(t) over [0, 3], in steps of 1 / per.
double driven(const Signal& signal, int per, bool by_stage = false) {
  Rk4 rk4(1);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 2);
  const double h = 1.0 / per;
  for (int step = 0; step < 3 * per; ++step) {
    rk4.step(x, step * h, h, [&](double t, double branch, const Eigen::VectorXd& at, auto slope) {
      slope[0] = -at[0] + signal.value(t, by_stage ? t : branch);
    });
  }
  return x[0];
}

TEST(RungeKutta, IsOfFourthOrderAlsoAcrossSwitches) {
  const Signal signal({{.until = 1, .sine = 1, .rate = 2}, {.until = 2}, {.offset = 3, .slope = -2}});
  // x' = -x + sin 2t: x = c e^-t + (sin 2t - 2 cos 2t) / 5; then decay; then the particular solution 5 - 2t.
  const double at_1 = (2 + 0.4) * std::exp(-1) + (std::sin(2) - 2 * std::cos(2)) / 5;
  const double at_2 = at_1 * std::exp(-1), exact = (at_2 - 1) * std::exp(-1) + 5 - 6;
  const double coarse = std::abs(driven(signal, 40) - exact), fine = std::abs(driven(signal, 80) - exact);
  EXPECT_LT(coarse, 1e-6);
  EXPECT_NEAR(coarse / fine, 16, 1.6);
  EXPECT_GT(std::abs(driven(signal, 80, true) - exact), 1000 * fine);  // two pieces inside one step
}

TEST(RungeKutta, ChoosesStepsThatDivideTheTick) {
  EXPECT_EQ(steps_per_tick(1e-3, 160), 1);
  EXPECT_EQ(steps_per_tick(1e-3, 997), 1);
  EXPECT_EQ(steps_per_tick(1e-3, 2001), 2);
  EXPECT_EQ(steps_per_tick(1e-3, 3.1e4), 16);
  EXPECT_EQ(steps_per_tick(0.02, 997), 10);
  EXPECT_EQ(steps_per_tick(0.02, 0), 1);
}

TEST(ASignal, HoldsItsPieceUpToAndWithTheEnd) {
  const Signal w1 = pair().signals[0].w[0];
  EXPECT_EQ(w1.value(0), 0);
  EXPECT_EQ(w1.value(2), 0);
  EXPECT_DOUBLE_EQ(w1.value(2.001), 2 * std::sin(pi * 2.001));
  EXPECT_DOUBLE_EQ(w1.value(5.5), -2);
  EXPECT_NEAR(w1.value(6), 0, 1e-14);  // still 2 sin, not cos
  EXPECT_DOUBLE_EQ(w1.value(6.001), std::cos(pi * 6.001));
  EXPECT_DOUBLE_EQ(w1.value(2, 2.0005), 2 * std::sin(pi * 2));  // a step that begins at the switch
  EXPECT_DOUBLE_EQ(w1.value(100), 1);                           // the last piece goes on
  EXPECT_EQ(Signal().value(1), 0);
  EXPECT_EQ(w1.value(20 * 0.1), 0);
  EXPECT_EQ(w1.value(2000 * 1e-3 * (1 + 1e-15)), 0);  // a tick that rounding has moved
}

TEST(TheExamples, HaveThePapersSignals) {
  const Example two = pair();
  EXPECT_DOUBLE_EQ(two.signals[1].w[0].value(1), .5 * std::sin(5 * pi - 1));
  EXPECT_DOUBLE_EQ(two.signals[1].w[0].value(8), std::cos(4 * pi));
  EXPECT_DOUBLE_EQ(two.signals[0].f[0].value(1), .5 * std::sin(19));
  EXPECT_DOUBLE_EQ(two.signals[0].f[0].value(10.1), 1 - std::sin(5 * pi * 10.1));
  EXPECT_DOUBLE_EQ(two.signals[1].f[0].value(3), std::cos(15 * pi));
  EXPECT_DOUBLE_EQ(two.signals[1].f[0].value(5), std::sin(2.5 * pi));
  EXPECT_DOUBLE_EQ(two.signals[0].d[0].value(3), std::sin(2.1 * pi));
  EXPECT_DOUBLE_EQ(two.signals[1].d[0].value(3), -std::cos(1.2 * pi));
  const Example four = areas(AreaOutputs::case_1);
  const Signal &w1 = four.signals[0].w[0], &w3 = four.signals[2].w[0];
  for (const auto& [t, w] : {std::pair{1.0, 0.0},
                             {2.5, .02 * std::sin(12.5 * pi)},
                             {4.2, .2 * std::sin(12.6 * pi)},
                             {8.5, .02 * std::sin(42.5 * pi)},
                             {10.0, 0.0}}) {
    EXPECT_NEAR(w1.value(t), w, 1e-14) << t;
  }
  for (const auto& [t, w] : {std::pair{5.0, 0.0}, {6.0, .6}, {7.0, .7}, {8.0, std::cos(4 * pi)}}) {
    EXPECT_NEAR(w3.value(t), w, 1e-14) << t;
  }
  EXPECT_TRUE(four.signals[1].w.empty());
  EXPECT_DOUBLE_EQ(areas(AreaOutputs::case_1, Topology::full, true).signals[1].w[0].value(2), std::sin(2));
  EXPECT_EQ(areas(AreaOutputs::case_1).network.couplings.size(), 12U);
  EXPECT_EQ(areas(AreaOutputs::case_1, Topology::ring).network.couplings.size(), 8U);
}

}  // namespace
}  // namespace vigil::observer::integration_test
