#include "engine/world/graph.hpp"

#include <gtest/gtest.h>

#include "engine/core/input_error.hpp"

namespace vigil::graph_test {
namespace {

/// The eight cameras of seed 000, in `unit` of metres.
Eigen::Matrix2Xd cameras(double unit = 100) {
  Eigen::Matrix2Xd positions(2, 8);
  positions << 0.6, 0.6, 1.2, 1.8, 2.4, 2.4, 1.8, 1.2,  //
      0.6, 1.8, 1.8, 1.8, 1.8, 1.6, 1.2, 1.2;
  return unit * positions;
}

std::vector<int> degrees(const Graph& graph) {
  std::vector<int> result;
  for (int node = 0; node < graph.nodes(); ++node) result.push_back(graph.degree(node));
  return result;
}

struct Known {
  const char* name;
  std::vector<int> degrees;
};

class KnownGraph : public testing::TestWithParam<Known> {};

TEST_P(KnownGraph, HasTheSpecifiedDegrees) {
  EXPECT_EQ(degrees(make_graph(GetParam().name, cameras())), GetParam().degrees);
  EXPECT_TRUE(is_graph_name(GetParam().name));
}

INSTANTIATE_TEST_SUITE_P(
    Graph, KnownGraph,
    testing::Values(Known{"ladder", {2, 2, 3, 3, 2, 2, 3, 3}}, Known{"ring", {2, 2, 2, 2, 2, 2, 2, 2}},
                    Known{"path", {1, 2, 2, 2, 2, 2, 2, 1}}, Known{"knn2", {2, 3, 3, 4, 2, 2, 2, 4}},
                    Known{"knn3", {3, 3, 4, 4, 3, 3, 4, 4}}, Known{"radius85", {1, 2, 4, 5, 3, 3, 5, 5}},
                    Known{"complete", {7, 7, 7, 7, 7, 7, 7, 7}}, Known{"none", {0, 0, 0, 0, 0, 0, 0, 0}}));

TEST(Graph, IsTheSameInMetres) {
  for (const char* name : {"knn1", "knn2", "knn3", "knn4", "knn5", "knn6", "knn7"}) {
    EXPECT_EQ(make_graph(name, cameras(1)).links(), make_graph(name, cameras(100)).links()) << name;
  }
  EXPECT_EQ(make_graph("radius0.85", cameras(1)).links(), make_graph("radius85", cameras(100)).links());
  EXPECT_EQ(make_graph("radius0.6", cameras(1)).links(), make_graph("radius60", cameras(100)).links());
}

TEST(Graph, GroupsLinksByReceiver) {
  const Graph graph(4, {{2, 0}, {0, 1}, {3, 0}, {1, 0}});
  const std::vector<Link> expected{{1, 0}, {2, 0}, {3, 0}, {0, 1}, {0, 2}, {0, 3}};
  EXPECT_EQ(graph.links(), expected);
  EXPECT_EQ(graph.first_in(0), 0);
  EXPECT_EQ(graph.first_in(1), 3);
  EXPECT_EQ(graph.degree(0), 3);
  EXPECT_EQ(graph.max_degree(), 3);
  EXPECT_EQ(graph.find(0, 2), 4);
  EXPECT_EQ(graph.find(1, 2), -1);
  EXPECT_EQ(graph.find(0, 9), -1);
  EXPECT_EQ(graph.find(0, -1), -1);
}

TEST(Graph, LadderHasItsTwoChords) {
  const Graph ladder = make_graph("ladder", cameras());
  EXPECT_GE(ladder.find(2, 7), 0);
  EXPECT_GE(ladder.find(3, 6), 0);
  EXPECT_EQ(ladder.find(2, 6), -1);
  EXPECT_EQ(ladder.links().size(), 20U);
}

TEST(Graph, CountsAnEdgeOnce) { EXPECT_EQ(Graph(2, {{0, 1}, {1, 0}, {0, 1}}).links().size(), 2U); }

TEST(Graph, KnowsWhetherItHangsTogether) {
  EXPECT_TRUE(make_graph("path", cameras()).connected());
  EXPECT_FALSE(Graph(4, {{0, 1}, {2, 3}}).connected());
  EXPECT_FALSE(make_graph("none", cameras()).connected());
  EXPECT_TRUE(Graph(1, {}).connected());
  EXPECT_TRUE(Graph().connected());
}

TEST(Graph, SmallOnes) {
  EXPECT_EQ(make_graph("ring", cameras().leftCols(1)).links().size(), 0U);
  EXPECT_EQ(make_graph("ring", cameras().leftCols(2)).links().size(), 2U);
  EXPECT_EQ(make_graph("ring", cameras().leftCols(3)).links().size(), 6U);
  EXPECT_EQ(make_graph("complete", cameras().leftCols(1)).links().size(), 0U);
}

TEST(Graph, RefusesBadEdges) {
  const std::vector<std::pair<int, int>> bad[] = {{{0, 1}, {1, 1}}, {{0, 1}, {0, 3}}, {{0, 1}, {-1, 0}}};
  for (const auto& edges : bad) {
    try {
      Graph(3, edges);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, "/network/edges/1");
    }
  }
}

TEST(Graph, RefusesNamesThatDoNotFit) {
  for (const char* name : {"", "star", "knn", "knn0", "knn8", "knn-1", "knn1.5", "knn2x", "radius", "radius0",
                           "radius-1", "radiusnan", "radiusinf", "radius1x", "Ladder"}) {
    try {
      make_graph(name, cameras());
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, "/network/graph") << name;
    }
  }
  EXPECT_THROW(make_graph("ladder", cameras().leftCols(7)), InputError);
  EXPECT_THROW(make_graph("knn2", Eigen::Matrix2Xd::Constant(2, 8, std::nan(""))), InputError);
  EXPECT_THROW(make_graph("radius1", Eigen::Matrix2Xd::Constant(2, 8, std::nan(""))), InputError);
  EXPECT_NO_THROW(make_graph("ladder", Eigen::Matrix2Xd::Constant(2, 8, std::nan(""))));
  EXPECT_FALSE(is_graph_name("edges"));
  EXPECT_TRUE(is_graph_name("knn12"));
}

}  // namespace
}  // namespace vigil::graph_test
