// State-secrecy codes as lanes have them: section 4.6.
#include "engine/core/input_error.hpp"
#include "tests/engine/methods/privacy/protection_rig.hpp"

namespace vigil::secrecy_protection_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const char* const kCodes[] = {"A", "L", "L_state"};

template <class Watch>
void run_engine(const Json& params, std::int64_t last, const rig::Events& events, Watch watch) {
  Knowledge known = rig::knowledge_of_model(privacy::engine_model());
  known.seed = 6;
  const VectorXd truth = rig::start(known, 6);
  known.protection = rig::protect(known, "secrecy_code", params);
  const auto lane = rig::fusion_lane(known, "stationary");
  rig::Audience audience(lane->fusion()->protection());
  rig::drive(*lane, known, truth, last, 6, events,
             [&](std::int64_t k, const VectorXd&, const Method& method, const MatrixXd& sent) {
               const FusionMethod& fusion = *method.fusion();
               audience.listen(fusion.public_tick(), sent, rig::audible(fusion.protection(), 2), nullptr);
               watch(k, method, sent, audience.members().at("fusing")->estimate());
             });
}

TEST(SecrecyProtection, WithoutLossesTheUserHasTheOptimalFusion) {
  for (const char* code : kCodes) {
    run_engine({{"code", code}}, 1000, {},
               [&](std::int64_t k, const Method& method, const MatrixXd& sent, const VectorXd&) {
                 ASSERT_LE((rig::mean(method, 2, 3) - method.fusion()->optimal()).norm(), 1e-9) << code << " " << k;
                 ASSERT_NEAR(method.fusion()->legitimate_trace(), 0.0071039, 5.1e-8);
                 if (k == 0) {
                   EXPECT_EQ(sent.col(0), rig::mean(method, 0, 3));
                 }
                 if (k == 1000) {
                   EXPECT_GT((sent.col(0) - rig::mean(method, 0, 3)).norm(), 1e-6);
                 }
               });
  }
}

// What the user gets is always the sensor's own estimate: it predicts what is lost, and the code goes on from the last
// message that came.
TEST(SecrecyProtection, WithLossesTheUserStaysNearTheOptimum) {
  rig::Events events;
  events.lost = [](std::int64_t k, int node) {
    return Draws(11, "losses").bernoulli(k, static_cast<std::uint32_t>(node), 0.3) || (k > 400 && k < 420);
  };
  for (const char* code : kCodes) {
    run_engine({{"code", code}}, 1000, events,
               [&](std::int64_t k, const Method& method, const MatrixXd&, const VectorXd&) {
                 const VectorXd difference = rig::mean(method, 2, 3) - method.fusion()->optimal();
                 ASSERT_LE(difference.norm(), 4) << code << " " << k;
                 if (!events.lost(k, 0) && !events.lost(k, 1) && k % 50 == 0) {
                   EXPECT_LE(method.fusion()->legitimate_trace(), 0.0071040) << code << " " << k;
                 }
               });
  }
}

TEST(SecrecyProtection, MessagesLostForLongAreFollowedByOneThatIsNotCoded) {
  rig::Events events;
  events.lost = [](std::int64_t k, int) { return k > 10 && k < 300; };
  for (const char* code : kCodes) {
    bool warned = false;
    run_engine({{"code", code}}, 320, events,
               [&](std::int64_t k, const Method& method, const MatrixXd& sent, const VectorXd&) {
                 EXPECT_TRUE(sent.allFinite());
                 if (k >= 300) {
                   EXPECT_LE((rig::mean(method, 2, 3) - method.fusion()->optimal()).norm(), 1e-6) << code << " " << k;
                 }
                 for (const std::string& text : method.warnings())
                   warned = warned || text.find("not coded") != std::string::npos;
               });
    EXPECT_EQ(warned, code[0] == 'L') << code;
  }
}

TEST(SecrecyProtection, ErrorsAreWhatTheTracesSay) {
  const privacy::FusionModel model = privacy::engine_model();
  rig::expect_no_gap(rig::gaps_of(model, "secrecy_code", {{"code", "A"}}, {0, 1, 2, 5, 80}, 1000));
  rig::expect_no_gap(rig::gaps_of(model, "secrecy_code", {{"code", "A"}, {"loss", 0.8}}, {80}, 600));
  const auto turn = rig::gaps_of(privacy::turning_target(), "secrecy_code", {{"code", "A"}}, {0, 1, 3, 30}, 600);
  rig::expect_no_gap(turn);
  EXPECT_EQ(turn.size(), 8U);  // of a plant that has no law, too
  rig::expect_no_gap(rig::gaps_of(model, "secrecy_code", {{"code", "L"}}, {0, 1, 4, 20, 40}, 1000));
  rig::expect_no_gap(rig::gaps_of(model, "secrecy_code", {{"code", "L_state"}}, {0, 1, 4, 20, 40}, 1000));
}

TEST(SecrecyProtection, TracesOfTheEngine) {
  for (const auto& [code, trace, index] : {std::tuple{"A", 0.08961, 3.66}, std::tuple{"L", 0.26958, 5.25}}) {
    run_engine({{"code", code}}, 800, {}, [&](std::int64_t k, const Method& method, const MatrixXd&, const VectorXd&) {
      if (k < 800) return;
      const FusionMethod& fusion = *method.fusion();
      const double eavesdropper = fusion.protection().eavesdropper_trace(fusion.public_tick(), "fusing");
      EXPECT_NEAR(eavesdropper, trace, 5.1e-6);
      EXPECT_NEAR(std::log2(eavesdropper / fusion.legitimate_trace()), index, 5.1e-3);
    });
  }
}

// Code L: as good as the user until the first miss, then nothing but the prior.
TEST(SecrecyProtection, OneMissEndsDecodingOfCodeL) {
  bool missed = false;
  run_engine({{"code", "L"}, {"loss", 0.02}}, 300, {},
             [&](std::int64_t, const Method& method, const MatrixXd&, const VectorXd& eavesdropper) {
               missed = missed || !method.fusion()->protection().audible(0);
               if (missed) {
                 EXPECT_EQ(eavesdropper.norm(), 0);
               } else {
                 EXPECT_LE((eavesdropper - method.fusion()->optimal()).norm(), 1e-9);
               }
             });
  EXPECT_TRUE(missed);
}

TEST(SecrecyProtection, WhoMissesNothingDecodesEverything) {
  for (const char* code : kCodes) {
    run_engine({{"code", code}, {"loss", 0}}, 600, {},
               [&](std::int64_t k, const Method& method, const MatrixXd&, const VectorXd& eavesdropper) {
                 ASSERT_LE((eavesdropper - method.fusion()->optimal()).norm(), 1e-9) << code << " " << k;
               });
  }
}

// Section 4.6: the last messages of a code from the state's covariance give the state away, those of code L nothing.
TEST(SecrecyProtection, WhatTheLastMessagesAreWorth) {
  const Knowledge known = rig::knowledge_of_model(privacy::engine_model());
  const Json leak = rig::protect(known, "secrecy_code", {{"code", "L_state"}})->design()["leak_after"];
  EXPECT_NEAR(leak["1"].get<double>(), 0.249, 5.1e-4);
  EXPECT_NEAR(leak["2"].get<double>(), 0.182, 5.1e-4);
  EXPECT_NEAR(leak["5"].get<double>(), 0.00671, 5.1e-6);
  const Json tight = rig::protect(known, "secrecy_code", {{"code", "L"}})->design()["leak_after"];
  for (const char* messages : {"1", "2", "5"}) EXPECT_NEAR(tight[messages].get<double>(), 0.26958, 5.1e-6) << messages;
}

TEST(SecrecyProtection, ListenersKnowNothingSecret) {
  for (const char* code : kCodes) {
    rig::expect_public_knowledge_only(privacy::engine_model(), "secrecy_code", {{"code", code}});
    rig::expect_public_knowledge_only(privacy::engine_model(), "secrecy_code", {{"code", code}, {"loss", 0}});
  }
}

TEST(SecrecyProtection, CodeLNeedsAStablePlant) {
  const Knowledge robot = rig::knowledge_of_model(privacy::linear_robot());
  for (const char* code : {"L", "L_state"}) {
    try {
      rig::protect(robot, "secrecy_code", {{"code", code}});
      ADD_FAILURE() << code;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().at(0).pointer, "/code");
    }
  }
  privacy::FusionModel flat = privacy::engine_model();
  flat.A.col(2).setZero();
  EXPECT_THROW(rig::protect(rig::knowledge_of_model(flat), "secrecy_code", {{"code", "L"}}), InputError);
  EXPECT_TRUE(std::isnan(rig::protect(robot, "secrecy_code")->eavesdropper_trace({}, "fusing")));
  EXPECT_THROW(rig::protect(robot, "secrecy_code", {{"loss", 1.5}}), InputError);
}

}  // namespace
}  // namespace vigil::secrecy_protection_test
