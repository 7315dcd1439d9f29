// Noise for differential privacy as lanes have it, at the sensors and at the centre: sections 3.2-3.5.
#include <tuple>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/dp_fusion.hpp"
#include "engine/methods/privacy/published_mean.hpp"
#include "tests/engine/methods/privacy/loss_rig.hpp"
#include "tests/engine/methods/privacy/protection_rig.hpp"

namespace vigil::dp_protection_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const Json kTurn = {{"H", {1, 0, 1, 0}}};

Json with(Json params, const char* name, const Json& value) {
  params[name] = value;
  return params;
}

template <class Watch>
void run_turn(const char* protection, const Json& params, std::int64_t last, Watch watch) {
  Knowledge known = rig::knowledge_of_model(privacy::turning_target());
  known.seed = 8;
  const VectorXd truth = rig::lawful_start(known, 8);
  known.protection = rig::protect(known, protection, params);
  const auto lane = rig::fusion_lane(known, "stationary");
  rig::Book book;
  lane->declare(book);
  rig::drive(*lane, known, truth, last, 8, {},
             [&](std::int64_t k, const VectorXd&, const Method& method, const MatrixXd& sent) {
               method.publish(book.values);
               watch(k, method, sent, book);
             });
}

TEST(DpProtection, TracesOfTheTurningTarget) {
  struct Row {
    Json shares;
    double user;
  };
  for (const Row& row : {Row{nullptr, 0.8632}, Row{{0, 1}, 0.1042}, Row{{1, 0}, 0.0994}}) {
    run_turn("dp_sensors", with(kTurn, "shares", row.shares), 30,
             [&](std::int64_t, const Method& method, const MatrixXd&, const rig::Book&) {
               const FusionMethod& fusion = *method.fusion();
               EXPECT_NEAR(fusion.legitimate_trace(), row.user, 5.1e-5);
               EXPECT_NEAR(fusion.protection().eavesdropper_trace(fusion.public_tick(), "fusing"), 1.0969, 5.1e-5);
               EXPECT_NEAR(fusion.optimal_trace(), 0.06415, 5.1e-6);
             });
  }
}

TEST(DpProtection, ErrorsAreWhatTheTracesSay) {
  const privacy::FusionModel model = privacy::turning_target();
  for (const Json& shares : {Json(nullptr), Json{0, 1}})
    rig::expect_no_gap(rig::gaps_of(model, "dp_sensors", with(kTurn, "shares", shares), {0, 1, 10, 30}, 400));
  const auto printed = rig::gaps_of(model, "dp_centre", kTurn, {0, 1, 5, 9, 10, 40}, 600);
  rig::expect_no_gap(printed);
  EXPECT_EQ(printed.size(), 12U);  // a zero estimate has no law where the plant has none
  rig::expect_no_gap(rig::gaps_of(model, "dp_centre", with(kTurn, "as_printed", false), {0, 9, 40}, 600));
  const auto stable = rig::gaps_of(privacy::engine_model(), "dp_centre", {{"kappa", 4}}, {0, 2, 3, 30}, 600);
  rig::expect_no_gap(stable);
  EXPECT_EQ(stable.size(), 12U);
}

TEST(DpProtection, TheUserOfACentresNoiseHasTheOptimalFusion) {
  run_turn("dp_centre", kTurn, 60, [&](std::int64_t, const Method& method, const MatrixXd& sent, const rig::Book&) {
    EXPECT_EQ(rig::mean(method, 2, 4), method.fusion()->optimal());
    EXPECT_NEAR(method.fusion()->legitimate_trace(), 0.06415, 5.1e-6);
    EXPECT_EQ(sent.col(1), rig::mean(method, 1, 4));
  });
}

TEST(DpProtection, ACentrePublishesTheMeanAndItsNoise) {
  std::vector<VectorXd> fused;
  const Draws draws(8, "protection.a");
  for (const bool printed : {true, false}) {
    fused.clear();
    run_turn("dp_centre", with(kTurn, "as_printed", printed), 40,
             [&](std::int64_t k, const Method& method, const MatrixXd&, const rig::Book& book) {
               fused.push_back(rig::mean(method, 2, 4));
               VectorXd expected = VectorXd::Zero(4), a(4);
               const auto count = std::min<std::size_t>(fused.size(), 10);
               for (std::size_t i = 0; i < count; ++i)
                 expected += fused[fused.size() - 1 - i] / static_cast<double>(count);
               draws.normals(k, a);
               expected += 2.179810 * 0.7371411 / (printed ? 1 : 10) * a;
               EXPECT_LE((*method.fusion()->protection().published() - expected).norm(), 1e-5);
               EXPECT_EQ(book.at("2/published.c3"), (*method.fusion()->protection().published())[3]);
             });
  }
}

// What is published of noisy estimates is the mean of their nominal fusion, not of the user's.
TEST(DpProtection, NoisySensorsPublishTheMeanOfTheirNominalFusion) {
  std::vector<VectorXd> fused;
  run_turn("dp_sensors", kTurn, 40,
           [&](std::int64_t, const Method& method, const MatrixXd& sent, const rig::Book& book) {
             fused.emplace_back(method.fusion()->public_tick().nominal.W * sent.reshaped());
             double expected = 0;
             const auto count = std::min<std::size_t>(fused.size(), 10);
             for (std::size_t i = 0; i < count; ++i)
               expected += fused[fused.size() - 1 - i][2] / static_cast<double>(count);
             EXPECT_NEAR(book.at("2/published.c2"), expected, 1e-9);
             EXPECT_EQ(method.fusion()->protection().published(), nullptr);
           });
}

TEST(DpProtection, ASensorWithoutAShareSendsInTheClear) {
  run_turn("dp_sensors", with(kTurn, "shares", {0, 1}), 10,
           [&](std::int64_t, const Method& method, const MatrixXd& sent, const rig::Book&) {
             EXPECT_EQ(sent.col(0), rig::mean(method, 0, 4));
             EXPECT_GT((sent.col(1) - rig::mean(method, 1, 4)).norm(), 1e-6);
           });
}

TEST(DpProtection, ListenersKnowNothingSecret) {
  rig::expect_public_knowledge_only(privacy::turning_target(), "dp_sensors", kTurn);
  rig::expect_public_knowledge_only(privacy::turning_target(), "dp_centre", kTurn);
}

// Section 3.5 as the lanes show it.
TEST(DpProtection, WhatTheGuaranteeCovers) {
  const Knowledge known = rig::knowledge_of_model(privacy::turning_target());
  const Json views = rig::protect(known, "dp_sensors", kTurn)->design()["views"];
  const std::map<std::string, std::pair<double, double>> rows{
      {"mean", {0.4588, 5.1e-5}},         {"mean_worst", {0.632, 5.1e-4}}, {"mean_difference", {1.026, 5.1e-4}},
      {"instant", {1.451, 5.1e-4}},       {"packets", {1.769, 5.1e-4}},    {"fused_stream", {1.533, 5.1e-4}},
      {"packet_stream", {1.845, 5.1e-4}}, {"sustained", {6.22, 5.1e-3}}};
  EXPECT_EQ(views.size(), rows.size());
  for (const auto& [view, row] : rows)
    EXPECT_NEAR(views.at(view).at("fused").at("mu").get<double>(), row.first, row.second) << view;
  EXPECT_NEAR(views["packets"]["fused"]["eps_at_delta"].get<double>(), 3.10, 5.1e-3);

  const Json clear = rig::protect(known, "dp_sensors", with(kTurn, "shares", {0, 1}))->design()["views"];
  EXPECT_TRUE(clear["packets"]["fused"]["mu"].is_null());
  EXPECT_EQ(clear["packets"]["fused"]["infinite"], true);
  EXPECT_EQ(clear["packet_stream"]["fused"]["p_loss"], 1);
  EXPECT_NEAR(clear["instant"]["fused"]["mu"].get<double>(), 1.451, 5.1e-4);
}

// As printed, a centre's noise is kappa times more than the mean needs (in deviation).
TEST(DpProtection, WhatACentresGuaranteeCovers) {
  const Knowledge known = rig::knowledge_of_model(privacy::turning_target());
  const Json printed = rig::protect(known, "dp_centre", kTurn)->design();
  const Json enough = rig::protect(known, "dp_centre", with(kTurn, "as_printed", false))->design();
  const auto mu = [](const Json& design, const char* view) {
    return design["views"][view]["fused"]["mu"].get<double>();
  };
  EXPECT_NEAR(mu(enough, "mean"), 0.4588, 5.1e-5);
  EXPECT_NEAR(mu(printed, "mean"), 0.04588, 5.1e-6);
  EXPECT_NEAR(mu(enough, "mean_worst"), 0.632, 5.1e-4);
  EXPECT_NEAR(mu(enough, "mean_difference"), 0.4588 / std::sqrt(2.0), 5.1e-5);
  EXPECT_GT(mu(enough, "mean_stream"), mu(enough, "mean_worst"));
  EXPECT_NEAR(mu(enough, "sustained"), 6.22, 5.1e-3);
  EXPECT_EQ(printed["views"]["packets"]["fused"]["infinite"], true);
  EXPECT_NEAR(printed["q"].get<double>(), 2.581896, 5.1e-7);
}

// Section 3.4: traces over kappa and over epsilon and delta, as figures 3-4 and 3-5 have them.
TEST(DpProtection, WhatItsParametersCost) {
  const Json surfaces =
      rig::protect(rig::knowledge_of_model(privacy::turning_target()), "dp_sensors", kTurn)->design()["surfaces"];
  const auto at = [](const Json& grid, double value) {
    const auto values = grid.get<std::vector<double>>();
    return static_cast<std::size_t>(std::find(values.begin(), values.end(), value) - values.begin());
  };
  const Json& along = surfaces["kappa"];
  for (const auto& [kappa, pdfe, cdfe, digit] : {std::tuple{5, 2.130, 1.661, 5.1e-4},
                                                 {10, 1.0969, 0.8632, 5.1e-5},
                                                 {20, 0.5805, 0.4645, 5.1e-5},
                                                 {40, 0.3223, 0.2650, 5.1e-5}}) {
    EXPECT_NEAR(along["pdfe"].at(at(along["values"], kappa)).get<double>(), pdfe, digit);
    EXPECT_NEAR(along["cdfe"].at(at(along["values"], kappa)).get<double>(), cdfe, digit);
  }
  const Json& plane = surfaces["epsilon_delta"];
  for (const auto& [epsilon, pdfe, cdfe, digit] :
       {std::tuple{0.3, 4.727, 3.666, 5.1e-4}, {1.0, 0.6171, 0.4927, 5.1e-5}, {2.0, 0.2458, 0.2059, 5.1e-5}}) {
    const auto row = at(plane["epsilon"], epsilon), column = at(plane["delta"], 0.1);
    EXPECT_NEAR(plane["pdfe"].at(row).at(column).get<double>(), pdfe, digit);
    EXPECT_NEAR(plane["cdfe"].at(row).at(column).get<double>(), cdfe, digit);
  }
}

// Figures 3-6 and 3-7.
TEST(DpProtection, TwoNeighbouringReleases) {
  const Knowledge known = rig::knowledge_of_model(privacy::turning_target());
  const Json releases = rig::protect(known, "dp_sensors", kTurn)->design()["releases"];
  ASSERT_EQ(releases.size(), 5U);
  EXPECT_NEAR(releases[4]["shift"].get<double>(), 0.0737, 5.1e-5);  // in the worst direction
  double square = 0;
  for (int c = 0; c < 4; ++c) {
    EXPECT_EQ(releases[c]["node"], "fused");
    EXPECT_NEAR(releases[c]["std"].get<double>(), 0.1607, 5.1e-5);
    square += std::pow(releases[c]["shift"].get<double>(), 2);
  }
  EXPECT_NEAR(std::sqrt(square), 0.0737, 5.1e-5);
  EXPECT_NEAR(rig::protect(known, "dp_centre", kTurn)->design()["releases"][0]["std"].get<double>(), 1.6068, 5.1e-5);
}

TEST(DpProtection, NothingToHide) {
  const Knowledge known = rig::knowledge_of_model(privacy::turning_target());
  for (const char* id : {"dp_sensors", "dp_centre"}) {
    rig::Mechanism mechanism(known, id, {{"H", {0, 0, 0, 0}}});
    for (int k = 0; k < 20; ++k) mechanism.tick();
    EXPECT_EQ(mechanism.messages.norm(), 0);
    EXPECT_EQ(mechanism.book().at("2/loss.mean"), 0);
    EXPECT_EQ(mechanism.protection().design()["views"]["packets"]["fused"]["mu"], 0);
  }
}

TEST(DpProtection, RefusesWhatItCannotDo) {
  const Knowledge known = rig::knowledge_of_model(privacy::turning_target());
  for (const Json& params : {Json{{"kappa", 0}}, Json{{"epsilon", -1}}, Json{{"delta", 0}}, Json{{"lambda", -1}},
                             Json{{"H", {1, 1}}}, Json{{"H", {1, 0.5, 1, 1}}}}) {
    EXPECT_THROW(rig::protect(known, "dp_sensors", params), InputError) << params.dump();
    EXPECT_THROW(rig::protect(known, "dp_centre", params), InputError) << params.dump();
  }
  for (const Json& shares : {Json{1}, Json{0.5, 0.4}, Json{2, -1}})
    EXPECT_THROW(rig::protect(known, "dp_sensors", {{"shares", shares}}), InputError) << shares.dump();
  EXPECT_THROW(rig::protect(rig::knowledge_of_robot(), "dp_sensors"), InputError);
}

}  // namespace
}  // namespace vigil::dp_protection_test
