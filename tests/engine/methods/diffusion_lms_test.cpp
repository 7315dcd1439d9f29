/// Secure diffusion LMS by hand: two steps of three scalar nodes, medians of even counts, lost and falsified messages.
/// Specification of seed 001, section 11, A5.
#include <gtest/gtest.h>

#include "tests/engine/methods/linear_plant.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::diffusion_lms_test {
namespace {

using Edges = std::vector<std::pair<int, int>>;

/// x+ = x, z = x at every node, all beginning at zero.
Knowledge scalars(int nodes, const Edges& edges) {
  Knowledge known;
  known.plant = std::make_shared<rig::LinearPlant>(Eigen::MatrixXd::Identity(1, 1));
  for (int i = 0; i < nodes; ++i) {
    known.sensors.push_back(
        std::make_shared<rig::LinearSensor>(Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Identity(1, 1)));
    known.nodes.push_back("n" + std::to_string(i));
  }
  known.graph = Graph(nodes, edges);
  known.rates.resize(known.graph.links().size());
  known.Q = known.P0 = Eigen::MatrixXd::Identity(1, 1);
  known.estimates = Eigen::MatrixXd::Zero(1, nodes);
  return known;
}

std::unique_ptr<Method> make(const Knowledge& known, const Json& params = Json::object()) {
  return Registry<MethodMake>::find("diffusion_lms")->make(rig::completed("diffusion_lms", params), known);
}

Readings readings_of(const std::vector<double>& values) {
  Readings readings;
  for (const double value : values) readings.emplace_back(Eigen::VectorXd::Constant(1, value));
  return readings;
}

void expect_estimates(const Method& method, const std::vector<double>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(rig::mean(method, static_cast<int>(i), 1)[0], expected[i], 1e-14) << "node " << i;
}

// A path of three. Step 1: a = psi = 0.3 z. Node 0: median 0.45, both near. Node 1: median 0.6, node 2 too far. Node 2:
// median 1.8, itself and its neighbour both 1.2 away: nobody is trusted and the median stands.
TEST(DiffusionLms, IsTheStepByHand) {
  const Knowledge known = scalars(3, {{0, 1}, {1, 2}});
  auto method = make(known);
  FaultTable faults;
  const Readings readings = readings_of({1, 2, 10});
  rig::tick(*method, known, readings, rig::Links(known), faults, 1);
  expect_estimates(*method, {0.45, 0.45, 1.8});
  // Step 2: a = 0.51, 1.02, 5.1; psi = 0.615, 0.915, 4.26.
  rig::tick(*method, known, readings, rig::Links(known), faults, 2);
  expect_estimates(*method, {0.765, 0.765, 3.06});
  EXPECT_EQ(method->belief(0).covariance, nullptr);
  EXPECT_EQ(method->belief(0).innovation, nullptr);
  EXPECT_FALSE(method->has_bound());
}

TEST(DiffusionLms, ATrustedNeighbourIsOneAtTheVeryEdge) {
  const Knowledge known = scalars(2, {{0, 1}});
  for (const double trust : {0.25, 0.2499}) {
    auto method = make(known, {{"mu", 1}, {"trust", trust}});
    FaultTable faults;
    rig::tick(*method, known, readings_of({0, 1}), rig::Links(known), faults, 1);
    expect_estimates(*method, {0.5, 0.5});  // the mean of both, or the median of both
  }
  // With three, the median is the middle one and the edge shows.
  const Knowledge three = scalars(3, {{0, 1}, {0, 2}});
  for (const double trust : {1.0, 0.999}) {
    auto method = make(three, {{"mu", 1}, {"trust", trust}});
    FaultTable faults;
    rig::tick(*method, three, readings_of({0, 1, -0.5}), rig::Links(three), faults, 1);
    EXPECT_NEAR(rig::mean(*method, 0, 1)[0], trust == 1 ? 0.5 / 3 : -0.25, 1e-15);
  }
}

// The reference alone: with trust 0 and mu 1 nobody but the median's owner is within, and for an even count nobody is.
TEST(DiffusionLms, TheMedianOfAnEvenCountIsTheMeanOfTheMiddleTwo) {
  const std::vector<std::vector<double>> cases{
      {7, -3}, {1, 2, 3, 10}, {10, 1, 3, 2}, {5, 5, 5, 9}, {-1, -2, -3, -4, 100, 200}, {0, 1}};
  for (const auto& values : cases) {
    Edges star;
    for (int j = 1; j < static_cast<int>(values.size()); ++j) star.emplace_back(0, j);
    const Knowledge known = scalars(static_cast<int>(values.size()), star);
    auto method = make(known, {{"mu", 1}, {"trust", 0}});
    FaultTable faults;
    rig::tick(*method, known, readings_of(values), rig::Links(known), faults, 1);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    EXPECT_EQ(rig::mean(*method, 0, 1)[0], (sorted[half - 1] + sorted[half]) / 2);
  }
}

// A lost message leaves the median as well as the trusted set; a falsified one is what was heard, while the median
// keeps the declared one.
TEST(DiffusionLms, LostAndFalsifiedMessages) {
  const Knowledge known = scalars(3, {{0, 1}, {1, 2}});
  const auto into = [&](int from, int to) { return static_cast<std::size_t>(known.graph.find(from, to)); };
  rig::Links lost(known);
  lost.state[into(2, 1)] = LinkState::dos;
  auto method = make(known);
  FaultTable faults;
  rig::tick(*method, known, readings_of({1, 2, 10}), lost, faults, 1);
  expect_estimates(*method, {0.45, 0.45, 1.8});  // node 1: median of 0.3 and 0.6
  lost.state[into(1, 0)] = LinkState::dos;
  auto apart = make(known);
  rig::tick(*apart, known, readings_of({1, 2, 10}), lost, faults, 1);
  expect_estimates(*apart, {0.3, 0.45, 1.8});

  rig::Links falsified(known);
  falsified.state[into(1, 0)] = LinkState::fdi;
  falsified.injected(0, static_cast<Eigen::Index>(into(1, 0))) = 0.5;  // heard as 1.1: 0.65 from the median of 0.45
  auto near = make(known);
  rig::tick(*near, known, readings_of({1, 2, 10}), falsified, faults, 1);
  expect_estimates(*near, {(0.3 + 1.1) / 2, 0.45, 1.8});
  falsified.injected(0, static_cast<Eigen::Index>(into(1, 0))) = -50;
  auto far = make(known);
  rig::tick(*far, known, readings_of({1, 2, 10}), falsified, faults, 1);
  expect_estimates(*far, {0.3, 0.45, 1.8});  // not trusted
  for (const double wild : {std::nan(""), 1e308, -HUGE_VAL}) {
    falsified.injected(0, static_cast<Eigen::Index>(into(1, 0))) = wild;
    auto safe = make(known);
    rig::tick(*safe, known, readings_of({1, 2, 10}), falsified, faults, 1);
    expect_estimates(*safe, {0.3, 0.45, 1.8});
  }
  EXPECT_FALSE(faults.stopped());
}

TEST(DiffusionLms, AMissingReadingIsNoAdaptation) {
  Knowledge known = scalars(2, {});
  known.estimates << 4, -2;
  auto method = make(known);
  FaultTable faults;
  rig::tick(*method, known, readings_of({std::nan(""), 0}), rig::Links(known), faults, 1);
  expect_estimates(*method, {4, -1.4});
}

/// x+ = 0.5 x and mu 0: everybody predicts, and equal predictions stay equal.
TEST(DiffusionLms, WithoutAStepIsThePrediction) {
  const Knowledge known = rig::knowledge_of(Scenario::preset("sparse"));
  Knowledge equal = known;
  equal.estimates = known.estimates.col(0).replicate(1, 5).eval();
  auto method = make(equal, {{"mu", 0}});
  FaultTable faults;
  Eigen::VectorXd x = equal.estimates.col(0), next(6);
  for (int k = 1; k <= 50; ++k) {
    rig::tick(*method, equal, rig::readings_at(equal, x, 2, k), rig::Links(equal), faults, k);
    equal.plant->advance(x, Eigen::VectorXd(0), next);
    x = next;
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(rig::mean(*method, i, 6).isApprox(x, 1e-12));
  }
}

// One step of one station: zb + mu C(zb)' (y - h(zb)), the azimuth's difference wrapped, with either derivative.
TEST(DiffusionLms, AdaptsAlongTheSensorsGradient) {
  Knowledge known = rig::knowledge_of(Scenario::preset("sparse"));
  known.graph = Graph(5, {});
  known.rates.clear();
  for (const bool printed : {false, true}) {
    auto method = make(known, {{"mu", 0.05}, {"printed_azimuth_row", printed}});
    FaultTable faults;
    Readings readings = rig::readings_at(known, known.estimates.col(1), 3, 1);
    readings[0][1] -= 2 * std::acos(-1.0);  // a turn off, which is nothing
    rig::tick(*method, known, readings, rig::Links(known), faults, 1);
    Eigen::VectorXd zb(6), h(6);
    Eigen::MatrixXd C(6, 6);
    known.plant->advance(known.estimates.col(0), Eigen::VectorXd(0), zb);
    known.sensors[0]->measure(zb, h);
    printed ? known.sensors[0]->jacobian_as_printed(zb, C) : known.sensors[0]->jacobian(zb, C);
    Eigen::VectorXd nu = readings[0] - h;
    nu[1] += 2 * std::acos(-1.0);
    EXPECT_TRUE(rig::mean(*method, 0, 6).isApprox(zb + 0.05 * C.transpose() * nu, 1e-12));
  }
}

// Headings of 3.1 and -3.1 rad lie 0.083 apart, and so does their median.
TEST(DiffusionLms, TakesHeadingsToOneTurn) {
  Knowledge known;
  known.plant = Registry<PlantMake>::find("unicycle")->make(Params(Json::object()), 1);
  const Json landmark = {{"position", {3, 4}}, {"R", {1, 1}}};
  for (const char* id : {"a", "b"}) {
    known.sensors.push_back(Registry<SensorMake>::find("range_bearing")->make(Params(landmark), *known.plant));
    known.nodes.emplace_back(id);
  }
  known.graph = Graph(2, {{0, 1}});
  known.rates.resize(2);
  known.Q = known.P0 = Eigen::MatrixXd::Identity(3, 3);
  known.estimates = Eigen::MatrixXd::Zero(3, 2);
  known.estimates(2, 0) = 3.1;
  known.estimates(2, 1) = -3.1;
  auto method = make(known);
  FaultTable faults;
  rig::tick(*method, known, Readings(2, Eigen::VectorXd::Constant(2, std::nan(""))), rig::Links(known), faults, 1);
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(rig::mean(*method, 0, 3)[2], pi, 1e-12);
  EXPECT_NEAR(rig::mean(*method, 1, 3)[2], -pi, 1e-12);
}

TEST(DiffusionLms, CopiesGoOnAlike) {
  const Knowledge known = rig::knowledge_of(Scenario::preset("sparse"));
  auto method = make(known), again = make(known);
  FaultTable faults, faults_again, faults_copy;
  const Eigen::VectorXd truth = known.estimates.col(0);
  const auto step = [&](Method& which, FaultTable& table, int k) {
    rig::tick(which, known, rig::readings_at(known, truth, 3, k), rig::attacked(known, 3, k, 0.2, 0.2, 1), table, k);
  };
  for (int k = 1; k <= 10; ++k) {
    step(*method, faults, k);
    step(*again, faults_again, k);
  }
  auto copy = method->clone();
  step(*method, faults, 11);
  step(*again, faults_again, 11);
  EXPECT_NE(rig::mean(*method, 0, 6), rig::mean(*copy, 0, 6)) << "a copy is its own";
  step(*copy, faults_copy, 11);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(rig::mean(*method, i, 6), rig::mean(*copy, i, 6));
    EXPECT_EQ(rig::mean(*method, i, 6), rig::mean(*again, i, 6));
  }
}

TEST(DiffusionLms, StopsWithItsNodeWhereItIsNoLongerFinite) {
  const Knowledge known = scalars(3, {{0, 1}, {1, 2}});
  auto method = make(known, {{"mu", 1e200}});
  FaultTable table;
  for (int k = 1; k <= 5 && !table.stopped(); ++k)
    rig::tick(*method, known, readings_of({0, 0, 1}), rig::Links(known), table, k);
  ASSERT_TRUE(table.stopped());
  const auto faults = rig::faults_of(table, *method);
  EXPECT_EQ(faults[0].code, "diverged");
  EXPECT_FALSE(faults[0].node.empty());
}

}  // namespace
}  // namespace vigil::diffusion_lms_test
