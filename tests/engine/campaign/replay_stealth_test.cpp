/// Stealth: specification (replay), sections 7.2 and 12, the references of 7.2, the loop's fixed thresholds of 7.3, and
/// what watermarks find and cost.
#include <Eigen/Eigenvalues>

#include "tests/engine/campaign/replay_tables.hpp"
#include "tests/engine/runs/plain_tank.hpp"

namespace vigil::replay_stealth_test {
namespace {

using replay_tables::Campaign;
using replay_tables::Estimate;
using replay_tables::estimate_of;
using replay_tables::expect_agrees;
using replay_tables::kReplayPresets;
using replay_tables::mean_over;
using replay_tables::of_runs;
using replay_tables::replay_scenario;
using replay_tables::runs;
using test::Told;

Eigen::Matrix2d gain_of(const vigil::Run& run, const std::string& lane) {
  const Json K = run.design()[lane]["K"];
  return Eigen::Matrix2d{{K[0][0].get<double>(), K[0][1].get<double>()},
                         {K[1][0].get<double>(), K[1][1].get<double>()}};
}

// phi = (I - K C)(A + B L): how fast the estimator forgets that what it hears is old.
TEST(Replay72, TheEstimatorForgetsFast) {
  const Eigen::MatrixXd closed = replay::tank::A + replay::tank::B * test::plain::feedback();
  const double capped[] = {.404, .173, .190};
  const Eigen::Matrix2d gains[] = {Eigen::Matrix2d{{.5851, -.1609}, {.1749, .6167}},
                                   Eigen::Matrix2d{{.7848, -.2064}, {.2739, .9352}},
                                   Eigen::Matrix2d{{.7699, -.2032}, {.2662, .9114}}};
  for (int s = 0; s < 3; ++s) {
    const vigil::Run run(replay_scenario(kReplayPresets[s]), {1, nullptr, {}});
    const Eigen::Matrix2d K = gain_of(run, "zeta1");
    EXPECT_LT((K - gains[s]).cwiseAbs().maxCoeff(), 6e-5) << "section 4.5";
    const auto radius = [&](const Eigen::Matrix2d& gain) {
      const Eigen::MatrixXd phi = (Eigen::Matrix2d::Identity() - gain * replay::tank::C) * closed;
      return phi.eigenvalues().cwiseAbs().maxCoeff();
    };
    EXPECT_NEAR(radius(K), capped[s], 5e-4);
    const Json written = run.design()["as_written"];
    EXPECT_EQ(written["corner"], s == 0 ? "none" : "zeta = inf");
    EXPECT_EQ(written["blind"], s > 0);
    if (s > 0) {
      EXPECT_LT((gain_of(run, "as_written") - replay::tank::C.inverse()).norm(), 1e-12);
      EXPECT_TRUE(written["zeta"].is_null());
    }
    for (const auto& [lane, ignored] : run.scenario().document()["lanes"].items()) {
      if (lane != "as_written" && run.design()[lane].contains("blind")) {
        EXPECT_EQ(run.design()[lane]["blind"], false) << lane;
      }
    }
  }
}

double energy(const Told& told, const std::string& lane, int k) {
  return std::pow(told.of(lane, k, "residual.y1"), 2) + std::pow(told.of(lane, k, "residual.y2"), 2);
}

// The first replayed sample differs, the later ones have the energy of any other.
TEST(Replay72, TheReplayedResidualsEnergyIsThatOfAnyOther) {
  const int trials = runs(400, 2000);
  const Scenario scenario = replay_scenario("replay-mixed", {"zeta1"}, test::replay_case(2));
  std::vector<double> clean, later;
  std::vector<std::vector<double>> first(4);
  of_runs(scenario, trials, [&](const Told& told) {
    double sum = 0;
    for (int k = 50; k < 250; ++k) sum += energy(told, "zeta1", k);
    clean.push_back(sum / 200);
    for (int i = 0; i < 4; ++i) first[static_cast<std::size_t>(i)].push_back(energy(told, "zeta1", 250 + i));
    sum = 0;
    for (int k = 254; k <= 300; ++k) sum += energy(told, "zeta1", k);
    later.push_back(sum / 47);
    return 0.0;
  });
  expect_agrees(estimate_of(clean), {.0639, .00005, 2000}, "clean");
  expect_agrees(estimate_of(later), {.0631, .00005, 2000}, "later");
  const double expected[] = {.158, .068, .062, .066};
  for (std::size_t i = 0; i < 4; ++i)
    expect_agrees(estimate_of(first[i]), {expected[i], .0005, 2000}, "replayed sample " + std::to_string(i));
  EXPECT_GT(estimate_of(first[0]).mean, 2 * estimate_of(clean).mean);
}

// TPR within four standard errors of the flag rate in the same window without an attack, run by run on the same draws.
TEST(Replay72, TheRateInAnAttackIsTheRateWithoutOne) {
  for (const char* preset : kReplayPresets) {
    for (const auto& [number, from, to] : {std::tuple{1, 101, 180}, std::tuple{2, 250, 300}}) {
      const std::vector<std::string> lanes{"as_written", "innov", "zeta1", "zeta1_freeze"};
      std::map<std::string, std::vector<double>> attacked, spared;
      const auto measure = [&, first = from, last = to](std::map<std::string, std::vector<double>>& rates) {
        return [&rates, &lanes, first, last](const Told& told) {
          for (const std::string& lane : lanes) rates[lane].push_back(mean_over(told, lane, "alarm", first, last));
          return 0.0;
        };
      };
      of_runs(replay_scenario(preset, lanes, test::replay_case(number)), 200, measure(attacked));
      of_runs(replay_scenario(preset, lanes, test::no_attack()), 200, measure(spared));
      for (const std::string& lane : lanes) {
        const Estimate with = estimate_of(attacked[lane]), without = estimate_of(spared[lane]);
        EXPECT_LE(std::abs(with.mean - without.mean), 4 * std::hypot(with.error, without.error))
            << preset << ", case " << number << ", " << lane << ": " << with.mean << " with, " << without.mean;
      }
    }
  }
}

double tpr(const Json& patch, const std::string& preset, const std::string& lane, int trials) {
  return Campaign(replay_scenario(preset, {lane}, patch), trials).mean(lane, "tpr");
}

// Path `loop`: a fixed threshold misses what is stealthy.
TEST(Replay73, FixedThresholdsInTheLoopMissIt) {
  for (const char* preset : kReplayPresets) {
    for (const char* lane : {"fixed_norm", "fixed_square"}) {
      const Json patch = {{"lanes", {{lane, {{"path", "loop"}}}}}};
      EXPECT_LE(tpr(patch, preset, lane, 200), .0105) << preset << " " << lane;
    }
  }
}

Json referenced(const char* reference, int number) {
  Json patch = test::replay_case(number);
  patch["controller"]["params"]["reference"] = reference;
  return patch;
}

// A feed-forward that differs between recording and replay makes the replay visible; case 2 is shifted by exactly five
// periods of the sine, and stealthy again.
TEST(Replay72, AReferenceThatMovesUncoversTheReplay) {
  const Campaign sine(replay_scenario("replay-mixed", {"zeta1_freeze"}, referenced("sine", 1)), 200);
  expect_agrees(estimate_of(sine, "zeta1_freeze", "tpr"), {1.000}, "sine, case 1, tpr");
  expect_agrees(estimate_of(sine, "zeta1_freeze", "fpr"), {.143}, "sine, case 1, fpr");
  const Campaign again(replay_scenario("replay-mixed", {"zeta1_freeze"}, referenced("sine", 2)), 200);
  expect_agrees(estimate_of(again, "zeta1_freeze", "tpr"), {.15, .005}, "sine, case 2, tpr");
}

TEST(Replay72, AReferenceThatMovesRaisesTheStatistic) {
  const auto mean_statistic = [](const char* reference, int from) {
    return estimate_of(of_runs(replay_scenario("replay-mixed", {"innov"}, referenced(reference, 1)), 200,
                               [from](const Told& told) { return mean_over(told, "innov", "statistic", from, 180); }));
  };
  expect_agrees(mean_statistic("zero", 105), {1.84, .005}, "zero, from 105");
  expect_agrees(mean_statistic("step", 105), {74, .5}, "step, from 105");
  expect_agrees(mean_statistic("sine", 101), {120, .5}, "sine, from 101");
}

TEST(Watermark, FindsMoreTheLargerItIs) {
  for (const auto& [amplitude, expected] : {std::pair{.5, .240}, std::pair{1., .724}, std::pair{2., .980}}) {
    const Json patch = {{"lanes", {{"repaired", {{"params", {{"amplitude", amplitude}}}}}}}};
    const Campaign ours(replay_scenario("replay-mixed", {"repaired"}, patch), 200);
    expect_agrees(estimate_of(ours, "repaired", "tpr"), {expected}, "amplitude " + std::to_string(amplitude));
  }
}

// E(x'x + u'u), scenario 3 with zeta_max = inf and no attack: what a mark in the input costs.
TEST(Watermark, OfTheInputCostsControl) {
  for (const auto& [amplitude, expected, half] :
       {std::tuple{0., 2.96, .005}, std::tuple{2., 11.4, .05}, std::tuple{4., 36.7, .05}}) {
    Json patch = test::no_attack();
    patch["lanes"]["as_written"]["params"] = {{"watermark", "control"}, {"amplitude", amplitude}};
    const auto cost = [](const Told& told) {
      double sum = 0;
      for (int k = 1; k <= 300; ++k) {
        for (const char* what : {"truth.x1", "truth.x2", "input.u1"})
          sum += std::pow(told.of("as_written", k, what), 2);
      }
      return sum / 300;
    };
    expect_agrees(estimate_of(of_runs(replay_scenario("replay-mixed", {"as_written"}, patch), 200, cost)),
                  {expected, half}, "amplitude " + std::to_string(amplitude));
  }
}

}  // namespace
}  // namespace vigil::replay_stealth_test
