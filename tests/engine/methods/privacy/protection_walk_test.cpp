// Every protection under every attack on the scenarios with a fusion centre: finite estimates or a named fault.
#include <cmath>
#include <map>

#include "engine/adversary/attack.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::protection_walk_test {
namespace {

struct World {
  const char* preset;
  const char* filter;
  int states, channels;
};
const World kWorlds[] = {{"privacy-robot-linear", "time_varying", 2, 2},
                         {"privacy-robot-nonlinear", "extended", 3, 4},
                         {"privacy-turn", "stationary", 4, 3},
                         {"privacy-engine", "stationary", 3, 1},
                         {"privacy-engine", "extended", 3, 1}};
const char* const kPlaces[] = {"link:*", "link:2-fused", "sensor:1"};

Json attack_params(const std::string& attack, const World& world, bool on_sensor) {
  const auto size = static_cast<std::size_t>(on_sensor ? world.channels : world.states);
  if (attack == "bias") return {{"vector", std::vector<double>(size, 1e6)}};
  if (attack == "dos_fdi") return {{"xi_dir", std::vector<double>(size, 1.5)}};
  if (attack == "replay") return {{"record_from", 3}, {"record_to", 6}, {"start", 9}};
  return Json::object();
}

/// Nothing where the document is refused.
std::unique_ptr<vigil::Run> made(const Json& document, std::string& pointer) {
  try {
    return std::make_unique<vigil::Run>(Scenario::from_json(document), RunOptions{5, nullptr, {}});
  } catch (const InputError& error) {
    pointer = error.problems().front().pointer;
    return nullptr;
  }
}

void expect_estimates(vigil::Run& run) {
  test::Capture capture;
  test::run_to_end(run, capture);
  const bool stopped = run.tick() < 25;
  EXPECT_TRUE(!stopped || !run.faults().empty());
  std::vector<int> estimates;
  for (const auto& signal : run.catalogue().all()) {
    const bool shown = signal.name.starts_with("lane.it.") && signal.name.find("estimate") != std::string::npos;
    if (shown) estimates.push_back(run.catalogue().find(signal.name));
  }
  EXPECT_GT(estimates.size(), 8U);
  for (const Frame& frame : capture.frames) {
    for (const double value : frame.values) EXPECT_FALSE(std::isinf(value));
    for (const int id : estimates) {
      EXPECT_TRUE(stopped || std::isfinite(frame.values[static_cast<std::size_t>(id)])) << frame.k << " " << id;
    }
  }
}

TEST(ProtectionWalk, EveryAttackMeetsEveryProtection) {
  std::map<std::string, int> walks;
  for (const auto& protection : Registry<ProtectionMake>::all()) {
    for (const World& world : kWorlds) {
      Json document = Scenario::preset(world.preset).document();
      document["time"]["steps"] = 25;
      document["lanes"] = {{"it",
                            {{"method", "fusion"},
                             {"params", {{"filter", world.filter}}},
                             {"protection", {{"type", protection.id}, {"params", Json::object()}}}}}};
      for (const auto& attack : Registry<AttackMake>::all()) {
        for (const std::string place : kPlaces) {
          SCOPED_TRACE(protection.id + " under " + attack.id + " on " + place + " of " + world.preset);
          document["adversary"]["it"] = {{"type", attack.id},
                                         {"on", {place}},
                                         {"params", attack_params(attack.id, world, place.starts_with("sensor"))}};
          std::string pointer;
          const auto run = made(document, pointer);
          if (run) {
            ++walks[protection.id];
            expect_estimates(*run);
          } else {
            EXPECT_TRUE(pointer.starts_with("/adversary/it") || pointer.starts_with("/lanes/it/protection")) << pointer;
          }
        }
      }
    }
  }
  EXPECT_GE(walks.size(), 4U);
  for (const auto& [id, count] : walks) EXPECT_GT(count, 10) << id;
}

}  // namespace
}  // namespace vigil::protection_walk_test
