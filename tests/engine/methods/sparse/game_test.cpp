/// The potential game: specification of seed 001, sections 9 and 15.
#include "engine/methods/sparse/game.hpp"

#include <gtest/gtest.h>

#include "engine/linalg/chi_square.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::game_test {
namespace {

using sparse::PotentialGame;

constexpr int kNodes = 5;

/// The specification's graph: 1-2, 1-3, 1-4, 1-5, 2-5, 3-4, 3-5.
Graph network() { return {kNodes, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 3}, {2, 4}}}; }

struct Table {
  explicit Table(Graph over = network(), const Json& params = Json::object())
      : graph(std::move(over)),
        game(rig::completed("omp_game", params), Draws(1, "method.game"), graph),
        ready(static_cast<std::size_t>(graph.nodes()), 1),
        heard(graph.links().size(), 1) {}

  void play(std::int64_t k, const Eigen::MatrixXd& E) { game.play(k, E, ready, heard); }
  void lose(int from, int to) { heard[static_cast<std::size_t>(graph.find(from, to))] = 0; }

  Graph graph;
  PotentialGame game;
  std::vector<char> ready, heard;
};

/// Each node's own attack: entries with probability `share`, of any size from tiny to tens.
Eigen::MatrixXd attacks(std::uint64_t seed, double share, int entries = 36, int nodes = kNodes) {
  const Draws draws(seed, "attacks");
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(entries, nodes);
  for (int j = 0; j < nodes; ++j) {
    for (int c = 0; c < entries; ++c) {
      const auto index = static_cast<std::uint32_t>(c);
      if (draws.uniform(2 * j, index) < share) E(c, j) = 8 * draws.normal(2 * j + 1, index);
    }
  }
  return E;
}

/// (7) by hand, over the whole network.
double utility(const Eigen::MatrixXd& E, const Graph& graph, int i, int j, bool split) {
  double apart = 0;
  for (int l = 0; l < graph.nodes(); ++l) {
    if (graph.find(l, i) < 0) continue;
    for (Eigen::Index c = 0; c < E.rows(); ++c) apart += (E(c, j) != 0) != (E(c, l) != 0) ? 1 : 0;
  }
  const double size = std::max(E.col(j).cwiseAbs().maxCoeff(), 0.01);
  return split ? -2 * std::log(size) - apart : -2 * std::log(size + apart);
}

TEST(Game, HasTheUtilitiesAndProbabilitiesOfTheSpecification) {
  for (const bool split : {true, false}) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Table table(network(), {{"form", split ? "split" : "inside"}, {"beta", 0.4}});
      const Eigen::MatrixXd E = attacks(seed, 0.05 * static_cast<double>(seed % 5));
      table.play(1, E);
      for (int i = 0; i < kNodes; ++i) {
        double total = 0;
        std::vector<double> weight(kNodes, 0);
        for (int j = 0; j < kNodes; ++j) {
          if (j != i && table.graph.find(j, i) < 0) {
            EXPECT_TRUE(std::isnan(table.game.utility(i, j)) && std::isnan(table.game.probability(i, j)));
            continue;
          }
          const double expected = utility(E, table.graph, i, j, split);
          EXPECT_NEAR(table.game.utility(i, j), expected, 1e-12 * (1 + std::abs(expected)));
          weight[static_cast<std::size_t>(j)] = std::exp(0.4 * expected);
          total += weight[static_cast<std::size_t>(j)];
        }
        double sum = 0;
        for (int j = 0; j < kNodes; ++j) {
          if (weight[static_cast<std::size_t>(j)] == 0) continue;
          EXPECT_NEAR(table.game.probability(i, j), weight[static_cast<std::size_t>(j)] / total, 1e-12);
          sum += table.game.probability(i, j);
        }
        EXPECT_NEAR(sum, 1, 1e-14);
      }
    }
  }
}

// Two nodes of four entries, counted on fingers.
TEST(Game, ValuesByHand) {
  Eigen::MatrixXd E(4, 2);
  E << 0, 0.5,  //
      -4, 0,    //
      0, 0,     //
      1, 2;
  const Graph pair(2, {{0, 1}});
  Table split(pair, {{"r", 3}}), inside(pair, {{"r", 3}, {"form", "inside"}});
  split.play(1, E);
  inside.play(1, E);
  // The supports {1, 3} and {0, 3} differ in two entries; the node copied itself is no difference.
  EXPECT_NEAR(split.game.utility(0, 0), -3 * std::log(4.0) - 2, 1e-14);
  EXPECT_NEAR(split.game.utility(0, 1), -3 * std::log(2.0), 1e-14);
  EXPECT_NEAR(split.game.utility(1, 1), -3 * std::log(2.0) - 2, 1e-14);
  EXPECT_NEAR(split.game.utility(1, 0), -3 * std::log(4.0), 1e-14);
  EXPECT_NEAR(inside.game.utility(0, 0), -3 * std::log(6.0), 1e-14);
  EXPECT_NEAR(inside.game.utility(0, 1), -3 * std::log(2.0), 1e-14);
  E.setZero();
  split.play(2, E);
  EXPECT_NEAR(split.game.utility(0, 0), -3 * std::log(0.01), 1e-13) << "no attack is floored at the noise";
}

// V = sum of U_i at what each chose. A deviation of one node alone changes V by the change of its own utility: nothing
// of what the others see depends on it.
TEST(Game, HasAnExactPotential) {
  Table table(network(), {{"beta", 0.2}});
  const Eigen::MatrixXd E = attacks(3, 0.1);
  struct Play {
    std::vector<int> choices;
    double potential;
    std::vector<double> own;
  };
  std::vector<Play> plays;
  for (int k = 1; k <= 300; ++k) {
    table.play(k, E);
    Play play{{}, 0, {}};
    for (int i = 0; i < kNodes; ++i) {
      play.choices.push_back(table.game.choice(i));
      play.own.push_back(table.game.utility(i, play.choices.back()));
      play.potential += play.own.back();
    }
    plays.push_back(play);
  }
  int deviations = 0;
  for (const Play& a : plays) {
    for (const Play& b : plays) {
      int differing = 0, who = -1;
      for (std::size_t i = 0; i < kNodes; ++i) {
        if (a.choices[i] == b.choices[i]) continue;
        ++differing;
        who = static_cast<int>(i);
      }
      if (differing != 1) continue;
      ++deviations;
      const auto i = static_cast<std::size_t>(who);
      EXPECT_NEAR(a.potential - b.potential, a.own[i] - b.own[i], 1e-11);
    }
  }
  EXPECT_GT(deviations, 1000);
}

TEST(Game, IsUniformWithoutAttacksOrWithoutLearning) {
  Table clean;
  clean.play(1, Eigen::MatrixXd::Zero(36, kNodes));
  Table indifferent(network(), {{"beta", 0}});
  indifferent.play(1, attacks(1, 0.2));
  for (int i = 0; i < kNodes; ++i) {
    const double share = 1.0 / (network().degree(i) + 1);
    for (int j = 0; j < kNodes; ++j) {
      if (std::isnan(clean.game.utility(i, j))) continue;
      EXPECT_DOUBLE_EQ(clean.game.probability(i, j), share);
      EXPECT_DOUBLE_EQ(indifferent.game.probability(i, j), share);
    }
  }
}

TEST(Game, DoesNotOverflow) {
  const Json huge[] = {
      {{"beta", 1e9}, {"r", 1e6}}, {{"beta", 1e9}, {"r", 1e6}, {"form", "inside"}}, {{"u_floor", 1e-300}}};
  for (const Json& params : huge) {
    Table table(network(), params);
    Eigen::MatrixXd E = attacks(2, 0.2);
    E.col(1).setZero();
    E(0, 2) = 1e300;
    for (int k = 1; k <= 20; ++k) {
      table.play(k, E);
      for (int i = 0; i < kNodes; ++i) {
        double sum = 0;
        for (int j = 0; j < kNodes; ++j) {
          if (std::isnan(table.game.utility(i, j))) continue;
          EXPECT_TRUE(std::isfinite(table.game.utility(i, j)));
          sum += table.game.probability(i, j);
        }
        EXPECT_NEAR(sum, 1, 1e-14);
        EXPECT_GE(table.game.choice(i), 0);
      }
      EXPECT_EQ(table.game.choice(0), 1) << "the only clean one, beyond doubt";
    }
  }
}

TEST(Game, GreedyTakesTheLowestOfTheBest) {
  Table table(network(), {{"greedy", true}});
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(36, kNodes);
  for (int k = 1; k <= 20; ++k) {
    table.play(k, E);
    const int lowest[] = {0, 0, 0, 0, 0};
    for (int i = 0; i < kNodes; ++i)
      EXPECT_EQ(table.game.choice(i), lowest[i]) << "all tie, node 1 is everybody's neighbour";
  }
  E(7, 0) = 3;
  table.play(21, E);
  EXPECT_EQ(table.game.choice(0), 1);
  EXPECT_EQ(table.game.choice(1), 1);
  EXPECT_EQ(table.game.choice(2), 2);
  EXPECT_EQ(table.game.choice(3), 2) << "nodes 3 and 4 tie";
  EXPECT_EQ(table.game.choice(4), 1);
}

// A lost message takes its sender out of the candidates and out of the sums; the other direction is not touched.
TEST(Game, ALostMessageRemovesTheNeighbour) {
  Table table, without(Graph(kNodes, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {2, 3}, {2, 4}}));  // no edge 2-5
  const Eigen::MatrixXd E = attacks(6, 0.1);
  table.lose(4, 1);
  table.play(1, E);
  without.play(1, E);
  EXPECT_TRUE(std::isnan(table.game.utility(1, 4)) && std::isnan(table.game.probability(1, 4)));
  for (const int j : {0, 1}) {
    EXPECT_EQ(table.game.utility(1, j), without.game.utility(1, j));
    EXPECT_EQ(table.game.probability(1, j), without.game.probability(1, j));
  }
  EXPECT_FALSE(std::isnan(table.game.utility(4, 1))) << "node 5 still hears node 2";
  EXPECT_NE(table.game.utility(4, 4), without.game.utility(4, 4));
  EXPECT_EQ(table.game.choice(1), without.game.choice(1));
}

TEST(Game, WhoHasNoWindowNeitherPlaysNorIsCopied) {
  Table table(network(), {{"beta", 0}});
  table.ready[2] = 0;
  for (int k = 1; k <= 100; ++k) {
    table.play(k, attacks(6, 0.1));
    EXPECT_EQ(table.game.choice(2), -1);
    for (const int i : {0, 1, 3, 4}) {
      EXPECT_GE(table.game.choice(i), 0);
      EXPECT_NE(table.game.choice(i), 2);
      EXPECT_TRUE(std::isnan(table.game.utility(i, 2)));
    }
  }
  for (int j = 0; j < kNodes; ++j) EXPECT_TRUE(std::isnan(table.game.utility(2, j)));
}

TEST(Game, AloneIsItself) {
  Table table(Graph(1, {}));
  for (int k = 1; k <= 50; ++k) {
    table.play(k, attacks(static_cast<std::uint64_t>(k), 0.3, 36, 1));
    EXPECT_EQ(table.game.choice(0), 0);
    EXPECT_EQ(table.game.probability(0, 0), 1);
  }
}

// Pearson's chi-square of the choices at each node. Exceeds its 0.9999 quantile with probability 1e-4 at a node where
// the draws follow the probabilities.
TEST(Game, ChoosesAsOftenAsItsProbabilitiesSay) {
  Table table(network(), {{"beta", 0.03}});
  const Eigen::MatrixXd E = attacks(5, 0.25);
  constexpr int kPlays = 20000;
  Eigen::MatrixXd counts = Eigen::MatrixXd::Zero(kNodes, kNodes);
  for (int k = 1; k <= kPlays; ++k) {
    table.play(k, E);
    for (int i = 0; i < kNodes; ++i) counts(i, table.game.choice(i)) += 1;
  }
  for (int i = 0; i < kNodes; ++i) {
    double square = 0, least = 1;
    int candidates = 0;
    for (int j = 0; j < kNodes; ++j) {
      if (std::isnan(table.game.probability(i, j))) {
        EXPECT_EQ(counts(i, j), 0);
        continue;
      }
      const double expected = kPlays * table.game.probability(i, j);
      square += (counts(i, j) - expected) * (counts(i, j) - expected) / expected;
      least = std::min(least, table.game.probability(i, j));
      ++candidates;
    }
    EXPECT_EQ(candidates, table.graph.degree(i) + 1);
    EXPECT_GT(kPlays * least, 20) << "or the statistic is no chi-square";
    EXPECT_LT(square, chi_square_quantile(0.9999, candidates - 1)) << "node " << i;
  }
}

// The choices of nodes and of ticks are independent draws: at the same odds they do not move together.
TEST(Game, DrawsForEachNodeAndTickAnew) {
  Table table;
  const Eigen::MatrixXd E = Eigen::MatrixXd::Zero(36, kNodes);
  int together = 0, again = 0, before = -1;
  constexpr int kPlays = 4000;
  for (int k = 1; k <= kPlays; ++k) {
    table.play(k, E);
    together += table.game.choice(1) == table.game.choice(3) ? 1 : 0;  // both may take node 1: a third each
    again += table.game.choice(0) == before ? 1 : 0;
    before = table.game.choice(0);
  }
  const auto within = [&](int count, double p) { EXPECT_NEAR(count, kPlays * p, 4 * std::sqrt(kPlays * p * (1 - p))); };
  within(together, 1.0 / 9);
  within(again, 1.0 / 5);
}

}  // namespace
}  // namespace vigil::game_test
