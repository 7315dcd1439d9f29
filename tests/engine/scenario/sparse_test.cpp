/// The family sparse: what its documents must have. Specification of seed 001, sections 6 and 15.
#include <gtest/gtest.h>

#include "engine/scenario/document.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil::sparse_test {
namespace {

struct Bad {
  const char* patch;
  const char* pointer;
  const char* words;
};

class BadSparse : public testing::TestWithParam<Bad> {};

TEST_P(BadSparse, NamesTheField) {
  const Scenario preset = Scenario::preset("sparse");
  try {
    preset.patched(Json::parse(GetParam().patch));
    FAIL() << GetParam().patch;
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U) << error.what();
    EXPECT_EQ(error.problems().front().pointer, GetParam().pointer) << error.what();
    EXPECT_NE(error.problems().front().detail.find(GetParam().words), std::string::npos) << error.what();
    EXPECT_FALSE(error.problems().front().allowed.empty()) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sparse, BadSparse,
    testing::Values(
        Bad{R"({"network":{"graph":"none"}})", "/network/graph", "does not connect the 5 nodes"},
        Bad{R"({"network":{"graph":"radius3"}})", "/network/graph", "does not connect"},
        Bad{R"({"network":{"graph":"knn1"}})", "/network/graph", "does not connect"},
        Bad{R"({"network":{"edges":[[1,2],[3,4],[4,5]]}})", "/network/edges", "edges do not connect"},
        Bad{R"({"network":{"edges":[]}})", "/network/edges", "path between every two"},
        Bad{R"({"network":{"edges":[[1,2],[2,2]]}})", "/network/edges/1", "itself"},
        Bad{R"({"network":{"edges":[[1,6]]}})", "/network/edges/0/1", "node 6"},
        Bad{R"({"noise":{"Q":0}})", "/noise/Q", "positive definite"},
        Bad{R"({"noise":{"Q":[1,1,1,1,1,0]}})", "/noise/Q", "is not positive definite"},
        Bad{R"({"noise":{"P0":null}})", "/noise/P0", "positive definite"},
        Bad{R"({"noise":{"P0":[[1,1,0,0,0,0],[1,1,0,0,0,0],[0,0,1,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]]}})",
            "/noise/P0", "is not positive definite"},
        Bad{R"({"noise":{"Q":[1,1,1]}})", "/noise/Q", "expected"},
        Bad{R"({"initial":{"x0_random":1}})", "/initial/x0_random", "true or false"},
        Bad{R"({"plant":{"params":{"poles_y":[0,0]}}})", "/plant/params/poles_y", "inverted"},
        Bad{R"({"plant":{"params":{"poles_y":[0.9]}}})", "/plant/params/poles_y", "a vector of 2"},
        Bad{R"({"time":{"dt":0}})", "/time/dt", "> 0"},
        Bad{R"({"nodes":{"3":{"sensor":{"params":{"position":[1,2]}}}}})", "/nodes/3/sensor/params/position",
            "a vector of 3"},
        Bad{R"({"adversary":{"node3":{"params":{"kind":"IV"}}}})", "/adversary/node3/params/kind", "one of I, II, R"},
        Bad{R"({"family":"spars"})", "/family", "did you mean \"sparse\""}));

// Small noise is noise, whatever its scale.
TEST(Sparse, TakesDefiniteNoiseOfAnyScale) {
  const Scenario preset = Scenario::preset("sparse");
  for (const char* noise : {"1e-30", "1e30", "[1e-12,1,1,1,1,1e3]", "2.5e-5"}) {
    EXPECT_NO_THROW(preset.with("noise.Q", Json::parse(noise))) << noise;
    EXPECT_NO_THROW(preset.with("noise.P0", Json::parse(noise))) << noise;
  }
}

// A singular covariance and a network in parts stay legal elsewhere.
TEST(Sparse, AsksNothingOfOtherFamilies) {
  EXPECT_NO_THROW(Scenario::preset("consensus").with("noise.Q", 0).with("network.graph", "none"));
  EXPECT_NO_THROW(Scenario::preset("consensus").with("initial.x0_random", true));
}

// Stations stand in space; distances are those of the plane.
TEST(Sparse, BuildsEveryGraphOfItsStations) {
  const Scenario preset = Scenario::preset("sparse");
  const std::vector<std::pair<const char*, std::size_t>> links{{"ring", 10}, {"path", 8},       {"complete", 20},
                                                               {"knn2", 12}, {"radius100", 20}, {"radius9", 8}};
  for (const auto& [name, count] : links) {
    const Scenario changed = preset.with("network.graph", name);
    const auto graph = document_graph(changed.document());
    ASSERT_TRUE(graph.has_value()) << name;
    EXPECT_EQ(graph->links().size(), count) << name;
    EXPECT_TRUE(graph->connected()) << name;
  }
}

TEST(Sparse, TakesOneNodeAndAnyNumberOfThem) {
  Json document = Scenario::preset("sparse").document();
  const Json station = document["nodes"]["1"];
  document["adversary"] = Json::object();
  for (const int nodes : {1, 4, 6, 12}) {
    document["nodes"] = Json::object();
    for (int n = 1; n <= nodes; ++n) document["nodes"][std::to_string(n)] = station;
    document["network"] = {{"graph", nodes == 1 ? "none" : "ring"}};
    EXPECT_NO_THROW(Scenario::from_json(document)) << nodes;
  }
}

}  // namespace
}  // namespace vigil::sparse_test
