// Every attack against every method of compatible shape for twenty ticks: finite output or a named fault, nothing else.
#include <cmath>
#include <map>

#include "engine/adversary/attack.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/run/design.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::walk_test {
namespace {

struct World {
  const char* preset;
  int states, channels;
  std::vector<const char*> places;
  int first_estimate = 0;  ///< tick: an estimator without a prior has none before its batch is full
  int actuators = 0;       ///< of the first node
  bool flows = false;      ///< continuous time: there observers walk, and nobody else
};

const World kWorlds[] = {{"consensus", 3, 2, {"link:*", "link:1-2", "sensor:2"}},
                         {"consensus-compass", 3, 3, {"link:*", "link:1-2", "sensor:2"}},
                         {"sparse", 6, 6, {"link:*", "sensor:2"}},
                         {"replay-nongaussian", 2, 2, {"sensor:1", "actuator:1"}, 2, 1},
                         {"replay-ubb", 2, 2, {"sensor:1", "actuator:1"}, 2, 1},
                         {"replay-mixed", 2, 2, {"sensor:1", "actuator:1"}, 2, 1},
                         {"privacy-robot-linear", 2, 2, {"link:*", "link:1-fused", "sensor:2"}},
                         {"privacy-robot-nonlinear", 3, 4, {"link:*", "sensor:2"}},
                         {"observer-pair", 7, 3, {"sensor:1", "actuator:1", "actuator:2.w1"}, 0, 1, true}};

Json params_of(const std::string& attack, const World& world, const std::string& place) {
  const int size = place.starts_with("sensor")     ? world.channels
                   : place.starts_with("actuator") ? world.actuators
                                                   : world.states;
  if (attack == "bias") return {{"vector", std::vector<double>(static_cast<std::size_t>(size), 3.0)}};
  if (attack == "ramp") return {{"slope", std::vector<double>(static_cast<std::size_t>(size), 0.5)}};
  if (attack == "coordinated") return {{"shift", std::vector<double>(static_cast<std::size_t>(world.states), 1.0)}};
  if (attack == "waveform") return {{"pieces", Json::array({Json::array({1, 0, 0, 2, 0, 5, 0})})}};
  if (attack == "dos_fdi") return {{"xi_dir", std::vector<double>(world.states, 1.5)}};
  if (attack == "replay") return {{"record_from", 3}, {"record_to", 6}, {"start", 9}};
  return Json::object();
}

/// The run of a document with one lane and one attack. Nothing where it is refused: an attack that does not act on such
/// places, or a method that does not fit the plant, which then is refused without an attack, too.
std::unique_ptr<vigil::Run> made(Json document) {
  const auto make = [&] {
    const Scenario scenario = Scenario::from_json(document);
    RunOptions options{5, nullptr, {}};
    for (const DesignTask& task : design_tasks(scenario)) options.designs[task.lane] = {{"key", task.key}};
    return std::make_unique<vigil::Run>(scenario, options);
  };
  try {
    return make();
  } catch (const InputError& error) {
    const std::string pointer = error.problems().front().pointer;
    if (!pointer.starts_with("/lanes/it/p")) {  // its params, or its protection's
      EXPECT_TRUE(pointer == "/adversary/it/on" || pointer == "/adversary/it/params") << error.what();
      return nullptr;
    }
    document["adversary"] = Json::object();
    EXPECT_THROW(make(), InputError) << error.what();
    return nullptr;
  }
}

/// Twenty ticks. False where the document is refused.
bool walk(const std::string& method, const std::string& attack, const char* place, const World& world,
          const Json& protection = {{"type", "none"}}) {
  SCOPED_TRACE(protection.dump() + method + " under " + attack + " on " + place + " of " + world.preset);
  Json document = Scenario::preset(world.preset).document();
  document["time"]["steps"] = 20;
  document["lanes"] = {{"it", {{"method", method}, {"protection", protection}}}};
  if (world.flows) document["lanes"]["it"]["params"] = {{"gains", "printed"}};
  const Json params = params_of(attack, world, place);
  // jammed from the beginning, an estimator that starts from a batch of readings would never start
  const int from = attack == "dos" ? 5 : 1;
  document["adversary"] = {{"it", {{"type", attack}, {"on", {place}}, {"from", from}, {"params", params}}}};
  const auto run = made(document);
  if (!run) return false;
  test::Capture capture;
  test::run_to_end(*run, capture);
  const bool stopped = run->tick() < 20;
  EXPECT_TRUE(!stopped || !run->faults().empty()) << "a lane that stops says why";
  const int rmse = run->catalogue().find("lane.it.rmse");
  EXPECT_GE(rmse, 0);
  for (const Frame& frame : capture.frames) {
    for (const double value : frame.values) EXPECT_FALSE(std::isinf(value));
    if (stopped || frame.k < world.first_estimate) continue;
    EXPECT_TRUE(std::isfinite(frame.values[static_cast<std::size_t>(rmse)])) << frame.k;
  }
  return true;
}

TEST(RegistryWalk, EveryAttackMeetsEveryMethod) {
  std::map<std::string, int> walks;  ///< by method and by attack
  for (const auto& method : Registry<MethodMake>::all()) {
    if (method.id == "matched_observer") continue;  // its gains need a solver: tests/server/synthesis runs it
    for (const auto& attack : Registry<AttackMake>::all()) {
      for (const World& world : kWorlds) {
        const bool flows = method.id == "intermediate_observer";
        if (flows != world.flows) continue;
        for (const char* place : world.places) {
          const int ran = walk(method.id, attack.id, place, world) ? 1 : 0;
          walks[method.id] += ran;
          walks[attack.id] += ran;
        }
      }
    }
  }
  for (const auto& [id, count] : walks) EXPECT_GT(count, 0) << id << " fits no preset";
}

TEST(RegistryWalk, EveryAttackMeetsEveryProtection) {
  std::map<std::string, int> walks;
  for (const auto& protection : Registry<ProtectionMake>::all()) {
    for (const auto& attack : Registry<AttackMake>::all()) {
      for (const World& world : kWorlds) {
        if (!std::string(world.preset).starts_with("privacy")) continue;
        for (const char* place : world.places)
          walks[protection.id] += walk("fusion", attack.id, place, world, {{"type", protection.id}}) ? 1 : 0;
      }
    }
  }
  for (const auto& [id, count] : walks) EXPECT_GT(count, 0) << id << " fits no preset";
}

TEST(RegistryWalk, EveryDeclarationHasItsWords) {
  const Json registry = registry_json();
  for (const char* kind : {"methods", "protections", "attacks", "plants", "sensors"}) {
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
}  // namespace vigil::walk_test
