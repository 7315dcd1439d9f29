/// The Kalman-consensus filter where readings miss, covariances are singular, numbers overflow; copies; options.
/// Specification of seed 001, sections 11 and 15.
#include <gtest/gtest.h>

#include "tests/engine/methods/linear_network.hpp"

namespace vigil::kalman_consensus_edges_test {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using rig::kStates;
using rig::network;
using rig::truth_at;

std::unique_ptr<Method> make(const char* id, const Knowledge& known, const Json& params = Json::object()) {
  return Registry<MethodMake>::find(id)->make(rig::completed(id, params), known);
}

// Without any reading the prior stays and only the pull acts; one node's silence leaves the others' information.
TEST(KalmanConsensus, AMissingReadingIsNoInformation) {
  const Knowledge known = network(3, {{0, 1}, {1, 2}});
  auto method = make("kalman_consensus", known, {{"gain", 0}});
  FaultTable faults;
  Readings silent = rig::readings_at(known, truth_at(1), 5, 1);
  for (Vector& z : silent) z.setConstant(std::nan(""));
  rig::tick(*method, known, silent, rig::Links(known), faults, 1);
  Matrix A(kStates, kStates);
  known.plant->jacobian(Vector::Zero(kStates), Vector(0), A);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(rig::mean(*method, i, kStates).isApprox(A * known.estimates.col(i), 1e-13));
    EXPECT_TRUE(rig::bound(*method, i, kStates).isApprox(A * known.P0 * A.transpose() + known.Q, 1e-12));
    EXPECT_EQ(method->belief(i).innovation, nullptr);
  }
  auto half = make("kalman_consensus", known, {{"gain", 0}});
  Readings one = silent;
  one[2] = rig::readings_at(known, truth_at(1), 5, 1)[2];
  FaultTable other;
  rig::tick(*half, known, one, rig::Links(known), other, 1);
  EXPECT_TRUE(rig::mean(*half, 0, kStates).isApprox(rig::mean(*method, 0, kStates), 1e-13)) << "two links away";
  EXPECT_LT(rig::bound(*half, 1, kStates).trace(), rig::bound(*method, 1, kStates).trace() - 1e-3);
}

// A certain start without process noise stays certain: nothing is inverted.
TEST(KalmanConsensus, TakesSingularCovariances) {
  Knowledge known = network(2, {{0, 1}}, 0);
  known.P0.setZero();
  known.Q = Eigen::Vector3d(0.3, 0, 0).asDiagonal();
  auto method = make("kalman_consensus", known);
  FaultTable faults;
  for (int k = 1; k <= 5; ++k) {
    rig::tick(*method, known, rig::readings_at(known, truth_at(k), 5, k), rig::Links(known), faults, k);
    ASSERT_FALSE(faults.stopped());
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(rig::mean(*method, i, kStates).allFinite());
    if (k > 1) continue;
    const Matrix P = known.Q;  // (P^-1 + S)^-1 in its limit is (I + P S)^-1 P
    Matrix S = Matrix::Zero(kStates, kStates);
    for (const auto& sensor : known.sensors) {
      Matrix C(sensor->size(), kStates);
      sensor->jacobian(Vector::Zero(kStates), C);
      S += C.transpose() * sensor->noise().inverse() * C;
    }
    const Matrix M = (Matrix::Identity(kStates, kStates) + P * S).inverse() * P;
    EXPECT_TRUE(rig::bound(*method, 0, kStates).isApprox(M, 1e-12));
  }
}

TEST(KalmanConsensus, CopiesGoOnAlike) {
  const Knowledge known = rig::knowledge_of(Scenario::preset("sparse"));
  auto method = make("kalman_consensus", known), again = make("kalman_consensus", known);
  FaultTable faults, faults_again, faults_copy;
  const Vector truth = known.estimates.col(0);
  const auto step = [&](Method& which, FaultTable& table, int k) {
    rig::tick(which, known, rig::readings_at(known, truth, 3, k), rig::attacked(known, 3, k, 0.2, 0.2, 1), table, k);
  };
  for (int k = 1; k <= 10; ++k) {
    step(*method, faults, k);
    step(*again, faults_again, k);
  }
  auto copy = method->clone();
  step(*method, faults, 11);
  step(*method, faults, 12);
  step(*copy, faults_copy, 11);
  step(*again, faults_again, 11);
  EXPECT_NE(rig::mean(*method, 2, 6), rig::mean(*copy, 2, 6)) << "a copy is its own";
  step(*copy, faults_copy, 12);
  step(*again, faults_again, 12);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(rig::mean(*method, i, 6), rig::mean(*copy, i, 6));
    EXPECT_EQ(rig::mean(*method, i, 6), rig::mean(*again, i, 6));
    EXPECT_EQ(rig::bound(*method, i, 6), rig::bound(*copy, i, 6));
  }
}

// One station alone with the printed derivative is the Kalman formula with that derivative.
TEST(KalmanConsensus, UsesThePrintedAzimuthRowWhereAsked) {
  const Knowledge known = rig::knowledge_of(Scenario::preset("sparse"));
  Knowledge lone = known;
  lone.graph = Graph(5, {});
  lone.rates.clear();
  auto method = make("kalman_consensus", lone, {{"printed_azimuth_row", true}});
  FaultTable faults;
  const Vector truth = known.estimates.col(1);
  const Readings readings = rig::readings_at(lone, truth, 3, 1);
  rig::tick(*method, lone, readings, rig::Links(lone), faults, 1);
  Matrix A(6, 6), C(6, 6);
  lone.plant->jacobian(truth, Vector(0), A);
  const Vector xb = A * lone.estimates.col(0);
  const Matrix P = A * lone.P0 * A.transpose() + lone.Q, R = lone.sensors[0]->noise();
  lone.sensors[0]->jacobian_as_printed(xb, C);
  Vector predicted(6);
  lone.sensors[0]->measure(xb, predicted);
  const Matrix K = P * C.transpose() * (C * P * C.transpose() + R).inverse();
  EXPECT_TRUE(rig::mean(*method, 0, 6).isApprox(xb + K * (readings[0] - predicted), 1e-9));
}

// Differences of headings are taken the short way round.
TEST(KalmanConsensus, PullsAHeadingTheShortWay) {
  Knowledge known;
  known.plant = Registry<PlantMake>::find("unicycle")->make(Params(Json::object()), 1);
  const Json landmark = {{"position", {3, 4}}, {"R", {1, 1}}};
  for (const char* id : {"a", "b"}) {
    known.sensors.push_back(Registry<SensorMake>::find("range_bearing")->make(Params(landmark), *known.plant));
    known.nodes.emplace_back(id);
  }
  known.graph = Graph(2, {{0, 1}});
  known.rates.resize(2);
  known.Q = Matrix::Zero(3, 3);
  known.P0 = Matrix::Identity(3, 3);
  known.estimates = Matrix::Zero(3, 2);
  known.estimates(2, 0) = 3.1;
  known.estimates(2, 1) = -3.1;
  auto method = make("kalman_consensus", known);
  FaultTable faults;
  rig::tick(*method, known, Readings(2, Vector::Constant(2, std::nan(""))), rig::Links(known), faults, 1);
  const double pull = 0.25 / (1 + std::sqrt(3.0)) * (2 * std::acos(-1.0) - 6.2);
  EXPECT_NEAR(rig::mean(*method, 0, 3)[2], 3.1 + pull, 1e-12);
  EXPECT_NEAR(rig::mean(*method, 1, 3)[2], -3.1 - pull, 1e-12);
}

TEST(KalmanConsensus, StopsWithItsNodeWhereItIsNoLongerFinite) {
  const Knowledge known = network(3, {{0, 1}, {1, 2}});
  auto method = make("kalman_consensus", known, {{"gain", 1e308}});
  FaultTable table;
  for (int k = 1; k <= 5 && !table.stopped(); ++k)
    rig::tick(*method, known, rig::readings_at(known, truth_at(k), 5, k), rig::Links(known), table, k);
  ASSERT_TRUE(table.stopped());
  const auto faults = rig::faults_of(table, *method);
  EXPECT_EQ(faults[0].code, "diverged");
  EXPECT_FALSE(faults[0].node.empty());
  EXPECT_NE(faults[0].detail.find("no longer finite"), std::string::npos);
}

}  // namespace
}  // namespace vigil::kalman_consensus_edges_test
