// Detectors on innovations whose law is known.
#include <cmath>

#include "engine/linalg/chi_square.hpp"
#include "engine/methods/detectors/detector.hpp"
#include "engine/random/draws.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::detectors_test {
namespace {

constexpr int kTicks = 20000;

std::unique_ptr<Detector> detector(const std::string& id, const Json& params) {
  const auto* entry = Registry<DetectorMake>::find(id);
  std::vector<Problem> problems;
  auto made = entry->make(Params(entry->params.complete(params, "", problems)));
  EXPECT_TRUE(problems.empty());
  return made;
}

const Eigen::Matrix2d& covariance() {
  static const Eigen::Matrix2d S{{2, .6}, {.6, .5}};
  return S;
}

/// Share of alarms among judged ticks, where the innovation is white with covariance S times `scale`.
double alarms(Detector& judge, double scale = 1, int first = 0) {
  const Eigen::Matrix2d root = covariance().llt().matrixL();
  const Draws draws(3, "innovation");
  int judged = 0, alarmed = 0;
  for (int k = first + 1; k <= first + kTicks; ++k) {
    const Eigen::Vector2d r = std::sqrt(scale) * root * Eigen::Vector2d(draws.normal(k, 0), draws.normal(k, 1));
    const Detection said = judge.judge(k, r, covariance());
    judged += said.judged ? 1 : 0;
    alarmed += said.alarm ? 1 : 0;
  }
  EXPECT_GT(judged, kTicks - 60);
  return static_cast<double>(alarmed) / judged;
}

TEST(Detectors, ChiSquareAlarmsAsOftenAsItSays) {
  for (const double alpha : {.01, .1}) {
    const auto judge = detector("chi_square", {{"alpha", alpha}});
    EXPECT_NEAR(alarms(*judge), alpha, 4 * std::sqrt(alpha * (1 - alpha) / kTicks));
  }
}

// Windows overlap: one in `window` alarms is independent of the others at worst.
TEST(Detectors, ChiSquareOverAWindow) {
  const auto judge = detector("chi_square", {{"alpha", .05}, {"window", 4}});
  EXPECT_NEAR(alarms(*judge), .05, 4 * std::sqrt(4 * .05 * .95 / kTicks));
  const Eigen::Vector2d r(1, 0);
  const Detection said = judge->judge(1, r, covariance());
  EXPECT_DOUBLE_EQ(said.threshold, chi_square_quantile(.95, 8));
  EXPECT_EQ(judge->tail(), 3);
}

TEST(Detectors, CusumFindsWhatIsSmallAndLasts) {
  const auto quiet = detector("cusum", {{"drift", .5}, {"threshold", 12}});
  EXPECT_LT(alarms(*quiet), .002);
  const auto attacked = detector("cusum", {{"drift", .5}, {"threshold", 12}});
  EXPECT_GT(alarms(*attacked, 2), .04);  // the middle term then has mean 1: an alarm every 24 ticks
}

TEST(Detectors, CusumIsTheRecursion) {
  const auto judge = detector("cusum", {{"drift", .25}, {"threshold", 3}, {"restart", true}});
  const Eigen::MatrixXd S = Eigen::Matrix<double, 1, 1>(4);
  double sum = 0;
  for (int k = 1; k <= 40; ++k) {
    const double r = 3 + std::sin(k);
    if (sum > 3) sum = 0;
    sum = std::max(0., sum + (r * r / 4 - 1) / std::sqrt(2.) - .25);
    const Detection said = judge->judge(k, Eigen::Matrix<double, 1, 1>(r), S);
    EXPECT_NEAR(said.statistic, sum, 1e-12);
    EXPECT_EQ(said.alarm, sum > 3);
  }
}

TEST(Detectors, WithoutACovarianceOnlyEnergiesJudge) {
  const Eigen::MatrixXd none;
  const Eigen::Vector2d r(3, 4);
  EXPECT_FALSE(detector("chi_square", Json::object())->judge(1, r, none).judged);
  EXPECT_FALSE(detector("cusum", Json::object())->judge(1, r, none).judged);
  const auto fixed = detector("fixed", {{"window", 1}, {"level", 20}});
  const Detection said = fixed->judge(1, r, none);
  EXPECT_TRUE(said.judged);
  EXPECT_EQ(said.statistic, 25);
  EXPECT_EQ(said.threshold, 20);
  EXPECT_TRUE(said.alarm);
}

TEST(Detectors, ACovarianceThatIsNoneIsNotJudged) {
  const Eigen::Matrix2d broken{{1, 2}, {2, 1}};
  EXPECT_FALSE(detector("chi_square", Json::object())->judge(1, Eigen::Vector2d(1, 1), broken).judged);
}

Json with_detector(const char* preset, const std::string& lane, const Json& detector) {
  Json document = Scenario::preset(preset).document();
  document["lanes"][lane]["detector"] = detector;
  return document;
}

// A bias on one sensor: its own node alarms, and no other more than without.
TEST(Detectors, OnALaneTheySeeWhatItsSensorHears) {
  Json document = with_detector("consensus", "isolated", {{"type", "chi_square"}});
  document["time"]["steps"] = 200;
  document["adversary"] = {
      {"glare",
       {{"type", "bias"}, {"on", Json::array({"sensor:4"})}, {"from", 101}, {"params", {{"vector", {30, 12}}}}}}};
  vigil::Run run(Scenario::from_json(document), {2, nullptr, {}});
  test::Capture capture;
  test::run_to_end(run, capture);
  const auto metrics = run.metrics();
  EXPECT_GT(test::metric(metrics, "isolated", "tpr", "4"), 0) << "then the filter believes its sensor";
  EXPECT_LT(test::metric(metrics, "isolated", "fpr", "4"), .1);
  EXPECT_EQ(test::metric(metrics, "isolated", "event", "4"), 1);
  EXPECT_LT(test::metric(metrics, "isolated", "delay", "4"), 5);
  EXPECT_LT(test::metric(metrics, "isolated", "fpr", "5"), .1);
}

TEST(Detectors, TakeLiveValuesAndKeepWhatTheyGathered) {
  const Eigen::MatrixXd S = Eigen::Matrix<double, 1, 1>(1);
  const Eigen::Matrix<double, 1, 1> r(2);
  const auto retuned = [](Detector& judge, const std::string& id, const Json& params) {
    std::vector<Problem> problems;
    judge.retune(Params(Registry<DetectorMake>::find(id)->params.complete(params, "", problems)));
  };
  const auto sum = detector("cusum", {{"drift", 0}, {"threshold", 100}});
  const double first = sum->judge(1, r, S).statistic;
  retuned(*sum, "cusum", {{"drift", 0}, {"threshold", 3}});
  const Detection second = sum->judge(2, r, S);
  EXPECT_DOUBLE_EQ(second.statistic, 2 * first);
  EXPECT_EQ(second.threshold, 3);
  EXPECT_TRUE(second.alarm);
  const auto square = detector("chi_square", {{"alpha", .01}});
  EXPECT_FALSE(square->judge(1, r, S).alarm);
  retuned(*square, "chi_square", {{"alpha", .1}});
  EXPECT_DOUBLE_EQ(square->judge(2, r, S).threshold, chi_square_quantile(.9, 1));
  EXPECT_TRUE(square->judge(3, r, S).alarm);
  const auto level = detector("fixed", {{"window", 2}, {"level", 20}});
  level->judge(1, r, S);
  retuned(*level, "fixed", {{"window", 2}, {"level", 3}});
  const Detection full = level->judge(2, r, S);
  EXPECT_EQ(full.statistic, 4) << "the mean over both";
  EXPECT_TRUE(full.alarm);
}

// The command acts before its tick, and only where a detector is attached and the parameter is declared live.
TEST(Detectors, TheirLiveValuesAreCommands) {
  Json document = with_detector("consensus", "isolated", {{"type", "chi_square"}});
  document["time"]["steps"] = 20;
  vigil::Run run(Scenario::from_json(document), {2, nullptr, {}});
  const auto change = [](const char* path, const Json& value) { return Json{{"params", {{path, value}}}}; };
  run.apply({11, change("lanes.isolated.detector.params.alpha", 0.2)});
  test::Capture capture;
  test::run_to_end(run, capture);
  const auto threshold = static_cast<std::size_t>(run.catalogue().find("lane.isolated.4.threshold"));
  EXPECT_DOUBLE_EQ(capture.frames[10].values[threshold], chi_square_quantile(.99, 2));
  EXPECT_DOUBLE_EQ(capture.frames[11].values[threshold], chi_square_quantile(.8, 2));
  for (const auto& [path, value] : {std::pair{"lanes.isolated.detector.params.window", Json(3)},
                                    std::pair{"lanes.isolated.detector.params.alpha", Json(2)},
                                    std::pair{"lanes.consensus.detector.params.alpha", Json(.1)},
                                    std::pair{"lanes.isolated.detector.type", Json("cusum")}}) {
    SCOPED_TRACE(path);
    vigil::Run other(Scenario::from_json(document), {2, nullptr, {}});
    EXPECT_THROW(other.prepare(change(path, value)), InputError);
  }
}

TEST(Detectors, ALaneWithoutAnInnovationSaysSo) {
  const Json document = with_detector("mrclam", "dead_reckoning", {{"type", "cusum"}});
  Json consensus = Scenario::preset("sparse").document();
  consensus["lanes"] = {{"pred", consensus["lanes"]["pred"]}};
  consensus["lanes"]["pred"]["detector"] = {{"type", "cusum"}};
  vigil::Run run(Scenario::from_json(consensus), {2, nullptr, {}});
  test::Capture capture;
  for (int k = 0; k < 10; ++k) run.step(capture);
  ASSERT_EQ(run.warnings().size(), 1U);
  EXPECT_NE(run.warnings().front().find("nothing to judge"), std::string::npos);
}

TEST(Detectors, RefuseWhatCannotBe) {
  const Json chi = {{"type", "chi_square"}};
  test::expect_refused(with_detector("replay-mixed", "repaired", chi), "/lanes/repaired/detector/type");
  test::expect_refused(with_detector("consensus", "isolated", {{"type", "chi_squared"}}),
                       "/lanes/isolated/detector/type");
  test::expect_refused(with_detector("consensus", "isolated", {{"type", "chi_square"}, {"params", {{"alpha", 1}}}}),
                       "/lanes/isolated/detector/params/alpha");
  Json monitor = with_detector("consensus", "isolated", chi);
  monitor["lanes"]["isolated"]["path"] = "monitor";
  test::expect_refused(monitor, "/lanes/isolated/detector/type");
}

}  // namespace
}  // namespace vigil::detectors_test
