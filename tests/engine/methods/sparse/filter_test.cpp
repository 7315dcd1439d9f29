/// The filter of the sparse family, tick by tick: specification of seed 001, sections 7, 9 and 15.
#include "engine/methods/sparse/filter.hpp"

#include <gtest/gtest.h>

#include "tests/engine/methods/sparse/references.hpp"
#include "tests/engine/methods/sparse/target.hpp"

namespace vigil::filter_test {
namespace {

using target::known;
using target::method;
using target::Target;

/// Section 9 at one node, without the game, in dense algebra.
struct LiteralNode {
  Eigen::VectorXd x;
  Eigen::MatrixXd P;
  windows::Scene window;  ///< what was read lately
  Eigen::VectorXd E = Eigen::VectorXd::Zero(36);
  double nis = std::nan("");

  LiteralNode(const Knowledge& known, std::size_t i)
      : x(known.estimates.col(static_cast<Eigen::Index>(i))),
        P(known.P0),
        window{known.sensors[i], 0, Eigen::MatrixXd(6, 0), Eigen::MatrixXd(6, 0), {}} {}

  void tick(const Knowledge& known, const Eigen::VectorXd& y) {
    const Eigen::MatrixXd F = windows::loop(), I = Eigen::MatrixXd::Identity(6, 6);
    x = F * x;
    P = F * P * F.transpose() + known.Q;
    const Eigen::Index kept = std::min<Eigen::Index>(window.readings.cols(), 5);
    const Eigen::MatrixXd readings = window.readings.rightCols(kept), met = window.met.rightCols(kept);
    window.T = static_cast<int>(kept) + 1;
    window.readings.resize(6, window.T);
    window.met.resize(6, window.T);
    window.readings << readings, y;
    window.met << met, x;
    window.prior = x;
    if (window.T < 6) return;
    const windows::Plain plain = windows::plain(window);
    const Eigen::VectorXd b = plain.M * plain.r;
    E = windows::literal_omp(plain.M, b, 12, sparse::stop_level(1.5, 0.01, 30), [&](const auto& e) {
          return (b - plain.M * e).norm();
        }).E;
    const Eigen::MatrixXd C = windows::derivative(*window.sensor, x, false), R = window.sensor->noise();
    const Eigen::VectorXd nu = plain.r.tail(6) - E.tail(6);
    const Eigen::MatrixXd S = C * P * C.transpose() + R, K = P * C.transpose() * S.inverse();
    nis = nu.dot(S.inverse() * nu);
    x += K * nu;
    P = (I - K * C) * P * (I - K * C).transpose() + K * R * K.transpose();
  }
};

void expect_state(const Method& filter, int node, const LiteralNode& literal, std::int64_t k) {
  EXPECT_LT((rig::mean(filter, node, 6) - literal.x).norm(), 1e-9) << node << " at " << k;
  EXPECT_LT((rig::bound(filter, node, 6) - literal.P).norm(), 1e-11) << node << " at " << k;
}

TEST(SparseFilter, IsTheLiteralOneWithTheGame) {
  const Knowledge knowledge = known();
  auto filter = method("omp_game", knowledge);
  Target world(knowledge);
  std::vector<LiteralNode> literal;
  for (std::size_t i = 0; i < 5; ++i) literal.emplace_back(knowledge, i);
  FaultTable faults;
  int copied = 0, found = 0;
  for (int k = 1; k <= 40; ++k) {
    const Readings readings = world.next(k > 12 && k < 30 ? std::vector<int>{1, 3} : std::vector<int>{});
    rig::tick(*filter, knowledge, readings, rig::Links(knowledge), faults, k);
    for (std::size_t i = 0; i < 5; ++i) literal[i].tick(knowledge, readings[i]);
    const std::vector<LiteralNode> own = literal;
    for (int i = 0; i < 5; ++i) {
      auto& node = literal[static_cast<std::size_t>(i)];
      const int j = filter->choice(i);
      ASSERT_EQ(j < 0, k < 6) << "it plays when six readings are there";
      if (j >= 0) {
        const Eigen::Map<const Eigen::VectorXd> E(filter->reconstruction(i).entries, 36);
        EXPECT_LT((E - node.E).norm(), 1e-7 * (1 + node.E.norm()));
        found += node.E.isZero(0) ? 0 : 1;
        copied += j != i ? 1 : 0;
        node.x = own[static_cast<std::size_t>(j)].x;
        node.P = own[static_cast<std::size_t>(j)].P;
        ASSERT_NE(filter->belief(i).innovation, nullptr);
      }
      expect_state(*filter, i, node, k);
    }
  }
  EXPECT_GT(copied, 50);
  EXPECT_GT(found, 30);
}

TEST(SparseFilter, NisIsOfTheCorrectedInnovation) {
  const Knowledge knowledge = known();
  auto filter = method("omp_ekf", knowledge);
  Target world(knowledge);
  LiteralNode literal(knowledge, 1);
  FaultTable faults;
  for (int k = 1; k <= 20; ++k) {
    const Readings readings = world.next({1});
    rig::tick(*filter, knowledge, readings, rig::Links(knowledge), faults, k);
    literal.tick(knowledge, readings[1]);
    const Belief belief = filter->belief(1);
    ASSERT_EQ(belief.innovation == nullptr, k < 6);
    if (k < 6) continue;
    const Eigen::Map<const Eigen::VectorXd> nu(belief.innovation, 6);
    const Eigen::Map<const Eigen::MatrixXd> S(belief.innovation_covariance, 6, 6);
    const double nis = nu.dot(Eigen::MatrixXd(S).llt().solve(nu));
    EXPECT_NEAR(nis, literal.nis, 1e-6 * (1 + literal.nis)) << k;
  }
}

TEST(SparseFilter, StartsByPredictingOrByUpdating) {
  const Knowledge knowledge = known();
  auto waits = method("omp_ekf", knowledge), at_once = method("omp_ekf", knowledge, {{"startup", "update"}}),
       unprotected = method("window_ekf", knowledge), ordinary = method("local_ekf", knowledge);
  Target world(knowledge);
  FaultTable faults;
  Eigen::VectorXd predicted = knowledge.estimates.col(0);
  for (int k = 1; k <= 12; ++k) {
    const Readings readings = world.next({1});
    predicted = windows::loop() * predicted;
    for (auto* one : {&waits, &at_once, &unprotected, &ordinary})
      rig::tick(**one, knowledge, readings, rig::Links(knowledge), faults, k);
    for (int i = 0; i < 5; ++i) {
      EXPECT_LT((rig::mean(*unprotected, i, 6) - rig::mean(*ordinary, i, 6)).norm(), 1e-9) << "the same filter";
      EXPECT_LT((rig::bound(*unprotected, i, 6) - rig::bound(*ordinary, i, 6)).norm(), 1e-12);
      if (k >= 6) continue;
      EXPECT_LT((rig::mean(*waits, i, 6) - predicted).norm(), 1e-12) << "no reading is used yet";
      EXPECT_EQ(rig::mean(*at_once, i, 6), rig::mean(*unprotected, i, 6)) << "an ordinary filter until then";
      EXPECT_EQ(waits->reconstruction(i).entries, nullptr);
    }
    if (k < 6) continue;
    EXPECT_NE(rig::mean(*waits, 0, 6), predicted);
    EXPECT_NE(rig::mean(*at_once, 1, 6), rig::mean(*unprotected, 1, 6)) << "the attack is taken off";
  }
}

// A missing channel is a missing reading: predict only, and the window fills anew.
TEST(SparseFilter, RefillsItsWindowAfterAMissingReading) {
  for (const char* startup : {"predict", "update"}) {
    const Knowledge knowledge = known();
    auto filter = method("omp_game", knowledge, {{"startup", startup}, {"beta", 0}});
    Target world(knowledge);
    FaultTable faults;
    for (int k = 1; k <= 30; ++k) {
      Readings readings = world.next();
      if (k == 15) readings[2][k % 6] = k % 2 == 0 ? std::nan("") : std::numeric_limits<double>::infinity();
      const Eigen::VectorXd before = rig::mean(*filter, 2, 6);
      rig::tick(*filter, knowledge, readings, rig::Links(knowledge), faults, k);
      const bool waits = k < 6 || (k >= 15 && k < 21);
      EXPECT_EQ(filter->choice(2) < 0, waits) << k;
      EXPECT_EQ(filter->reconstruction(2).entries == nullptr, waits) << k;
      if (k == 15 || (waits && startup[0] == 'p')) {
        EXPECT_EQ(filter->belief(2).innovation, nullptr);
        EXPECT_LT((rig::mean(*filter, 2, 6) - windows::loop() * before).norm(), 1e-12) << k;
      } else {
        EXPECT_NE(filter->belief(2).innovation, nullptr) << k;
      }
      for (const int other : {0, 1, 3, 4}) {
        EXPECT_EQ(filter->choice(other) < 0, k < 6);
        EXPECT_TRUE(!waits || filter->choice(other) != 2) << "whose E is not of this tick";
      }
    }
    EXPECT_TRUE(rig::faults_of(faults, *filter).empty()) << "nothing failed";
  }
}

// What is copied comes over the link, where it can be jammed and falsified.
TEST(SparseFilter, CopiesWhatItHears) {
  const Knowledge knowledge = known();
  auto filter = method("omp_game", knowledge, {{"greedy", true}});
  Target world(knowledge);
  FaultTable faults;
  for (int k = 1; k <= 8; ++k) {
    rig::Links links(knowledge);
    const auto from_1_to_4 = static_cast<std::size_t>(knowledge.graph.find(0, 3));
    const auto from_1_to_2 = static_cast<std::size_t>(knowledge.graph.find(0, 1));
    links.state[from_1_to_4] = LinkState::dos;
    links.state[from_1_to_2] = LinkState::fdi;
    links.injected(2, static_cast<Eigen::Index>(from_1_to_2)) = 0.25;
    rig::tick(*filter, knowledge, world.next(), links, faults, k);
    if (k < 6) continue;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(filter->choice(i), 0) << "all are clean, so the lowest of equals";
    EXPECT_EQ(filter->choice(3), 2) << "node 1 is not heard there";
    EXPECT_EQ(rig::mean(*filter, 2, 6), rig::mean(*filter, 0, 6));
    EXPECT_EQ(rig::bound(*filter, 1, 6), rig::bound(*filter, 0, 6));
    Eigen::VectorXd falsified = rig::mean(*filter, 0, 6);
    falsified[2] += 0.25;
    EXPECT_LT((rig::mean(*filter, 1, 6) - falsified).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace vigil::filter_test
