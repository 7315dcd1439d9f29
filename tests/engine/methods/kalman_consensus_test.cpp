/// The Kalman-consensus filter against closed forms: alone, with everybody, and the formulas of the specification of
/// seed 001, section 11, A3, written out.
#include <gtest/gtest.h>

#include "tests/engine/methods/linear_network.hpp"

namespace vigil::kalman_consensus_test {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using rig::kStates;
using rig::network;
using rig::truth_at;

std::unique_ptr<Method> make(const char* id, const Knowledge& known, const Json& params = Json::object()) {
  return Registry<MethodMake>::find(id)->make(rig::completed(id, params), known);
}

/// Section 11 as it stands, with explicit inverses.
struct Literal {
  const Knowledge& known;
  double gain;
  Matrix A;
  std::vector<Vector> xb, xhat;
  std::vector<Matrix> P, M;

  Literal(const Knowledge& given, double gain_of) : known(given), gain(gain_of), A(kStates, kStates) {
    known.plant->jacobian(Vector::Zero(kStates), Vector(0), A);
    for (std::size_t i = 0; i < known.nodes.size(); ++i) {
      xb.push_back(A * known.estimates.col(static_cast<Eigen::Index>(i)));
      P.push_back(A * known.P0 * A.transpose() + known.Q);
    }
    xhat = xb;
    M = P;
  }

  void step(const Readings& readings, const rig::Links& links) {
    std::vector<Vector> u;
    std::vector<Matrix> U;
    for (std::size_t i = 0; i < xb.size(); ++i) {
      Matrix C(known.sensors[i]->size(), kStates);
      known.sensors[i]->jacobian(xb[i], C);
      const Matrix R = known.sensors[i]->noise();
      const Vector z = (readings[i] - C * xb[i]) + C * xb[i];
      u.push_back(C.transpose() * R.inverse() * z);
      U.push_back(C.transpose() * R.inverse() * C);
    }
    for (std::size_t i = 0; i < xb.size(); ++i) {
      Vector y = u[i], pull = Vector::Zero(kStates);
      Matrix S = U[i];
      for (std::size_t l = 0; l < known.graph.links().size(); ++l) {
        const Link& link = known.graph.links()[l];
        if (link.to != static_cast<int>(i) || links.state[l] == LinkState::dos) continue;
        const auto j = static_cast<std::size_t>(link.from);
        y += u[j];
        S += U[j];
        pull += xb[j] + links.injected.col(static_cast<Eigen::Index>(l)) - xb[i];
      }
      M[i] = (P[i].inverse() + S).inverse();
      xhat[i] = xb[i] + M[i] * (y - S * xb[i]) + gain / (1 + P[i].norm()) * P[i] * pull;
    }
    for (std::size_t i = 0; i < xb.size(); ++i) {
      P[i] = A * M[i] * A.transpose() + known.Q;
      xb[i] = A * xhat[i];
    }
  }
};

void expect_literal(const Knowledge& known, const Json& params, double gain, double pdos, double pfdi) {
  auto method = make("kalman_consensus", known, params);
  Literal literal(known, gain);
  FaultTable faults;
  for (int k = 1; k <= 30; ++k) {
    const Readings readings = rig::readings_at(known, truth_at(k), 5, k);
    const rig::Links links = rig::attacked(known, 8, k, pdos, pfdi, 0.5);
    rig::tick(*method, known, readings, links, faults, k);
    literal.step(readings, links);
    for (int i = 0; i < static_cast<int>(known.nodes.size()); ++i) {
      const auto n = static_cast<std::size_t>(i);
      ASSERT_TRUE(rig::mean(*method, i, kStates).isApprox(literal.xhat[n], 1e-8)) << k << " " << i;
      ASSERT_TRUE(rig::bound(*method, i, kStates).isApprox(literal.M[n], 1e-8)) << k << " " << i;
    }
  }
}

TEST(KalmanConsensus, IsTheFormulaOfTheSpecification) {
  const Knowledge known = network(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}, {1, 3}});
  expect_literal(known, Json::object(), 0.25, 0, 0);
  expect_literal(known, {{"gain", 0}}, 0, 0, 0);
  expect_literal(known, {{"gain", 0.7}}, 0.7, 0, 0);
}

// A lost message takes its neighbour out of every sum of that tick; a falsified one moves the pull alone.
TEST(KalmanConsensus, IsTheFormulaUnderAttackToo) {
  const Knowledge known = network(4, {{0, 1}, {0, 2}, {0, 3}, {2, 3}});
  expect_literal(known, Json::object(), 0.25, 0.4, 0);
  expect_literal(known, Json::object(), 0.25, 0, 0.5);
  expect_literal(known, Json::object(), 0.25, 0.3, 0.4);
}

TEST(KalmanConsensus, AloneIsTheKalmanFilter) {
  const Knowledge known = network(3, {});
  auto method = make("kalman_consensus", known), filter = make("local_ekf", known);
  FaultTable faults, other;
  for (int k = 1; k <= 30; ++k) {
    const Readings readings = rig::readings_at(known, truth_at(k), 6, k);
    rig::tick(*method, known, readings, rig::Links(known), faults, k);
    rig::tick(*filter, known, readings, rig::Links(known), other, k);
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(rig::mean(*method, i, kStates).isApprox(rig::mean(*filter, i, kStates), 1e-9));
      ASSERT_TRUE(rig::bound(*method, i, kStates).isApprox(rig::bound(*filter, i, kStates), 1e-9));
      const Belief mine = method->belief(i), theirs = filter->belief(i);
      ASSERT_EQ(mine.innovation_size, theirs.innovation_size);
      for (int c = 0; c < mine.innovation_size; ++c) EXPECT_NEAR(mine.innovation[c], theirs.innovation[c], 1e-9);
      EXPECT_NEAR(mine.innovation_covariance[0], theirs.innovation_covariance[0], 1e-9);
    }
  }
  EXPECT_FALSE(method->has_bound());
}

// Equal priors and everybody heard: each node adds up all information, which is the filter over all sensors, and stays
// equal to the others. Linear sensors, and stations of seed 001.
TEST(KalmanConsensus, WithEverybodyIsTheCentralizedFilter) {
  const auto expect_same = [](const Knowledge& known, const std::vector<Vector>& truths) {
    auto method = make("kalman_consensus", known), fused = make("centralized_ekf", known);
    const int n = known.plant->states();
    FaultTable faults, other;
    for (int k = 1; k <= static_cast<int>(truths.size()); ++k) {
      const Readings readings = rig::readings_at(known, truths[static_cast<std::size_t>(k - 1)], 7, k);
      rig::tick(*method, known, readings, rig::Links(known), faults, k);
      rig::tick(*fused, known, readings, rig::Links(known), other, k);
      for (int i = 0; i < static_cast<int>(known.nodes.size()); ++i) {
        ASSERT_TRUE(rig::mean(*method, i, n).isApprox(rig::mean(*fused, 0, n), 1e-8)) << k;
        ASSERT_TRUE(rig::bound(*method, i, n).isApprox(rig::bound(*fused, 0, n), 1e-7)) << k;
      }
    }
  };
  Knowledge known = network(4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
  known.estimates = known.estimates.col(0).replicate(1, 4).eval();
  std::vector<Vector> truths;
  for (int k = 1; k <= 20; ++k) truths.push_back(truth_at(k));
  expect_same(known, truths);

  Knowledge radar = rig::knowledge_of(Scenario::preset("sparse").with("network.graph", "complete"));
  radar.estimates = radar.estimates.col(0).replicate(1, 5).eval();
  truths.assign(1, Vector(radar.estimates.col(0)));
  for (int k = 2; k <= 20; ++k) {
    Vector next(6);
    radar.plant->advance(truths.back(), Vector(0), next);
    truths.push_back(next);
  }
  expect_same(radar, truths);
}

}  // namespace
}  // namespace vigil::kalman_consensus_test
