/// What the scenario accepts either runs or is refused with words, and so does what is sent to a running run.
#include <gtest/gtest.h>

#include "tests/engine/scenario/mutate.hpp"
#include "tests/fuzz/cases.hpp"

namespace vigil::run_mutation_test {
namespace {

TEST(RunMutations, OfDocumentsRunOrAreRefused) {
  Random random(11);
  int ran = 0;
  for (int n = 0; n < 600; ++n) {
    Json document = Scenario::preset(Scenario::preset_ids()[static_cast<std::size_t>(n) % 3]).document();
    mutate(document, random);
    ran += fuzz::run_case(document) ? 1 : 0;
  }
  EXPECT_GT(ran, 20);
  EXPECT_LT(ran, 590);
}

/// One value of the parameters, noise or initial values changed: most are accepted, so the numbers themselves are
/// tried.
TEST(RunMutations, OfNumbersRunOrAreRefused) {
  Random random(12);
  const double numbers[] = {0, 1e-300, 1e-12, 0.5, 1, 7, 1e6, 1e150, 1e308, -1, -1e200};
  int ran = 0;
  for (int n = 0; n < 600; ++n) {
    Json flat = Scenario::preset("consensus").document().flatten();
    std::vector<std::string> places;
    for (const auto& [pointer, value] : flat.items()) {
      if (value.is_number() && pointer != "/time/steps") places.push_back(pointer);
    }
    for (int changes = 0; changes < 2; ++changes)
      flat[places[below(random, places.size())]] = numbers[below(random, std::size(numbers))];
    Json document = flat.unflatten();
    document["metrics"] = Json::object();
    for (auto& [id, lane] : document["lanes"].items()) {
      if (!lane["params"].is_object()) lane["params"] = Json::object();
    }
    ran += fuzz::run_case(document) ? 1 : 0;
  }
  EXPECT_GT(ran, 100);
  EXPECT_LT(ran, 590);
}

TEST(RunMutations, OfCommandsAreAcceptedOrRefused) {
  Random random(13);
  vigil::Run run(Scenario::preset("consensus"), {});
  fuzz::FiniteSink sink;
  for (int n = 0; n < 3; ++n) run.step(sink);
  const Json good[] = {
      Json::parse(R"({"params":{"lanes.consensus.params.tau":0.02,"adversary.links.params.pdos":0.5}})"),
      Json::parse(R"({"params":{"network.graph":"ring","adversary.links.enabled":false}})"),
      Json::parse(R"({"params":{"lanes.consensus.params.guard":"none","lanes.drop.params.bound":"tight"}})"),
      Json::parse(
          R"({"attack":{"id":"a7","type":"bias","on":["link:1-2"],"from":5,"to":9,"params":{"vector":[1,2,3]}}})"),
      Json::parse(R"({"attack":{"type":"dos","on":["link:*"],"params":{"probability":0.5}}})"),
      Json::parse(R"({"end_attack":"links"})")};
  int accepted = 0;
  for (const Json& body : good) EXPECT_TRUE(fuzz::command_case(run, body)) << body;
  for (int n = 0; n < 1500; ++n) {
    Json body = good[below(random, std::size(good))];
    mutate(body, random);
    accepted += fuzz::command_case(run, body) ? 1 : 0;
  }
  EXPECT_GT(accepted, 50);
  EXPECT_LT(accepted, 1450);
}

TEST(RunMutations, OfTracesRunOrAreRefused) {
  Random random(14);
  const std::string text =
      "k,t,truth.x,truth.y,truth.theta,sensor.1.p,sensor.1.q,link.1-2.state,link.2-1.injected.x,lane.mine.fused."
      "estimate.x\n"
      "0,0,150,70,0,,,,,150\n1,1,158,70,9,340,280,1,,158\n2,2,166,71,18,341,,2,15,166\n3,3,173,74,27,,,0,0,173\n";
  int ran = 0;
  EXPECT_TRUE(fuzz::recorded_case(text));
  for (int n = 0; n < 1000; ++n) ran += fuzz::recorded_case(mutated_text(text, random)) ? 1 : 0;
  EXPECT_GT(ran, 20);
  EXPECT_LT(ran, 980);
}

}  // namespace
}  // namespace vigil::run_mutation_test
