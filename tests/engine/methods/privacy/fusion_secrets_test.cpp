// What a protection hides, from whom, and what a fusion lane refuses.
#include <cmath>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/eavesdroppers.hpp"
#include "tests/engine/methods/privacy/fusion_rig.hpp"

namespace vigil::fusion_secrets_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Knowledge linear_robot(std::uint64_t seed = 1) {
  Knowledge known = rig::knowledge_of_model(privacy::linear_robot());
  known.seed = seed;
  return known;
}

/// One run, tick by tick.
struct Record {
  std::vector<privacy::PublicTick> ticks;
  std::vector<MatrixXd> sent, local;
  std::vector<VectorXd> fused, contaminated;
  std::vector<std::vector<char>> heard;
  std::vector<VectorXd> eve;
};

/// Gives signals their places in the order of their declaration.
struct Scope final : SignalScope {
  std::vector<std::string> names;
  int add(int output, const std::string& name, const std::string& /*unit*/, SignalKind /*kind*/) override {
    names.push_back(std::to_string(output) + "." + name);
    return static_cast<int>(names.size()) - 1;
  }
  int add_category(int output, const std::string& name, const std::vector<std::string>& /*words*/) override {
    return add(output, name, "", SignalKind::category);
  }
};

Record record(Knowledge known, const char* filter, const std::string& protection, const Json& params,
              std::int64_t last) {
  const VectorXd start = rig::start(known, 3);
  known.protection = rig::protect(known, protection, params);
  const auto lane = rig::fusion_lane(known, filter);
  Scope scope;
  lane->declare(scope);
  const auto eve = lane->fusion()->protection().eavesdropper("fusing");
  Record record;
  rig::drive(*lane, known, start, last, 3, {},
             [&](std::int64_t k, const VectorXd&, const Method& method, const MatrixXd& sent) {
               const FusionMethod& fusion = *method.fusion();
               const int n = known.plant->states();
               record.ticks.push_back(fusion.public_tick());
               record.sent.push_back(sent);
               MatrixXd local(n, 2);
               for (int i = 0; i < 2; ++i) local.col(i) = rig::mean(method, i, n);
               record.local.push_back(local);
               record.fused.push_back(rig::mean(method, 2, n));
               VectorXd values(static_cast<Eigen::Index>(scope.names.size()));
               method.publish({values.data(), scope.names.size()});
               record.contaminated.push_back(values);
               std::vector<char> heard(2);
               MatrixXd messages = sent;
               for (int i = 0; i < 2; ++i) {  // some are not overheard
                 heard[static_cast<std::size_t>(i)] = fusion.protection().audible(i) && (k + i) % 4 != 2;
                 if (!heard[static_cast<std::size_t>(i)]) messages.col(i).setConstant(std::nan(""));
               }
               eve->listen(fusion.public_tick(), messages, heard);
               record.heard.push_back(heard);
               record.eve.push_back(eve->estimate());
             });
  return record;
}

// Someone who was made from the public model alone and then only given the messages and the public ticks comes to the
// very same estimate: whatever the lane's own secrets are, they are not used.
TEST(FusionSecrets, AnEavesdropperKnowsTheMessagesAndWhatIsPublic) {
  const struct {
    const char *protection, *filter;
    Knowledge known;
  } lanes[] = {{"contamination", "time_varying", linear_robot(5)},
               {"complex_noise", "time_varying", linear_robot(5)},
               {"contamination", "extended", rig::knowledge_of_robot()},
               {"contamination", "stationary", rig::knowledge_of_model(privacy::engine_model())}};
  for (const auto& lane : lanes) {
    const Record heard = record(lane.known, lane.filter, lane.protection, Json::object(), 40);
    Knowledge public_part;
    public_part.plant = lane.known.plant;
    public_part.sensors = lane.known.sensors;
    public_part.prior = lane.known.prior;
    const auto fresh = privacy::fusing_eavesdropper(public_part);
    for (std::size_t k = 0; k < heard.ticks.size(); ++k) {
      MatrixXd messages = heard.sent[k];
      for (Eigen::Index i = 0; i < 2; ++i) {
        if (!heard.heard[k][static_cast<std::size_t>(i)]) messages.col(i).setConstant(std::nan(""));
      }
      fresh->listen(heard.ticks[k], messages, heard.heard[k]);
      EXPECT_EQ(fresh->estimate(), heard.eve[k]) << lane.protection << " " << k;
    }
  }
}

// The public tick and the legitimate user do not depend on the noise: another variance or seed changes messages alone.
TEST(FusionSecrets, TheNoiseReachesNobodyWhoKnowsTheWeights) {
  const Json params = {{"m", 3}, {"Q_a", 1}};
  const Record one = record(linear_robot(1), "time_varying", "contamination", params, 60);
  const Record loud = record(linear_robot(1), "time_varying", "contamination", {{"m", 3}, {"Q_a", 400}}, 60);
  const Record other = record(linear_robot(2), "time_varying", "contamination", params, 60);
  for (std::size_t k = 0; k < one.ticks.size(); ++k) {
    EXPECT_EQ(one.fused[k], loud.fused[k]);
    EXPECT_EQ(one.fused[k], other.fused[k]);
    EXPECT_EQ(one.ticks[k].nominal.W, loud.ticks[k].nominal.W);
    if (k == 0) continue;
    EXPECT_NE(one.sent[k], loud.sent[k]);
    EXPECT_NE(one.sent[k], other.sent[k]);
  }
}

// W Hb phi = 0; the rest is sent as it is; what is signalled as contaminated is what is.
TEST(FusionSecrets, TheNominalWeightsDoNotSeeTheNoise) {
  for (const char* filter : {"time_varying", "extended"}) {
    const bool robot = filter[0] == 'e';
    const Record run =
        record(robot ? rig::knowledge_of_robot() : linear_robot(), filter, "contamination", {{"m", robot ? 4 : 3}}, 60);
    EXPECT_EQ(run.contaminated[0].sum(), 0);
    EXPECT_EQ(run.sent[0], run.local[0]);
    for (std::size_t k = 1; k < run.ticks.size(); ++k) {
      EXPECT_EQ(run.contaminated[k].sum(), robot ? 4 : 3);
      VectorXd noise = VectorXd::Zero(run.contaminated[k].size());
      for (Eigen::Index c = 0; c < noise.size(); ++c) {
        if (run.contaminated[k][c] != 0)
          noise[c] = run.sent[k].data()[c];
        else
          EXPECT_EQ(run.sent[k].data()[c], run.local[k].data()[c]);
      }
      EXPECT_GT(noise.norm(), 0);
      EXPECT_LE((run.ticks[k].nominal.W * noise).norm(), 1e-9 * noise.norm());
      EXPECT_LE(
          (run.ticks[k].nominal.W * privacy::stack(robot ? 3 : 2, 2) - MatrixXd::Identity(robot ? 3 : 2, robot ? 3 : 2))
              .norm(),
          1e-9);
    }
  }
}

TEST(FusionSecrets, ComplexNoiseIsDecodedAsOftenAsItsLawSays) {
  const struct {
    double power, expected;
    int antennas;
  } cases[] = {{1, 0.6342, 2}, {5.6097, 0.2500, 2}, {1, std::exp(-0.05), 1}, {1, std::exp(-0.05) / 2.25, 3}};
  privacy::PublicTick tick;
  MatrixXd messages = MatrixXd::Zero(2, 2);
  for (const auto& [power, expected, antennas] : cases) {
    const Knowledge known = linear_robot();
    const auto noise = rig::protect(known, "complex_noise", {{"power", power}, {"na", antennas}})->clone();
    EXPECT_NEAR(noise->design()["success_probability"].get<double>(), expected, 5.1e-5);
    EXPECT_NEAR(noise->design()["extra_energy"].get<double>(), 2 * (antennas - 1) * power, 1e-12);
    const int ticks = 20000;
    int decoded[2] = {}, both = 0;
    for (tick.k = 0; tick.k < ticks; ++tick.k) {
      noise->encode(tick, messages);
      for (int i = 0; i < 2; ++i) decoded[i] += noise->audible(i);
      both += noise->audible(0) && noise->audible(1);
    }
    const auto deviation = [&](double p) { return 4 * std::sqrt(p * (1 - p) / ticks); };
    for (const int count : decoded)
      EXPECT_NEAR(count / static_cast<double>(ticks), expected, deviation(expected) + 5e-5);
    EXPECT_NEAR(both / static_cast<double>(ticks), expected * expected, deviation(expected * expected) + 1e-4);
  }
  EXPECT_EQ(messages, MatrixXd::Zero(2, 2));
}

TEST(FusionSecrets, AStaticChannelDecodesAlwaysOrNever) {
  for (const double power : {1.0, 5.6097}) {
    const Record run =
        record(linear_robot(), "time_varying", "complex_noise", {{"channel", "static"}, {"power", power}}, 20);
    const auto noise = rig::protect(linear_robot(), "complex_noise", {{"channel", "static"}, {"power", power}});
    EXPECT_EQ(noise->design()["success_probability"].get<double>(), power == 1 ? 1 : 0);
    EXPECT_EQ(run.heard[4][0], power == 1);
    if (power == 1) continue;
    VectorXd expected = Eigen::Vector2d(20, 1);  // (0, 1) after 20 steps of 1 s
    EXPECT_LE((run.eve[20] - expected).norm(), 1e-9);
  }
}

template <class Make>
std::string refusal(Make make) {
  try {
    make();
  } catch (const InputError& error) {
    return error.problems().front().pointer + ": " + error.problems().front().detail;
  }
  return "";
}

TEST(FusionSecrets, RefusesWhatDoesNotFit) {
  Knowledge known = linear_robot();
  known.graph = Graph(2, {{0, 1}});
  EXPECT_NE(refusal([&] { rig::fusion_lane(known, "extended"); }).find("fusion centre"), std::string::npos);
  const Knowledge robot = rig::knowledge_of_robot();
  EXPECT_EQ(refusal([&] { rig::fusion_lane(robot, "time_varying"); }).substr(0, 8), "/filter:");
  EXPECT_EQ(refusal([&] { rig::fusion_lane(robot, "extended"); }), "");
  privacy::FusionModel blind = privacy::linear_robot();
  blind.sensors[1] = {Eigen::RowVector2d(0, 1), MatrixXd::Identity(1, 1)};
  EXPECT_NE(refusal([&] { rig::fusion_lane(rig::knowledge_of_model(blind), "stationary"); }).find("sensor 2"),
            std::string::npos);
  EXPECT_EQ(refusal([&] { rig::fusion_lane(rig::knowledge_of_model(blind), "time_varying"); }), "");
  for (const int m : {4, 5}) {
    EXPECT_EQ(refusal([&] { rig::protect(linear_robot(), "contamination", {{"m", m}}); }).substr(0, 3), "/m:");
  }
  EXPECT_EQ(refusal([&] { rig::protect(linear_robot(), "contamination", {{"m", 4}, {"bounded_check", false}}); }), "");
}

TEST(FusionSecrets, WarnsOfWhatDoesNotHide) {
  const auto warnings = [](const Knowledge& known, int m) {
    Knowledge own = known;
    const VectorXd start = rig::start(own, 1);
    own.protection = rig::protect(own, "contamination", {{"m", m}, {"bounded_check", false}});
    const auto lane = rig::fusion_lane(own, "time_varying");
    rig::drive(*lane, own, start, 10, 1, {}, [](std::int64_t, const VectorXd&, const Method&, const MatrixXd&) {});
    std::string all;
    for (const std::string& sentence : lane->warnings()) all += sentence + ". ";
    return all;
  };
  EXPECT_EQ(warnings(linear_robot(), 3), "");
  EXPECT_NE(warnings(linear_robot(), 1).find("null_dim"), std::string::npos);
  EXPECT_NE(warnings(linear_robot(), 0).find("m is 0"), std::string::npos);
  privacy::FusionModel alone = privacy::linear_robot();
  alone.sensors.pop_back();
  EXPECT_NE(warnings(rig::knowledge_of_model(alone), 1).find("one sensor"), std::string::npos);
}

// An exact sensor of a plant without noise leaves an innovation without covariance: the filter predicts and says so.
TEST(FusionSecrets, ASingularInnovationIsAFault) {
  privacy::FusionModel exact = privacy::linear_robot();
  exact.P0 = MatrixXd::Zero(2, 2);
  exact.Q = MatrixXd::Zero(1, 1);
  exact.sensors[0].R = MatrixXd::Zero(2, 2);
  const Knowledge known = rig::knowledge_of_model(exact);
  const auto lane = rig::fusion_lane(known, "time_varying");
  FaultTable faults;
  faults.begin_tick(1);
  lane->predict(VectorXd(0), faults);
  lane->measure(rig::readings_at(known, Eigen::Vector2d(1, 1), 1, 1), faults);
  EXPECT_FALSE(faults.stopped());
  const auto found = rig::faults_of(faults, *lane);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, "update_failed");
  EXPECT_EQ(rig::mean(*lane, 0, 2), VectorXd(Eigen::Vector2d(1, 1)));
}

TEST(FusionSecrets, AnEstimateThatIsNoNumberStopsTheLane) {
  privacy::FusionModel fast = privacy::linear_robot();
  fast.A *= 1e200;
  const Knowledge known = rig::knowledge_of_model(fast);
  const auto lane = rig::fusion_lane(known, "extended");
  FaultTable faults;
  for (int k = 1; k <= 3 && !faults.stopped(); ++k) {
    faults.begin_tick(k);
    lane->predict(VectorXd(0), faults);
    lane->measure({VectorXd::Zero(2), VectorXd::Zero(2)}, faults);
  }
  EXPECT_TRUE(faults.stopped());
}

}  // namespace
}  // namespace vigil::fusion_secrets_test
