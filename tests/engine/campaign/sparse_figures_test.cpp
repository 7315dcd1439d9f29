/// Figures in the words of section 13 and 14 of the specification of seed 001: what options cost, when A1 fails, whom
/// nodes choose.
#include "engine/run/run.hpp"
#include "tests/engine/campaign/sparse_section13.hpp"

namespace vigil::sparse_figures_test {
namespace {

using namespace section13;

/// A figure printed without its error, from `count` runs: as uncertain as those many of ours.
void expect_of(const MetricSummary& row, double expected, double count, const std::string& what) {
  expect_agrees(row, {expected, row.se * std::sqrt(static_cast<double>(row.n) / count)}, what);
}

Json ring_of(double radius) {
  const double at[5][2] = {{-.6, .8}, {-1, 0}, {-.6, -.8}, {.6, -.8}, {0, -1}};
  Json patch = Json::object();
  for (std::size_t i = 0; i < 5; ++i)
    patch["nodes"][kNodes[i]]["sensor"]["params"]["position"] = {radius * at[i][0], radius * at[i][1], 0};
  return patch;
}

// 60 runs of the second implementation, node 4.
TEST(Section13, WhatOptionsCost) {
  const auto with = [](const char* param, const Json& value) { return lane_params("omp_game", {{param, value}}); };
  const std::vector<std::pair<Json, double>> table{{with("form", "inside"), 1.64},
                                                   {with("greedy", true), 0.98},
                                                   {with("kappa", 1), 1.06},
                                                   {with("kappa", 3), 0.91},
                                                   {with("printed_azimuth_row", true), 0.49},
                                                   {ring_of(3), 0.61},
                                                   {ring_of(5), 0.65},
                                                   {ring_of(20), 0.97}};
  for (const auto& [patch, expected] : table) {
    const Results results(lone("omp_game", patch), runs(30, 200));
    expect_of(results.row("omp_game", "mse_px", "4"), expected, 60, patch.dump());
    if (patch == with("greedy", true)) expect_of(results.row("omp_game", "mse_px", "1"), 0.0045, 60, "greedy, node 1");
    if (patch == with("kappa", 3)) expect_of(results.row("omp_game", "mse_px", "1"), 0.28, 60, "kappa 3, node 1");
  }
}

// 10 runs each.
TEST(Section13, OtherNoiseAndStart) {
  const double noisy[] = {0.31, 0.11, 1.31, 3.10, 0.008}, random[] = {0.086, 0.041, 0.42, 0.54, 0.008};
  const Results large(lone("omp_game", {{"noise", {{"Q", 4e-4}}}}), runs(30, 200)),
      start(lone("omp_game", {{"initial", {{"x0_random", true}}}}), runs(30, 200));
  for (std::size_t i = 0; i < 5; ++i) {
    expect_of(large.row("omp_game", "mse_px", kNodes[i]), noisy[i], 10, std::string("Q 0.02^2, node ") + kNodes[i]);
    expect_of(start.row("omp_game", "mse_px", kNodes[i]), random[i], 10, std::string("x0_random, node ") + kNodes[i]);
  }
  expect_of(large.row("omp_game", "alarm_rate_clean"), 0.45, 10, "alarms of the larger noise");
}

// Practically all of the error comes from the last second, when the majority is attacked: 200 runs of the second
// implementation; before, two digits of 10 runs.
TEST(Section13, WhereA1Fails) {
  const Json periods = {{"metrics",
                         {{"mse",
                           {{"mse_a", {{"component", "px"}, {"from", 1}, {"to", 59}}},
                            {"mse_b", {{"component", "px"}, {"from", 60}, {"to", 119}}},
                            {"mse_c", {{"component", "px"}, {"from", 120}, {"to", 179}}},
                            {"mse_d", {{"component", "px"}, {"from", 180}}}}}}}};
  const Results results(lone("omp_game", periods), runs(40, 200));
  const double last[] = {0.84, 0.39, 7.5, 10.8, 0.08};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(results.mean("omp_game", "mse_a", kNodes[i]), 2e-4, 0.7e-4);
    EXPECT_NEAR(results.mean("omp_game", "mse_b", kNodes[i]), 1e-4, 0.6e-4);
    EXPECT_NEAR(results.mean("omp_game", "mse_c", kNodes[i]), 1e-4, 0.6e-4);
    expect_of(results.row("omp_game", "mse_d", kNodes[i]), last[i], 200, std::string("9-10 s, node ") + kNodes[i]);
  }
}

class Choices final : public Sink {
 public:
  explicit Choices(const Catalogue& catalogue) {
    for (std::size_t i = 0; i < 5; ++i) {
      choice_[i] = catalogue.find(std::string("lane.omp_game.") + kNodes[i] + ".choice");
      state_[i] = catalogue.find(std::string("sensor.") + kNodes[i] + ".state");
    }
  }
  void mark(const Mark& /*mark*/) override {}
  void frame(const Frame& frame) override {
    const auto at = [&](int id) { return frame.values[static_cast<std::size_t>(id)]; };
    for (std::size_t i = 0; frame.k >= 6 && i < 5; ++i) {
      const bool attacked = at(state_[static_cast<std::size_t>(at(choice_[i]))]) != 0;
      if (frame.k < 180 && at(state_[i]) != 0) early += attacked ? 1 : 0;
      if (frame.k >= 186) late[i] += attacked ? 1.0 / 15 : 0;
    }
  }
  int early = 0;        ///< samples in 0.3-9 s at which an attacked node chose an attacked one
  double late[5] = {};  ///< share of 9.3-10 s at which the node chose an attacked one

 private:
  int choice_[5], state_[5];
};

// Figure 6. Two shares of ten runs of theirs and of ours.
TEST(Section13, WhomNodesChoose) {
  const Scenario scenario = lone("omp_game");
  const int trials = runs(30, 200);
  double sum[2] = {0, 0}, square[2] = {0, 0};
  for (int trial = 1; trial <= trials; ++trial) {
    vigil::Run run(scenario, {static_cast<std::uint64_t>(trial), nullptr, {}});
    Choices choices(run.catalogue());
    while (!run.done()) run.step(choices);
    EXPECT_EQ(choices.early, 0) << "seed " << trial;
    for (int n = 0; n < 2; ++n) {
      const double share = choices.late[n == 0 ? 1 : 3];
      sum[n] += share;
      square[n] += share * share;
    }
  }
  for (int n = 0; n < 2; ++n) {
    const double mean = sum[n] / trials, variance = (square[n] - trials * mean * mean) / (trials - 1);
    EXPECT_NEAR(mean, n == 0 ? 0.80 : 0.36, 4 * std::sqrt(variance / trials + variance / 10)) << n;
  }
}

}  // namespace
}  // namespace vigil::sparse_figures_test
