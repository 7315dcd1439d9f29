// A lane beside the equations step by step. Specification (observer), section 3.
#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "engine/methods/observer/fallback.hpp"
#include "engine/methods/observer/matched.hpp"
#include "tests/engine/allocations.hpp"
#include "tests/engine/methods/observer/networks.hpp"

namespace vigil::observer::simulation_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd phi_of(const Subsystem& s, const VectorXd& x) {
  VectorXd phi(s.r());
  for (int l = 0; l < s.r(); ++l) phi[l] = s.tau * std::sin(x[l]);  // r <= n in these tests
  return phi;
}

/// Section 3's steps (a), (b), (c) for one derivative, subsystem by subsystem.
VectorXd by_hand(const Network& network, const Gains& gains, const VectorXd& state, const VectorXd& inputs) {
  struct One {
    VectorXd x, xi2hat, thetahat, u, w, d, f, y, xi1hat, slope_x, slope;
  };
  std::vector<One> all(network.subsystems.size());
  Eigen::Index at = 0, in = 0;
  const auto take = [](const VectorXd& from, Eigen::Index& place, int count) {
    place += count;
    return VectorXd(from.segment(place - count, count));
  };
  for (std::size_t i = 0; i < all.size(); ++i) all[i].x = take(state, at, network.subsystems[i].n());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Subsystem& s = network.subsystems[i];
    One& one = all[i];
    one.xi2hat = take(state, at, s.n() + s.g());
    one.thetahat = take(state, at, s.q());
    one.u = take(inputs, in, s.m());
    one.w = take(inputs, in, s.q());
    one.d = take(inputs, in, s.dd());
    one.f = take(inputs, in, s.g());
    one.y = s.C * one.x + s.G * one.f;
    one.xi1hat = one.xi2hat + augment(s).E2 * one.y;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Subsystem& s = network.subsystems[i];
    const Augmented a = augment(s);
    One& one = all[i];
    one.slope_x = s.A * one.x + s.B * one.u + s.F * phi_of(s, one.x) + s.D * one.w + s.Dd * one.d;
    const VectorXd what = one.thetahat + a.N * (one.xi1hat - a.E2 * one.y);
    const VectorXd innovation = one.y - a.C1 * one.xi1hat;
    VectorXd core =
        a.A2 * one.xi1hat + a.B2 * one.u + a.F2 * phi_of(s, one.xi1hat.head(s.n())) + a.D2 * what + a.J2 * one.y;
    for (const Coupling& c : network.couplings) {
      if (static_cast<std::size_t>(c.to) != i) continue;
      const One& other = all[static_cast<std::size_t>(c.from)];
      one.slope_x -= s.alpha * c.H * other.x;
      core -= s.alpha * augmented_coupling(network, c) * other.xi1hat;
    }
    const auto xi = s.n() + s.g();
    one.slope.resize(xi + s.q());
    one.slope << core + s.mu * gains[i].topRows(xi) * innovation,
        -a.N * core + s.mu * gains[i].bottomRows(s.q()) * innovation;
  }
  VectorXd slope(state.size());
  at = 0;
  for (const One& one : all) {
    slope.segment(at, one.x.size()) = one.slope_x;
    at += one.x.size();
  }
  for (const One& one : all) {
    slope.segment(at, one.slope.size()) = one.slope;
    at += one.slope.size();
  }
  return slope;
}

Gains random_gains(const Network& network, RandomMatrices& random) {
  Gains gains;
  for (const Subsystem& s : network.subsystems) gains.push_back(random.gaussian(s.size(), s.p()));
  return gains;
}

TEST(ALane, FollowsTheEquationsStepByStep) {
  for (int number = 0; number < 20; ++number) {
    RandomMatrices random(100 + number);
    const Network network = number == 0   ? pair().network
                            : number == 1 ? areas(AreaOutputs::case_2).network
                                          : mixed(number);
    const Gains gains = number == 0 ? printed_gains() : random_gains(network, random);
    auto lane = NetworkSimulation::intermediate(network, gains);
    const VectorXd state = random.vector(lane.size()), inputs = random.vector(lane.inputs());
    VectorXd slope(lane.size());
    lane.derivative(state, inputs, slope);
    const VectorXd expected = by_hand(network, gains, state, inputs);
    EXPECT_LT((slope - expected).norm(), 1e-12 * expected.norm()) << number;
  }
}

// (16) by the errors themselves, from the estimates and the slope of a lane.
TEST(ALane, HasTheErrorsOfTheTheorem) {
  for (int number = 0; number < 10; ++number) {
    RandomMatrices random(200 + number);
    Network network = mixed(number);
    for (Subsystem& s : network.subsystems) s.tau = 0;
    const Gains gains = random_gains(network, random);
    auto lane = NetworkSimulation::intermediate(network, gains);
    const ErrorSystem system = error_system(network);
    const MatrixXd global = global_error_matrix(system, gains);
    const VectorXd state = random.vector(lane.size()), inputs = random.vector(lane.inputs());
    VectorXd slope(lane.size());
    lane.derivative(state, inputs, slope);
    // Where w and f stand still, the snapshot of the slope (inputs 0, f and w gone) is the slope of the snapshot.
    const VectorXd silent = VectorXd::Zero(lane.inputs());
    VectorXd e(global.rows()), rate(global.rows()), forced = VectorXd::Zero(global.rows());
    Eigen::Index at = 0;
    for (int i = 0; i < network.count(); ++i) {
      const Subsystem& s = network.subsystems[static_cast<std::size_t>(i)];
      const Augmented a = augment(s);
      const auto errors = [&](const Snapshot& shot) {
        VectorXd xi(s.n() + s.g()), one(s.size());
        xi << shot.x - shot.xhat, shot.f - shot.fhat;
        one << xi, shot.w - shot.what - a.N * xi;
        return one;
      };
      const Snapshot now = lane.snapshot(i, state, inputs);
      e.segment(at, s.size()) = errors(now);
      rate.segment(at, s.size()) = errors(lane.snapshot(i, slope, silent));
      forced.segment(at, s.size()) = system.parts[static_cast<std::size_t>(i)].Kbar * now.d;
      EXPECT_LT((now.innovation - a.C1 * e.segment(at, s.n() + s.g())).norm(), 1e-12 * (1 + now.innovation.norm()));
      at += s.size();
    }
    EXPECT_LT((rate - global * e - forced).norm(), 1e-11 * rate.norm()) << number;
  }
}

// Without inputs and nonlinearity a run is a matrix exponential.
TEST(ALane, IsTheExponentialOfItsErrorMatrix) {
  Example example;
  example.network = areas(AreaOutputs::case_1).network;
  example.horizon = 0.5;
  example.dt = 0.05;
  for (int i = 0; i < 4; ++i) example.x0.push_back(Eigen::Vector4d(1, -1, 0.5, 0.1 * i));
  const auto gains = riccati_gains(example.network, {});
  ASSERT_TRUE(gains);
  const MatrixXd global = global_error_matrix(error_system(example.network), *gains);
  VectorXd start(20);
  for (int i = 0; i < 4; ++i) {
    const Subsystem& s = example.network.subsystems[static_cast<std::size_t>(i)];
    start.segment(5 * i, 4) = example.x0[static_cast<std::size_t>(i)];
    start[5 * i + 4] = -(augment(s).N * example.x0[static_cast<std::size_t>(i)])[0];  // theta - thetahat = -N x
  }
  const VectorXd end = (0.5 * global).exp() * start;
  const auto lane = NetworkSimulation::intermediate(example.network, *gains);
  VectorXd reached(20);
  ASSERT_TRUE(run_lane(
      lane, example,
      [&](double, int i, const Snapshot& s) {
        const Subsystem& plant = example.network.subsystems[static_cast<std::size_t>(i)];
        reached.segment(5 * i, 4) = s.x - s.xhat;
        reached[5 * i + 4] = (s.w - s.what - augment(plant).N * (s.x - s.xhat))[0];
      },
      20));
  EXPECT_LT((reached - end).norm(), 1e-6 * start.norm());
}

TEST(ALane, EndsWhereItDiverges) {
  Example example = pair();
  Gains gains = printed_gains();
  for (MatrixXd& L : gains) L = -L;
  EXPECT_FALSE(
      run_lane(NetworkSimulation::intermediate(example.network, gains), example, [](double, int, const Snapshot&) {}));
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(ALane, AllocatesNothingInAStep) {
  const Example example = pair();
  auto lane = NetworkSimulation::intermediate(example.network, printed_gains());
  VectorXd state = lane.initial(example.x0);
  lane.advance(state, 0, 1e-3, 1, example.signals);
  EXPECT_EQ(allocations_in([&] { lane.advance(state, 1e-3, 1e-3, 3, example.signals); }), 0);
}
#endif

TEST(AMatchedLane, FollowsItsEquations) {
  const Network network = areas(AreaOutputs::case_1).network;
  RandomMatrices random(4);
  Gains gains;
  for (const Subsystem& s : network.subsystems) gains.push_back(random.gaussian(s.n(), s.p()));
  auto lane = NetworkSimulation::matched(network, gains);
  ASSERT_EQ(lane.size(), 4 * (4 + 4 + 3));
  const VectorXd state = random.vector(lane.size()), inputs = random.vector(lane.inputs());
  VectorXd slope(lane.size());
  lane.derivative(state, inputs, slope);
  std::vector<VectorXd> xhat(4), y(4);
  for (std::size_t i = 0; i < 4; ++i) {
    const Subsystem& s = network.subsystems[i];
    y[i] = s.C * state.segment(4 * i, 4);
    xhat[i] = state.segment(16 + 7 * i, 4) + s.D * matching(s).inverse * y[i];
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Subsystem& s = network.subsystems[i];
    const VectorXd filter = state.segment(16 + 7 * i + 4, 3), u = inputs.segment(2 * i, 1),
                   w = inputs.segment(2 * i + 1, 1);
    VectorXd drift = s.A * xhat[i] + s.B * u, motion = s.A * state.segment(4 * i, 4) + s.B * u + s.D * w;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j == i) continue;
      const MatrixXd& H = *network.coupling(static_cast<int>(i), static_cast<int>(j));
      drift += H * xhat[j];  // alpha = -1
      motion += H * state.segment(4 * j, 4);
    }
    const Matching m = matching(s);
    EXPECT_LT((slope.segment(4 * i, 4) - motion).norm(), 1e-11);
    EXPECT_LT((slope.segment(16 + 7 * i, 4) - m.projection * drift - gains[i] * (y[i] - s.C * xhat[i])).norm(), 1e-11);
    EXPECT_LT((slope.segment(16 + 7 * i + 4, 3) - (y[i] - filter) / 0.01).norm(), 1e-11);
    const Snapshot shot = lane.snapshot(static_cast<int>(i), state, inputs);
    EXPECT_LT((shot.xhat - xhat[i]).norm(), 1e-12);
    EXPECT_LT((shot.what - m.inverse * ((y[i] - filter) / 0.01 - s.C * drift)).norm(), 1e-10);
    EXPECT_EQ(shot.fhat.size(), 0);
  }
  EXPECT_GE(lane.fastest(), 100);
}

TEST(ANonlinearity, KeepsItsConstantOverAllEntries) {
  Subsystem s;
  s.A = MatrixXd::Zero(2, 2);
  s.C = MatrixXd::Identity(2, 2);
  s.F = MatrixXd::Ones(2, 5);
  s.tau = 1.5;
  complete(s);
  RandomMatrices random(1);
  for (const Nonlinearity kind :
       {Nonlinearity::sine, Nonlinearity::tanh, Nonlinearity::sine_last, Nonlinearity::none}) {
    s.phi = kind;
    double steepest = 0;
    VectorXd a(5), b(5);
    for (int trial = 0; trial < 2000; ++trial) {
      const VectorXd x = random.vector(2), z = x + 1e-3 * random.vector(2);
      nonlinearity(s, x, a);
      nonlinearity(s, z, b);
      steepest = std::max(steepest, (a - b).norm() / (x - z).norm());
    }
    EXPECT_LE(steepest, 1.5 * (1 + 1e-9));
    EXPECT_GE(steepest, kind == Nonlinearity::none ? 0 : 1.2);
  }
  s = pair().network.subsystems[1];
  VectorXd one(1);
  nonlinearity(s, Eigen::Vector3d(0.4, 7, 8), one);
  EXPECT_DOUBLE_EQ(one[0], 3 * std::sin(0.4));
}

}  // namespace
}  // namespace vigil::observer::simulation_test
