/// Estimation errors: specification (replay), sections 4, 8.1, 8.2 and 9. From attack-free twins, ticks 20 to 300.
#include "tests/engine/campaign/replay_tables.hpp"

namespace vigil::replay_errors_test {
namespace {

using replay_tables::Campaign;
using replay_tables::Estimate;
using replay_tables::estimate_of;
using replay_tables::expect_agrees;
using replay_tables::kReplayPresets;
using replay_tables::replay_scenario;

constexpr int kTheirs = 120;  // runs of the reference implementation in these tables

Json law(const char* name) { return {{"noise", {{"law", name}}}}; }
Json bounded(const char* name) { return {{"noise", {{"bounded", name}}}}; }

struct Error {
  int scenario;
  const char* lane;
  Json patch;
  double rmse, peak, half_rmse = .0005, half_peak = .005;
};

TEST(Replay4, RmseAndPeaks) {
  const Error table[] = {{1, "as_written", law("gmix"), .370, 2.03},
                         {1, "as_written", law("laplace"), .369, 1.50},
                         {1, "as_written", law("skewmix"), .370, 1.29},
                         {2, "as_written", Json::object(), .390, .853, .0005, .0005},
                         {2, "zeta1", Json::object(), .328, .808, .0005, .0005},
                         {3, "as_written", Json::object(), .631, 3.53},
                         {3, "zeta1", Json::object(), .523, 2.82}};
  for (const Error& row : table) {
    const std::string what = std::to_string(row.scenario) + " " + row.lane + " " + row.patch.dump();
    const Campaign ours(replay_scenario(kReplayPresets[row.scenario - 1], {row.lane}, row.patch), kTheirs);
    expect_agrees(estimate_of(ours, row.lane, "rmse_state"), {row.rmse, row.half_rmse, kTheirs}, what + " rmse");
    expect_agrees(estimate_of(ours, row.lane, "peak_error"), {row.peak, row.half_peak, kTheirs}, what + " peak");
  }
}

TEST(Replay4, PlainUfir) {
  const double expected[] = {.78, .61, .99};
  for (int s = 0; s < 3; ++s) {
    const Campaign ours(replay_scenario(kReplayPresets[s], {"ufir"}), kTheirs);
    expect_agrees(estimate_of(ours, "ufir", "rmse_state"), {expected[s], .005, kTheirs}, kReplayPresets[s]);
  }
}

/// 1 - mean peak / mean peak of the other, on the same draws run by run (delta method).
Estimate reduction(const Campaign& campaign, const std::string& other) {
  const auto &ours = campaign.values("as_written", "peak_error"), &theirs = campaign.values(other, "peak_error");
  const double mean = campaign.mean(other, "peak_error"), ratio = campaign.mean("as_written", "peak_error") / mean;
  std::vector<double> apart;
  for (std::size_t i = 0; i < ours.size(); ++i) apart.push_back((ours[i] - ratio * theirs[i]) / mean);
  return {1 - ratio, estimate_of(apart).error, campaign.trials()};
}

struct Kernel {
  double alpha, beta;
  const char* form;
  double expected[3];  ///< gmix, laplace, skewmix
};

class Replay81 : public testing::TestWithParam<Kernel> {};

// A property of the baseline's tuning: never one number without alpha, beta and form.
TEST_P(Replay81, PeakReductionAgainstGmeekf) {
  const Kernel& kernel = GetParam();
  const char* laws[] = {"gmix", "laplace", "skewmix"};
  for (std::size_t l = 0; l < 3; ++l) {
    Json patch = law(laws[l]);
    patch["lanes"]["gmeekf"]["params"] = {{"alpha", kernel.alpha}, {"beta", kernel.beta}, {"form", kernel.form}};
    const Campaign ours(replay_scenario(kReplayPresets[0], {"as_written", "gmeekf"}, patch), kTheirs);
    expect_agrees(reduction(ours, "gmeekf"), {kernel.expected[l], .005, kTheirs},
                  std::string(laws[l]) + " " + kernel.form + " " + Json{kernel.alpha, kernel.beta}.dump());
    if (kernel.alpha == 3) {
      EXPECT_GT(ours.mean("gmeekf", "unconverged"), 0) << "alpha = 3 hits the cap, and it is counted";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, Replay81,
                         testing::Values(Kernel{2, 2, "square", {.18, .18, .13}},
                                         Kernel{2, 5, "square", {.13, .06, .01}},
                                         Kernel{3, 2, "square", {.45, .44, .47}},
                                         Kernel{2, 5, "diff", {.64, .64, .68}}));

struct Zonotope {
  const char* law;
  double rmse, peak;          ///< of the zonotope filter
  double our_rmse, our_peak;  ///< of the proposed estimator, zeta_max = inf
};

TEST(Replay82, ErrorsOfTheZonotopeFilter) {
  for (const Zonotope& row :
       {Zonotope{"uniform", .292, .852, .390, .853}, Zonotope{"surface", .413, 1.100, .551, .870}}) {
    const Campaign ours(replay_scenario("replay-ubb", {"as_written", "zonotope"}, bounded(row.law)), kTheirs);
    const auto expect = [&](const char* lane, const char* metric, double value) {
      expect_agrees(estimate_of(ours, lane, metric), {value, .0005, kTheirs},
                    std::string(row.law) + " " + lane + " " + metric);
    };
    expect("zonotope", "rmse_state", row.rmse);
    expect("zonotope", "peak_error", row.peak);
    expect("as_written", "rmse_state", row.our_rmse);
    expect("as_written", "peak_error", row.our_peak);
  }
}

// The paper's 62.33 % does not come out: 0, 21 and -12 %.
TEST(Replay82, PeakReductionAgainstTheZonotopeFilter) {
  for (const auto& [name, expected] : {std::pair{"uniform", 0.}, std::pair{"surface", .21}, std::pair{"sine", -.12}}) {
    const Campaign ours(replay_scenario("replay-ubb", {"as_written", "zonotope"}, bounded(name)), kTheirs);
    expect_agrees(reduction(ours, "zonotope"), {expected, .005, kTheirs}, name);
  }
}

struct Rho {
  double rho, tpr[2], accuracy[2];  ///< accuracy 0: not printed
};

TEST(Replay82, RatesOfTheZonotopeWatermark) {
  for (const Rho& row : {Rho{1, {.479, .477}, {0, 0}}, Rho{2, {.823, .820}, {.953, .969}},
                         Rho{3, {.913, .908}, {.977, .984}}, Rho{4, {.947, .945}, {.986, .991}}}) {
    for (const int number : {1, 2}) {
      const auto c = static_cast<std::size_t>(number - 1);
      Json patch = test::replay_case(number);
      patch["lanes"]["zonotope"]["params"]["rho"] = row.rho;
      const Campaign ours(replay_scenario("replay-ubb", {"zonotope"}, patch), kTheirs);
      const std::string what = "rho " + std::to_string(row.rho) + ", case " + std::to_string(number);
      EXPECT_EQ(ours.row("zonotope", "fpr").max, 0) << what << ": guaranteed";
      expect_agrees(estimate_of(ours, "zonotope", "tpr"), {row.tpr[c], .0005, kTheirs}, what + " tpr");
      if (row.accuracy[c] > 0) {
        expect_agrees(estimate_of(ours, "zonotope", "accuracy"), {row.accuracy[c], .0005, kTheirs}, what + " accuracy");
      }
    }
  }
}

// No mark: a rotation keeps the norm, and hardly anything leaves the healthy set.
TEST(Replay82, WithoutAMarkNothingIsFound) {
  for (const int number : {1, 2}) {
    Json patch = test::replay_case(number);
    patch["lanes"]["zonotope"]["params"]["rho"] = 0;
    const Campaign ours(replay_scenario("replay-ubb", {"zonotope"}, patch), kTheirs);
    EXPECT_EQ(ours.row("zonotope", "tpr").max, 0);
    EXPECT_EQ(ours.row("zonotope", "fpr").max, 0);
  }
}

// Section 9: under a replay in the loop every estimator follows the replayed data. Scenario 1, case 1, whole horizon.
TEST(Replay9, EveryEstimatorFollowsTheReplay) {
  const Json whole = {{"metrics", {{"state", {{"from", 2}}}}}};
  const Campaign ours(replay_scenario(kReplayPresets[0], {"as_written", "gmeekf"}, whole), 200);
  constexpr int kFew = 20;
  expect_agrees(estimate_of(ours, "as_written", "rmse_state_attacked"), {1.24, .005, kFew}, "rmse");
  expect_agrees(estimate_of(ours, "as_written", "peak_error_attacked"), {5.24, .005, kFew}, "peak");
  expect_agrees(estimate_of(ours, "gmeekf", "peak_error_attacked"), {5.32, .005, kFew}, "peak of GMEEKF");
}

}  // namespace
}  // namespace vigil::replay_errors_test
