/// Thousands of seeded mutations of good documents, patches, paths and traces: each is accepted or refused with words,
/// never anything else.
#include <gtest/gtest.h>

#include "tests/engine/scenario/mutate.hpp"
#include "tests/fuzz/cases.hpp"

namespace vigil::mutation_test {
namespace {

TEST(Mutations, OfDocumentsAreAcceptedOrRefused) {
  Random random(1);
  int accepted = 0;
  for (int n = 0; n < 2000; ++n) {
    Json document = Scenario::preset(Scenario::preset_ids()[static_cast<std::size_t>(n) % 4]).document();
    for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) mutate(document, random);
    accepted += fuzz::scenario_case(document) ? 1 : 0;
  }
  EXPECT_GT(accepted, 20);
  EXPECT_LT(accepted, 1980);
}

TEST(Mutations, OfDocumentTextsAreAcceptedOrRefused) {
  Random random(2);
  const std::string text = Scenario::preset("consensus").document().dump();
  int accepted = 0;
  for (int n = 0; n < 3000; ++n) accepted += fuzz::scenario_case(std::string_view(mutated_text(text, random))) ? 1 : 0;
  EXPECT_GT(accepted, 20);
  EXPECT_LT(accepted, 2980);
}

TEST(Mutations, DeepNestingIsRefused) {
  const std::size_t deep = 200'000;
  EXPECT_FALSE(fuzz::scenario_case(std::string_view(std::string(deep, '['))));
  EXPECT_FALSE(fuzz::scenario_case(std::string_view(std::string(deep, '[') + std::string(deep, ']'))));
  std::string objects;
  for (std::size_t n = 0; n < deep; ++n) objects += "{\"view\":";
  EXPECT_FALSE(fuzz::scenario_case(std::string_view(objects + "1" + std::string(deep, '}'))));
  EXPECT_FALSE(fuzz::patch_case(Json::parse(objects + "1" + std::string(deep, '}'))));
}

TEST(Mutations, OfPatchesAreAcceptedOrRefused) {
  Random random(3);
  const Json good = Json::parse(R"({"time":{"steps":50},"lanes":{"drop":null,"consensus":{"params":{"tau":0.02}}},
    "network":{"graph":"edges","edges":[[1,2],[2,3]]},"noise":{"Q":[1,1,1]},"metrics":{"window":{"from":1,"to":9}}})");
  int accepted = 0;
  for (int n = 0; n < 1000; ++n) {
    Json patch = good;
    mutate(patch, random);
    accepted += fuzz::patch_case(patch) ? 1 : 0;
  }
  EXPECT_GT(accepted, 20);
  EXPECT_LT(accepted, 980);
}

TEST(Mutations, OfPathsAreAcceptedOrRefused) {
  Random random(4);
  const std::string paths[] = {"lanes.consensus.params.tau", "nodes.1.sensor.params.position.0", "initial.estimates.1",
                               "view.lane", "network.graph"};
  int accepted = 0;
  for (int n = 0; n < 1000; ++n) {
    const std::string& path = paths[below(random, std::size(paths))];
    const bool keep = below(random, 2) == 0;
    accepted += fuzz::with_case(keep ? path : mutated_text(path, random), nasty(random)) ? 1 : 0;
  }
  EXPECT_GT(accepted, 5);
  EXPECT_LT(accepted, 900);
}

TEST(Mutations, OfTracesAreAcceptedOrRefused) {
  Random random(5);
  const std::string text =
      "k,t,truth.x,sensor.1.p,link.1-2.state\n0,0,150,,0\n1,0.5,157.9,-3.25e-1,1\n2,1,165,12,\n3,1.5,,,2\n";
  int accepted = 0;
  for (int n = 0; n < 20'000; ++n) accepted += fuzz::trace_case(mutated_text(text, random)) ? 1 : 0;
  EXPECT_GT(accepted, 1000);
  EXPECT_LT(accepted, 19'000);
}

}  // namespace
}  // namespace vigil::mutation_test
