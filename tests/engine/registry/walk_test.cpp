// Every attack against every method of compatible shape for twenty ticks: finite output or a named fault, nothing else.
#include <cmath>

#include "engine/adversary/attack.hpp"
#include "engine/methods/method.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil {
namespace {

/// A document with one lane and one attack; nothing where the attack does not act on such places.
void walk(const std::string& method, const std::string& attack, const char* place, const char* preset) {
  SCOPED_TRACE(method + " under " + attack + " on " + place);
  Json document = Scenario::preset(preset).document();
  document["time"]["steps"] = 20;
  document["lanes"] = {{"it", {{"method", method}}}};
  Json params = Json::object();
  const bool compass = std::string(preset) == "consensus-compass";
  if (attack == "bias" && std::string(place) == "sensor:2") params = {{"vector", compass ? Json{3, 3, 1} : Json{3, 3}}};
  document["adversary"] = {{"it", {{"type", attack}, {"on", {place}}, {"params", params}}}};
  std::unique_ptr<vigil::Run> run;
  try {
    run = std::make_unique<vigil::Run>(Scenario::from_json(document), RunOptions{5, nullptr, {}});
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().pointer, "/adversary/it/on") << error.what();
    return;
  }
  test::Capture capture;
  test::run_to_end(*run, capture);
  const bool stopped = run->tick() < 20;
  EXPECT_TRUE(!stopped || !run->faults().empty()) << "a lane that stops says why";
  const int estimate = run->catalogue().find(run->world()["lanes"][0]["id"] == "it" ? "lane.it.rmse" : "");
  ASSERT_GE(estimate, 0);
  for (const Frame& frame : capture.frames) {
    for (const double value : frame.values) EXPECT_FALSE(std::isinf(value));
    if (stopped) continue;
    EXPECT_TRUE(std::isfinite(frame.values[static_cast<std::size_t>(estimate)])) << frame.k;
  }
}

TEST(RegistryWalk, EveryAttackMeetsEveryMethod) {
  int pairs = 0;
  for (const auto& method : Registry<MethodMake>::all()) {
    for (const auto& attack : Registry<AttackMake>::all()) {
      for (const char* place : {"link:*", "link:1-2", "sensor:2"}) {
        for (const char* preset : {"consensus", "consensus-compass"}) {
          walk(method.id, attack.id, place, preset);
          ++pairs;
        }
      }
    }
  }
  EXPECT_GE(pairs, 4 * 3 * 6);
}

TEST(RegistryWalk, EveryDeclarationHasItsWords) {
  const Json registry = registry_json();
  for (const char* kind : {"methods", "attacks", "plants", "sensors"}) {
    EXPECT_FALSE(registry.at(kind).empty()) << kind;
    for (const Json& entry : registry.at(kind)) {
      EXPECT_FALSE(entry.at("title").at("zh").get<std::string>().empty()) << entry.at("id");
      for (const Json& param : entry.at("parameters"))
        EXPECT_FALSE(param.at("meaning").at("zh").get<std::string>().empty()) << param.at("name");
    }
  }
}

TEST(UserPlants, OneTwoAndTwelveNodes) {
  for (const int nodes : {1, 2, 12}) {
    for (const char* graph : {"none", "path", "complete", "ring"}) {
      Json document = Scenario::preset("consensus").document();
      document["nodes"] = Json::object();
      for (int i = 1; i <= nodes; ++i)
        document["nodes"][std::to_string(i)] = {
            {"sensor", {{"type", "camera"}, {"params", {{"position", {20 * i, 150 - 7 * i}}}}}}};
      document["network"] = {{"graph", graph}};
      if (nodes < 3 && std::string(graph) == "ring") continue;
      SCOPED_TRACE(std::to_string(nodes) + " nodes, " + graph);
      vigil::Run run(Scenario::from_json(document), {1, nullptr, {}});
      test::Capture capture;
      test::run_to_end(run, capture);
      EXPECT_EQ(run.tick(), 30);
      EXPECT_TRUE(std::isfinite(test::metric(run.metrics(), "consensus", "rmse_position")));
    }
  }
}

}  // namespace
}  // namespace vigil
