// The two-step mechanism as a lane has it: sections 4.2-4.5 and 4.7.
#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/two_step.hpp"
#include "tests/engine/methods/privacy/protection_rig.hpp"

namespace vigil::two_step_protection_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const Json kDefaults = Json::object();

privacy::TwoStep engine_design() {
  privacy::TwoStepSettings settings;
  settings.H = Eigen::Vector3d::Ones();
  return privacy::design_two_step(privacy::engine_model(), settings);
}

/// Runs the engine's lane and gives what its user had at every tick.
template <class Watch>
void run_engine(const Json& params, std::int64_t last, const rig::Events& events, Watch watch) {
  Knowledge known = rig::knowledge_of_model(privacy::engine_model());
  known.seed = 5;
  const VectorXd truth = rig::start(known, 5);
  known.protection = rig::protect(known, "two_step", params);
  const auto lane = rig::fusion_lane(known, "stationary");
  rig::drive(
      *lane, known, truth, last, 5, events,
      [&](std::int64_t k, const VectorXd&, const Method& method, const MatrixXd& sent) { watch(k, method, sent); });
}

TEST(TwoStepProtection, TheUserHasTheCompensatedFusionOfTheNoisyEstimates) {
  const privacy::TwoStep design = engine_design();
  const Draws xi(5, "protection.xi");
  run_engine(kDefaults, 1300, {}, [&](std::int64_t k, const Method& method, const MatrixXd&) {
    VectorXd noisy(6), z(6);
    xi.normals(k, z);
    for (int i = 0; i < 2; ++i)
      noisy.segment(3 * i, 3) =
          rig::mean(method, i, 3) + std::sqrt(design.q_xi[static_cast<std::size_t>(i)]) * z.segment(3 * i, 3);
    ASSERT_LE((rig::mean(method, 2, 3) - design.compensated.W * noisy).norm(), 1e-10) << k;
    ASSERT_NEAR(method.fusion()->legitimate_trace(), 0.0127116, 5.1e-8);
  });
}

TEST(TwoStepProtection, TheFirstMessageIsAWindowOfTheFirstEstimate) {
  const Draws xi(5, "protection.xi");
  run_engine(kDefaults, 0, {}, [&](std::int64_t, const Method& method, const MatrixXd& sent) {
    VectorXd z(6);
    xi.normals(0, z);
    const double deviation = std::sqrt(engine_design().q_xi[0]);
    EXPECT_LE((sent.col(0) - 5 * (rig::mean(method, 0, 3) + deviation * z.head(3))).norm(), 1e-12);
  });
}

TEST(TwoStepProtection, NullSpaceNoiseDoesNotTouchTheUser) {
  std::vector<VectorXd> quiet, messages;
  run_engine(kDefaults, 300, {}, [&](std::int64_t, const Method& method, const MatrixXd& sent) {
    quiet.push_back(rig::mean(method, 2, 3));
    messages.emplace_back(sent.reshaped());
  });
  run_engine({{"q_alpha", 0.04}}, 300, {}, [&](std::int64_t k, const Method& method, const MatrixXd& sent) {
    const auto at = static_cast<std::size_t>(k);
    EXPECT_LE((rig::mean(method, 2, 3) - quiet[at]).norm(), 1e-10);
    if (k > 0) {
      EXPECT_GT((sent.reshaped() - messages[at]).norm(), 1e-3);
    }
  });
}

TEST(TwoStepProtection, ErrorsAreWhatTheTracesSay) {
  const auto gaps = rig::gaps_of(privacy::engine_model(), "two_step", kDefaults, {0, 1, 3, 6, 50, 100}, 400);
  rig::expect_no_gap(gaps);
  EXPECT_EQ(gaps.size(), 6 * 4 - 3U);  // no window mean before its window is full
  const auto louder = rig::gaps_of(privacy::engine_model(), "two_step",
                                   {{"tq", 2}, {"q_alpha", 0.04}, {"q_xi", {0.01, 0.02}}}, {1, 2, 3, 20}, 400);
  rig::expect_no_gap(louder);
}

TEST(TwoStepProtection, TracesOfTheEngine) {
  run_engine(kDefaults, 100, {}, [&](std::int64_t k, const Method& method, const MatrixXd&) {
    const FusionMethod& fusion = *method.fusion();
    const auto trace = [&](const char* variant) {
      return fusion.protection().eavesdropper_trace(fusion.public_tick(), variant);
    };
    if (k == 1) {
      EXPECT_NEAR(trace("differencing"), 0.02463, 5.1e-6);
    }
    if (k == 100) {
      EXPECT_NEAR(trace("differencing"), 0.35644, 5.1e-6);
      EXPECT_NEAR(std::log2(trace("differencing") / fusion.legitimate_trace()), 4.81, 5.1e-3);
      EXPECT_NEAR(trace("window_mean"), 0.0242, 1e-4);
      EXPECT_NEAR(std::log2(trace("window_mean") / fusion.legitimate_trace()), 0.93, 5.1e-3);
      EXPECT_NEAR(trace("zero"), 0.26958, 5.1e-6);
    }
    EXPECT_EQ(std::isnan(trace("window_mean")), k < 5);
    EXPECT_TRUE(std::isnan(trace("fusing")));
  });
}

// In the tick whose message is lost, and in the next, the user predicts; after that it recurses on what it then had.
TEST(TwoStepProtection, ALostMessageIsPredictedAndStaysInTheSums) {
  const privacy::FusionModel model = privacy::engine_model();
  const privacy::TwoStep design = engine_design();
  const Draws xi(5, "protection.xi");
  rig::Events events;
  events.lost = [](std::int64_t k, int node) { return k == 20 && node == 1; };
  std::vector<VectorXd> user, intended;
  bool warned = false;
  run_engine(kDefaults, 60, events, [&](std::int64_t k, const Method& method, const MatrixXd&) {
    VectorXd noisy(6), z(6);
    xi.normals(k, z);
    for (int i = 0; i < 2; ++i)
      noisy.segment(3 * i, 3) =
          rig::mean(method, i, 3) + std::sqrt(design.q_xi[static_cast<std::size_t>(i)]) * z.segment(3 * i, 3);
    user.push_back(rig::mean(method, 2, 3));
    intended.emplace_back(design.compensated.W * noisy);
    EXPECT_EQ(std::isnan(method.fusion()->legitimate_trace()), k >= 20);
    warned = !method.warnings().empty();
  });
  EXPECT_TRUE(warned);
  for (std::size_t k = 0; k < user.size(); ++k) {
    const bool predicted = k == 20 || k == 21;
    if (predicted) {
      EXPECT_LE((user[k] - model.A * user[k - 1]).norm(), 1e-12);
    }
    const std::size_t since = k >= 20 && k % 5 < 2 ? 20 + k % 5 : k;  // k mod 5 is 0 or 1: its sum goes back to a guess
    if (since == k && !predicted) {
      EXPECT_LE((user[k] - intended[k]).norm(), 1e-10) << k;
    } else {
      EXPECT_LE((user[k] - intended[k] - (user[since] - intended[since])).norm(), 1e-10) << k;
      EXPECT_GT((user[k] - intended[k]).norm(), 1e-4) << k;
    }
  }
}

TEST(TwoStepProtection, AllMessagesLostFromTheFirstOn) {
  rig::Events events;
  events.lost = [](std::int64_t k, int) { return k < 3 || (k > 40 && k < 60); };
  run_engine(kDefaults, 100, events, [&](std::int64_t k, const Method& method, const MatrixXd&) {
    EXPECT_TRUE(rig::mean(method, 2, 3).allFinite());
    if (k < 3) {
      EXPECT_LE(rig::mean(method, 2, 3).norm(), 1e-12);  // the prior's mean
    }
  });
}

TEST(TwoStepProtection, ListenersKnowNothingSecret) {
  rig::expect_public_knowledge_only(privacy::engine_model(), "two_step", kDefaults);
}

TEST(TwoStepProtection, Warns) {
  const Knowledge known = rig::knowledge_of_model(privacy::engine_model());
  const auto warnings = [&](const Json& params) { return rig::protect(known, "two_step", params)->warnings(); };
  EXPECT_TRUE(warnings(kDefaults).empty());
  EXPECT_NE(warnings({{"tq", 1}}).at(0).find("tq is 1"), std::string::npos);
  const auto silent = warnings({{"q_xi", {0, 0}}});
  ASSERT_EQ(silent.size(), 3U);  // neither sensor is private enough, and nothing leaks
  EXPECT_NE(silent[0].find("dp_ok"), std::string::npos);
  EXPECT_NE(silent[2].find("leak is 0"), std::string::npos);
  EXPECT_EQ(rig::protect(known, "two_step", {{"q_xi", {0, 0}}})->design()["dp_ok"], false);
}

TEST(TwoStepProtection, OneSensorAloneHasNoNullSpace) {
  privacy::FusionModel model = privacy::engine_model();
  model.sensors.resize(1);
  const auto protection = rig::protect(rig::knowledge_of_model(model), "two_step");
  EXPECT_NEAR(protection->design()["leak"].get<double>(), 0, 1e-12);
  EXPECT_EQ(protection->warnings().size(), 2U);
  rig::expect_no_gap(rig::gaps_of(model, "two_step", kDefaults, {0, 1, 12}, 300));
}

TEST(TwoStepProtection, ShowsItsDesign) {
  const Json design = rig::protect(rig::knowledge_of_model(privacy::engine_model()), "two_step")->design();
  EXPECT_NEAR(design["gamma"].get<double>(), 2.179810, 5.1e-7);
  EXPECT_NEAR(design["views_design_mu"].get<double>(), 0.4588, 5.1e-5);
  EXPECT_NEAR(design["q_xi"][1].get<double>(), 0.0043045, 5.1e-8);
  EXPECT_NEAR(design["slope"].get<double>(), 0.003403, 5.1e-7);
  EXPECT_NEAR(design["W"][1][3].get<double>(), -0.1566, 5.1e-5);
  const Json& stream = design["views"]["stream"];
  EXPECT_NEAR(stream["1"]["mu"].get<double>(), 1.131, 5.1e-4);
  EXPECT_NEAR(stream["2"]["eps_at_delta"].get<double>(), 1.18, 5.1e-3);
  EXPECT_NEAR(stream["1"]["p_loss"].get<double>(), 0.481, 0.014);  // the specification sampled it
  EXPECT_EQ(design["dp_ok"], true);
  ASSERT_EQ(design["releases"].size(), 6U);  // figure 4-4: a message of each sensor, by component
  const privacy::TwoStep exact = engine_design();
  EXPECT_EQ(design["releases"][4]["node"], "2");
  EXPECT_NEAR(design["releases"][4]["std"].get<double>(), std::sqrt(exact.Qphi[1](1, 1)), 1e-12);
  EXPECT_LT(design["releases"][4]["shift"].get<double>(), design["releases"][4]["std"].get<double>());
}

TEST(TwoStepProtection, RefusesWhatItCannotDo) {
  const Knowledge known = rig::knowledge_of_model(privacy::engine_model());
  for (const Json& params : {Json{{"tq", 0}}, Json{{"epsilon", 0}}, Json{{"delta", 0.5}}, Json{{"zeta", -1}},
                             Json{{"H", {1, 1}}}, Json{{"H", {1, 0.5, 1}}}, Json{{"q_xi", {1}}}, Json{{"Rg", 0}}})
    EXPECT_THROW(rig::protect(known, "two_step", params), InputError) << params.dump();
  EXPECT_THROW(rig::protect(rig::knowledge_of_robot(), "two_step"), InputError);
}

}  // namespace
}  // namespace vigil::two_step_protection_test
