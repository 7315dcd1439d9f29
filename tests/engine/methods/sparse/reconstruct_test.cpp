/// Each solver of a window beside its literal form: specification of seed 001, sections 8, 10, 11, 12.
#include <gtest/gtest.h>

#include "tests/engine/methods/sparse/references.hpp"

namespace vigil::reconstruct_test {
namespace {

using sparse::WindowShape;
using windows::Plain;
using windows::Scene;
using windows::Tampering;

constexpr Tampering kAll[] = {Tampering::none, Tampering::random, Tampering::constant};

Scene nth_scene(std::uint64_t trial, int T = 6, const Json& R = 1e-4) {
  const Json places[] = {{-6, 8, 0}, {-10, 0, 0}, {-6, -8, 0}, {6, -8, 0}, {0, -10, 0}};
  return windows::scene(windows::station(places[trial % 5], R), trial, T, kAll[trial % 3]);
}

Eigen::VectorXd solved(sparse::Reconstructor& reconstructor, const sparse::Regression& regression) {
  Eigen::VectorXd E = Eigen::VectorXd::Constant(regression.r.size(), 77);
  EXPECT_TRUE(reconstructor.solve(regression, E));
  return E;
}

int entries_of(const Eigen::VectorXd& E) { return static_cast<int>((E.array() != 0).count()); }

TEST(StopLevel, IsThatOfTheSpecification) {
  EXPECT_NEAR(sparse::stop_level(1.5, 0.01, 30), 0.10628, 5e-6);
  EXPECT_DOUBLE_EQ(sparse::stop_level(3, 0.01, 30), 2 * sparse::stop_level(1.5, 0.01, 30));
  EXPECT_DOUBLE_EQ(sparse::stop_level(1.5, 1, 30), 100 * sparse::stop_level(1.5, 0.01, 30));
  EXPECT_EQ(sparse::stop_level(1.5, 0.01, 1), 0.015);
  EXPECT_EQ(sparse::stop_level(1.5, 0.01, 0), 0) << "one reading leaves no freedom";
}

TEST(Gram, IsThatOfTheWhitenedProjection) {
  for (const Json& R : {Json(1e-4), windows::coloured()}) {
    const Scene scene = nth_scene(4, 6, R);
    const Plain plain = windows::plain(scene);
    const double sigma = R.is_number() ? 0.01 : 1;
    const Eigen::MatrixXd W = sigma * plain.W, expected = W.transpose() * plain.M * W;
    Eigen::MatrixXd G(36, 36);
    Eigen::VectorXd b(36);
    sparse::gram(windows::regress(scene), G, b);
    EXPECT_LT((G - expected).norm(), 1e-12 * expected.norm());
    EXPECT_LT((b - expected * plain.r).norm(), 1e-12 * (expected * plain.r).norm());
  }
}

// In the white case the stop is on ||M r - M E||, whose own dictionary is M: both residuals are one.
TEST(OmpOfAWindow, IsTheLiteralAlgorithm) {
  int found = 0;
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    const int T = trial % 7 == 6 ? 10 : 6;
    const Scene scene = nth_scene(trial, T);
    const Plain plain = windows::plain(scene);
    const WindowShape shape{6, T, 6, 2};
    for (const char* stop : {"noise", "fixed"}) {
      const auto omp = sparse::make_omp(rig::completed("omp_ekf", {{"stop", stop}}), shape);
      const double eps = stop[0] == 'n' ? sparse::stop_level(1.5, 0.01, shape.freedom()) : 0;
      const Eigen::VectorXd b = plain.M * plain.r;
      const auto literal = windows::literal_omp(plain.M, b, std::min(2 * T, shape.freedom()), eps,
                                                [&](const auto& E) { return (b - plain.M * E).norm(); });
      const Eigen::VectorXd E = solved(*omp, windows::regress(scene));
      EXPECT_LT((E - literal.E).norm(), 1e-8 * (1 + literal.E.norm())) << trial;
      EXPECT_EQ(entries_of(E), static_cast<int>(literal.support.size())) << trial << " " << stop;
      found += entries_of(E) > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(found, 450) << "all attacked windows, and with a fixed count every window";
}

// Whitened rows, sigma 1, and E in the channels' own units: the dictionary is Q2' W.
TEST(OmpOfAWindow, WhitensTheRowsOfAColouredNoise) {
  for (const Json& R : {windows::coloured(), Json{1e-4, 4e-4, 1e-4, 1e-4, 1e-4, 9e-4}}) {
    for (std::uint64_t trial = 0; trial < 60; ++trial) {
      const Scene scene = nth_scene(trial, 6, R);
      const Plain plain = windows::plain(scene);
      const Eigen::MatrixXd D = plain.M * plain.W;
      const Eigen::VectorXd y = D * plain.r;
      const auto literal =
          windows::literal_omp(D.transpose() * D, D.transpose() * y, 12, sparse::stop_level(1.5, 1, 30),
                               [&](const auto& E) { return (y - D * E).norm(); });
      const auto omp = sparse::make_omp(rig::completed("omp_ekf"), {6, 6, 6, 2});
      const Eigen::VectorXd E = solved(*omp, windows::regress(scene));
      EXPECT_LT((E - literal.E).norm(), 1e-7 * (1 + literal.E.norm())) << trial;
      EXPECT_EQ(entries_of(E), static_cast<int>(literal.support.size())) << trial;
    }
  }
}

// M_jj below 1e-12 counts as that: such a column is picked by neither, however far the picks go.
TEST(OmpOfAWindow, StopsWhereNoFreedomIsLeft) {
  for (const int T : {1, 2, 3}) {
    const WindowShape shape{6, T, 6, 6};
    const auto omp = sparse::make_omp(rig::completed("omp_ekf", {{"stop", "fixed"}}), shape);
    const Scene scene = nth_scene(1, T);
    const Eigen::VectorXd E = solved(*omp, windows::regress(scene));
    EXPECT_TRUE(E.allFinite());
    EXPECT_LE(entries_of(E), shape.freedom()) << "more than p T - n entries explain anything";
    const auto none = sparse::make_omp(rig::completed("omp_ekf"), {6, T, 6, 0});
    EXPECT_EQ(entries_of(solved(*none, windows::regress(scene))), 0);
  }
}

TEST(OmpOfAWindow, NamesAThresholdOnlyWhereItStopsAtOne) {
  const WindowShape shape{6, 6, 6, 2};
  EXPECT_NEAR(sparse::make_omp(rig::completed("omp_ekf"), shape)->threshold(0.01), 0.10628, 5e-6);
  EXPECT_TRUE(std::isnan(sparse::make_omp(rig::completed("omp_ekf", {{"stop", "fixed"}}), shape)->threshold(0.01)));
}

TEST(GradientOfAWindow, IsTheLiteralDescent) {
  int dense = 0;
  for (std::uint64_t trial = 0; trial < 120; ++trial) {
    const Scene scene = nth_scene(trial);
    const Plain plain = windows::plain(scene);
    for (const char* projection : {"block", "element"}) {
      const int q = trial % 4 == 0 ? 1 : 2;
      const double shrink = trial % 2 == 0 ? 0.2 : 0.05;
      const auto gradient = sparse::make_gradient(
          rig::completed("etpg_ekf", {{"projection", projection}, {"shrink", shrink}}), {6, 6, 6, q});
      const Eigen::VectorXd E = solved(*gradient, windows::regress(scene));
      const Eigen::VectorXd literal = windows::literal_gradient(plain, q, shrink, 300, projection[0] == 'b');
      EXPECT_LT((E - literal).norm(), 1e-9 * (1 + literal.norm())) << trial << " " << projection;
      EXPECT_LE(entries_of(E), 6 * q);
      dense += entries_of(E) == 6 * q ? 1 : 0;
    }
  }
  EXPECT_GT(dense, 200);
}

TEST(GradientOfAWindow, TakesNoStepWithoutChannels) {
  const auto gradient = sparse::make_gradient(rig::completed("etpg_ekf"), {6, 6, 6, 0});
  EXPECT_EQ(entries_of(solved(*gradient, windows::regress(nth_scene(1)))), 0);
  const auto all = sparse::make_gradient(rig::completed("etpg_ekf", {{"max_steps", 1}}), {6, 6, 6, 6});
  EXPECT_EQ(entries_of(solved(*all, windows::regress(nth_scene(1)))), 36);
}

TEST(ChannelsOfAWindow, AreTheBestSetByEnumeration) {
  int sizes[4] = {0, 0, 0, 0};
  for (std::uint64_t trial = 0; trial < 120; ++trial) {
    Scene scene = nth_scene(trial);
    for (int j = 0; j < 6; ++j) scene.readings(4, j) += trial % 4 == 1 ? (j % 2 == 0 ? 3 : -2) : 0;
    const Plain plain = windows::plain(scene);
    for (const int q : {1, 2, 3}) {
      const auto channels =
          sparse::make_channels(rig::completed("omp_game_channels", {{"block_floor", 0}}), {6, 6, 6, q});
      const auto literal = windows::literal_channels(plain.M, plain.r, q, sparse::stop_level(1.5, 0.01, 30));
      const Eigen::VectorXd E = solved(*channels, windows::regress(scene));
      // Three channels leave 12 of 30 directions; the Gram form squares the condition of such a fit.
      EXPECT_LT((E - literal.E).norm(), 1e-5 * (1 + literal.E.norm())) << trial << " " << q;
      EXPECT_NEAR((plain.M * (plain.r - E)).norm(), (plain.M * (plain.r - literal.E)).norm(), 1e-9) << trial;
      EXPECT_EQ(entries_of(E), 6 * static_cast<int>(literal.channels.size())) << trial;
      ++sizes[literal.channels.size()];
    }
  }
  for (const int count : sizes) EXPECT_GT(count, 10) << "sets of every size";
}

TEST(ChannelsOfAWindow, DropSmallEntries) {
  const Scene scene = nth_scene(1);
  const auto raw = sparse::make_channels(rig::completed("omp_game_channels", {{"block_floor", 0}}), {6, 6, 6, 2}),
             floored = sparse::make_channels(rig::completed("omp_game_channels"), {6, 6, 6, 2});
  const Eigen::VectorXd all = solved(*raw, windows::regress(scene)), large = solved(*floored, windows::regress(scene));
  int dropped = 0;
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    const bool kept = std::abs(all[i]) >= 1;
    EXPECT_EQ(large[i], kept ? all[i] : 0);
    dropped += !kept && all[i] != 0 ? 1 : 0;
  }
  EXPECT_GT(dropped, 0);
}

// More entries than p T - n explain anything in more than one way, so no such set is tried.
TEST(ChannelsOfAWindow, AreNoMoreThanTheFreedomAllows) {
  for (const int T : {1, 2, 3}) {
    for (const int q : {1, 2, 4, 6}) {
      const auto channels = sparse::make_channels(rig::completed("omp_game_channels"), {6, T, 6, q});
      for (std::uint64_t trial = 0; trial < 9; ++trial) {
        const Eigen::VectorXd E = solved(*channels, windows::regress(nth_scene(trial, T)));
        EXPECT_TRUE(E.allFinite());
        EXPECT_LE(entries_of(E), std::max(0, 6 * T - 6));
      }
    }
  }
}

TEST(L1OfAWindow, IsTheLeastNormOfAll) {
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    const Scene scene = nth_scene(trial, 3);
    const Plain plain = windows::plain(scene);
    const auto l1 = sparse::make_l1(rig::completed("l1_ekf"), {6, 3, 6, 2});
    const Eigen::VectorXd E = solved(*l1, windows::regress(scene));
    EXPECT_LT((plain.M * (E - plain.r)).norm(), 1e-5 * (1 + plain.r.norm())) << "explains the window";
    EXPECT_NEAR(E.lpNorm<1>(), windows::least_l1(plain), 1e-6 * (1 + E.lpNorm<1>())) << trial;
  }
}

// Section 10: dense, with as many entries at zero as the state has components.
TEST(L1OfAWindow, LeavesAsManyZerosAsStates) {
  int exact = 0;
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    const Scene scene = nth_scene(trial);
    const auto l1 = sparse::make_l1(rig::completed("l1_ekf"), {6, 6, 6, 2});
    const Eigen::VectorXd E = solved(*l1, windows::regress(scene));
    EXPECT_LE(entries_of(E), 30) << trial;
    exact += entries_of(E) == 30 ? 1 : 0;
  }
  EXPECT_GE(exact, 50) << "fewer only where an entry happens to be below 1e-6 of the largest";
}

TEST(L1OfAWindow, SaysNothingWithoutFreedom) {
  const auto l1 = sparse::make_l1(rig::completed("l1_ekf"), {6, 1, 6, 2});
  EXPECT_EQ(entries_of(solved(*l1, windows::regress(nth_scene(1, 1)))), 0);
}

// A copy is a fork: its answers are its own.
TEST(Reconstructors, CopiesAgree) {
  const WindowShape shape{6, 6, 6, 2};
  const auto game = rig::completed("omp_game");
  std::unique_ptr<sparse::Reconstructor> all[] = {sparse::make_omp(game, shape),
                                                  sparse::make_l1(rig::completed("l1_ekf"), shape),
                                                  sparse::make_gradient(rig::completed("etpg_ekf"), shape),
                                                  sparse::make_channels(rig::completed("omp_game_channels"), shape)};
  for (auto& one : all) {
    solved(*one, windows::regress(nth_scene(2)));
    const auto copy = one->clone();
    const Eigen::VectorXd other = solved(*one, windows::regress(nth_scene(4)));
    EXPECT_EQ(solved(*copy, windows::regress(nth_scene(5))), solved(*one, windows::regress(nth_scene(5))));
    EXPECT_EQ(solved(*copy, windows::regress(nth_scene(4))), other);
  }
}

}  // namespace
}  // namespace vigil::reconstruct_test
