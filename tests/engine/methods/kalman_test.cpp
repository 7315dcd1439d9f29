/// The ordinary filters: against textbook formulas, and consistent where their assumptions hold.
#include "engine/methods/kalman.hpp"

#include <gtest/gtest.h>

#include "engine/linalg/chi_square.hpp"
#include "tests/engine/methods/linear_plant.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::kalman_test {
namespace {

Eigen::MatrixXd normal_matrix(int rows, int columns, std::int64_t tick) {
  Eigen::VectorXd draw(rows * columns);
  Draws(12, "kalman").normals(tick, draw);
  return draw.reshaped(rows, columns);
}

/// Two sensors of two and one channels on a damped linear plant of n states.
Knowledge linear(int n) {
  Knowledge known;
  const Eigen::MatrixXd A = 0.9 * Eigen::MatrixXd::Identity(n, n) + 0.05 * normal_matrix(n, n, 1);
  known.plant = std::make_shared<rig::LinearPlant>(A);
  known.sensors = {std::make_shared<rig::LinearSensor>(normal_matrix(2, n, 2),
                                                       Eigen::MatrixXd(Eigen::Vector2d(0.5, 0.2).asDiagonal())),
                   std::make_shared<rig::LinearSensor>(normal_matrix(1, n, 3),
                                                       Eigen::MatrixXd(0.3 * Eigen::MatrixXd::Identity(1, 1)))};
  known.nodes = {"a", "b"};
  known.graph = Graph(2, {});
  const Eigen::MatrixXd half = normal_matrix(n, n, 4);
  known.Q = 0.1 * half * half.transpose();
  known.P0 = Eigen::MatrixXd::Identity(n, n);
  known.estimates = Eigen::MatrixXd::Zero(n, 2);
  return known;
}

TEST(Kalman, UpdateIsTheTextbookOne) {
  const int n = 4;
  const Eigen::MatrixXd half = normal_matrix(n, n, 7);
  const Eigen::MatrixXd P = half * half.transpose(), B = normal_matrix(2, n, 8);
  const Eigen::MatrixXd R = Eigen::Vector2d(0.4, 0.9).asDiagonal();
  Gaussian state{normal_matrix(n, 1, 9), P};
  const Eigen::VectorXd before = state.mean;
  const rig::LinearSensor sensor(B, R);
  const Eigen::VectorXd z = normal_matrix(2, 1, 10);
  const Innovation innovation = innovate(sensor, z, state.mean);
  ASSERT_TRUE(kalman_update(state, innovation));
  const Eigen::MatrixXd S = B * P * B.transpose() + R, K = P * B.transpose() * S.inverse();
  EXPECT_TRUE(Eigen::VectorXd(state.mean).isApprox(before + K * (z - B * before), 1e-12));
  EXPECT_TRUE(Eigen::MatrixXd(state.covariance).isApprox((Eigen::MatrixXd::Identity(n, n) - K * B) * P, 1e-10));
  EXPECT_NEAR(mahalanobis(innovation, P), (z - B * before).dot(S.inverse() * (z - B * before)), 1e-10);
}

TEST(Kalman, LeavesOutWhatWasNotRead) {
  const rig::LinearSensor sensor(normal_matrix(3, 4, 11), Eigen::MatrixXd(Eigen::Vector3d(1, 2, 3).asDiagonal()));
  Eigen::VectorXd z = Eigen::Vector3d(1, std::nan(""), 3);
  const Innovation innovation = innovate(sensor, z, BoundedVector::Zero(4));
  ASSERT_EQ(innovation.r.size(), 2);
  EXPECT_EQ(innovation.r[1], 3);
  EXPECT_EQ(innovation.R(1, 1), 3);
  z.setConstant(std::nan(""));
  EXPECT_TRUE(innovate(sensor, z, BoundedVector::Zero(4)).empty());
}

// Taking the sensors one after another is the stacked update.
TEST(Centralized, IsTheStackedFilter) {
  const int n = 3;
  const Knowledge known = linear(n);
  auto method = Registry<MethodMake>::find("centralized_ekf")->make(rig::completed("centralized_ekf"), known);
  Eigen::VectorXd x = known.estimates.col(0);
  Eigen::MatrixXd P = known.P0, A(n, n), B(3, n), R = Eigen::Vector3d(0.5, 0.2, 0.3).asDiagonal();
  known.plant->jacobian(x, Eigen::VectorXd(0), A);
  Eigen::MatrixXd part(2, n), last(1, n);
  known.sensors[0]->jacobian(x, part);
  known.sensors[1]->jacobian(x, last);
  B << part, last;
  FaultTable faults;
  for (int k = 1; k <= 10; ++k) {
    const Readings readings = rig::readings_at(known, normal_matrix(n, 1, 100 + k), 1, k);
    rig::tick(*method, known, readings, rig::Links(known), faults, k);
    x = A * x;
    P = A * P * A.transpose() + known.Q;
    const Eigen::MatrixXd S = B * P * B.transpose() + R, K = P * B.transpose() * S.inverse();
    Eigen::VectorXd z(3);
    z << readings[0], readings[1];
    const Eigen::VectorXd r = z - B * x;
    // The innovations, whitened one after another, are the stacked chi-square.
    const Belief belief = method->belief(0);
    EXPECT_NEAR((Eigen::Map<const Eigen::VectorXd>(belief.innovation, belief.innovation_size).squaredNorm()),
                r.dot(S.inverse() * r), 1e-9);
    x += K * r;
    P -= K * B * P;
    EXPECT_TRUE(rig::mean(*method, 0, n).isApprox(x, 1e-9));
    EXPECT_TRUE(rig::bound(*method, 0, n).isApprox(P, 1e-9));
  }
}

struct Consistency {
  double nees = 0, nis = 0;
  int count = 0;
};

/// NEES and NIS of a matched filter on the linear plant, averaged over runs of 20 ticks.
Consistency consistency(const char* id, int n, int trials) {
  Knowledge known = linear(n);
  Eigen::MatrixXd A(n, n);
  known.plant->jacobian(known.estimates.col(0), Eigen::VectorXd(0), A);
  const Eigen::MatrixXd root = symmetric_root(known.Q);
  const Draws noise(31, "process"), start(31, "start");
  Consistency sum;
  for (int trial = 0; trial < trials; ++trial) {
    Eigen::VectorXd x(n), w(n);
    start.normals(trial, x);  // truth ~ N(estimate, P0)
    auto method = Registry<MethodMake>::find(id)->make(rig::completed(id), known);
    FaultTable faults;
    for (int k = 1; k <= 20; ++k) {
      noise.normals(trial * 100 + k, w);
      x = A * x + root * w;
      rig::tick(*method, known, rig::readings_at(known, x, 1000 + trial, k), rig::Links(known), faults, k);
      const Eigen::VectorXd e = rig::mean(*method, 0, n) - x;
      if (k < 20) continue;  // one figure a run: ticks of one run depend on each other
      sum.nees += e.dot(rig::bound(*method, 0, n).ldlt().solve(e));
      const Belief belief = method->belief(0);
      const Eigen::Map<const Eigen::VectorXd> r(belief.innovation, belief.innovation_size);
      sum.nis += belief.innovation_covariance == nullptr
                     ? r.squaredNorm()
                     : r.dot(Eigen::Map<const Eigen::MatrixXd>(belief.innovation_covariance, r.size(), r.size())
                                 .ldlt()
                                 .solve(r));
      ++sum.count;
    }
  }
  sum.nees /= sum.count;
  sum.nis /= sum.count;
  return sum;
}

// The mean of M chi-squares of n degrees, times M, is a chi-square of nM: two-sided bound at 1e-4. Seeds are fixed.
void expect_mean_chi_square(double mean, int degrees, int count) {
  const double all = degrees * count;
  EXPECT_GT(mean * count, chi_square_quantile(5e-5, all));
  EXPECT_LT(mean * count, chi_square_quantile(1 - 5e-5, all));
}

TEST(Kalman, IsConsistentOnALinearPlant) {
  for (const int n : {1, 2, 4}) {
    const Consistency local = consistency("local_ekf", n, 400);
    expect_mean_chi_square(local.nees, n, local.count);
    expect_mean_chi_square(local.nis, 2, local.count);
    const Consistency central = consistency("centralized_ekf", n, 400);
    expect_mean_chi_square(central.nees, n, central.count);
    expect_mean_chi_square(central.nis, 3, central.count);
  }
}

TEST(Centralized, GateLeavesOutliersOut) {
  const Knowledge known = linear(3);
  auto gated =
      Registry<MethodMake>::find("centralized_ekf")->make(rig::completed("centralized_ekf", {{"gate", 0.99}}), known);
  auto open = Registry<MethodMake>::find("centralized_ekf")->make(rig::completed("centralized_ekf"), known);
  FaultTable faults;
  Readings readings = rig::readings_at(known, Eigen::Vector3d::Zero(), 1, 1);
  readings[1][0] = 1e4;
  rig::tick(*gated, known, readings, rig::Links(known), faults, 1);
  rig::tick(*open, known, readings, rig::Links(known), faults, 1);
  EXPECT_LT(rig::mean(*gated, 0, 3).norm(), 20);
  EXPECT_GT(rig::mean(*open, 0, 3).norm(), 100);
  EXPECT_EQ(gated->belief(0).innovation_size, 2);
}

TEST(DeadReckoning, HearsNobody) {
  const Knowledge known = linear(2);
  auto method = Registry<MethodMake>::find("dead_reckoning")->make(rig::completed("dead_reckoning"), known);
  FaultTable faults;
  Eigen::MatrixXd A(2, 2);
  known.plant->jacobian(Eigen::Vector2d::Zero(), Eigen::VectorXd(0), A);
  rig::tick(*method, known, rig::readings_at(known, Eigen::Vector2d(50, 50), 1, 1), rig::Links(known), faults, 1);
  EXPECT_TRUE(rig::mean(*method, 0, 2).isZero());
  EXPECT_TRUE(rig::bound(*method, 0, 2).isApprox(A * known.P0 * A.transpose() + known.Q, 1e-12));
}

// One prediction at each node, from its own initial estimate.
TEST(DeadReckoning, MayStandAtEveryNode) {
  Knowledge known = linear(2);
  known.estimates << 1, -2, 3, 4;
  auto method =
      Registry<MethodMake>::find("dead_reckoning")->make(rig::completed("dead_reckoning", {{"at", "nodes"}}), known);
  EXPECT_EQ(method->outputs(), known.nodes);
  FaultTable faults;
  Eigen::MatrixXd A(2, 2);
  known.plant->jacobian(Eigen::Vector2d::Zero(), Eigen::VectorXd(0), A);
  for (int k = 1; k <= 3; ++k)
    rig::tick(*method, known, rig::readings_at(known, Eigen::Vector2d(50, 50), 1, k), rig::Links(known), faults, k);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(rig::mean(*method, i, 2).isApprox(A * A * A * known.estimates.col(i), 1e-12));
  EXPECT_TRUE(rig::bound(*method, 1, 2).isApprox(rig::bound(*method, 0, 2), 0));
}

}  // namespace
}  // namespace vigil::kalman_test
