/// Where the theorem's conditions hold: profile `compass`. Section 12 and section 10.
#include "tests/engine/campaign/section12.hpp"

namespace vigil::compass_test {
namespace {

using section12::expect_agrees;
using section12::only;
using section12::Results;
using section12::runs;

const Scenario& compass() {
  static const Scenario scenario = Scenario::preset("consensus-compass");
  return scenario;
}

Scenario with_bound(const char* bound, const std::vector<std::string>& lanes = {"consensus"}) {
  Scenario scenario = only(compass(), lanes);
  return scenario.with("lanes.consensus.params.bound", bound);
}

// 1000 runs: consensus 0.7095 +- 0.0013. clean and isolated are printed without errors, which are taken as consensus'.
TEST(Compass, HasItsFiguresAndNeverStops) {
  const Results results(compass(), runs(150, 500));
  EXPECT_EQ(results.stopped(), 0) << "(28) and (29) hold at every step of every run";
  EXPECT_EQ(results.row("consensus", "first_infeasible_step").n, 0);
  EXPECT_EQ(results.row("consensus", "faults").max, 0);
  expect_agrees(results.row("consensus", "rmse_position"), {0.7095, 0.0013}, "consensus");
  expect_agrees(results.row("clean", "rmse_position"), {0.7035, 0.0013}, "clean");
  expect_agrees(results.row("isolated", "rmse_position"), {0.3626, 0.0013}, "isolated");
  EXPECT_EQ(results.row("consensus", "bound_guaranteed").max, 0) << "mode paper, two neighbours";
  EXPECT_EQ(results.row("isolated", "nees_mean").n, runs(150, 500));
}

TEST(Compass, GuaranteesItsBoundInValidModesOnly) {
  const int trials = runs(10, 100);
  for (const char* bound : {"corrected", "tight"}) {
    const Results results(with_bound(bound), trials);
    EXPECT_EQ(results.row("consensus", "bound_guaranteed").min, 1) << bound;
    EXPECT_EQ(results.stopped(), 0) << bound;
  }
  // One neighbour each: the paper's own multipliers are valid.
  const Json pairs = Json::parse(R"({"network":{"graph":"edges","edges":[[1,2],[3,4],[5,6],[7,8]]}})");
  EXPECT_EQ(Results(with_bound("paper").patched(pairs), trials).row("consensus", "bound_guaranteed").min, 1);
  EXPECT_EQ(Results(with_bound("paper"), trials).row("consensus", "bound_guaranteed").max, 0);
  expect_agrees(Results(with_bound("tight"), runs(150, 500)).row("consensus", "rmse_position"), {0.3655, 0.0012},
                "tight");
}

// With M = 3000 runs of 10 steps at most 1.05; with fewer, inflated by about (1 + sqrt(3/M))^2: relative to 3000
// runs 1.13 at M = 300.
TEST(Compass, BoundBounds) {
  const int trials = runs(300, 3000);
  const double limit =
      trials >= 3000 ? 1.05 : 1.05 * std::pow((1 + std::sqrt(3.0 / trials)) / (1 + std::sqrt(3.0 / 3000)), 2);
  const Results results(with_bound("corrected").with("time.steps", 10), trials);
  EXPECT_LE(results.mean("consensus", "bound_ratio_max"), limit);
  EXPECT_GT(results.mean("consensus", "bound_ratio_max"), 0.5) << "a bound, not a mountain";
  const Results ordinary(only(compass(), {"isolated"}).with("time.steps", 10), trials);
  EXPECT_LE(ordinary.mean("isolated", "bound_ratio_max"), 1.3 * limit);
}

}  // namespace
}  // namespace vigil::compass_test
