// The table of compatibility says what happens: every pair that it says to meet runs twenty ticks and changes the lane,
// and no other pair changes a bit of it.
#include "engine/run/compatibility.hpp"

#include <cmath>
#include <map>

#include "engine/adversary/attack.hpp"
#include "engine/run/design.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::compatibility_test {
namespace {

constexpr int kTicks = 20;

struct Told {
  explicit Told(const Json& document) : run(made(document)) { test::run_to_end(run, capture); }
  static vigil::Run made(const Json& document) {
    const Scenario scenario = Scenario::from_json(document);
    RunOptions options{3, nullptr, {}};
    for (const DesignTask& task : design_tasks(scenario)) options.designs[task.lane] = {{"key", task.key}};
    return {scenario, std::move(options)};
  }
  vigil::Run run;
  test::Capture capture;
};

/// Whether any signal of the lane differs between the two: what the world says of its channels does not count.
bool differs(const Told& one, const Told& other, const std::string& lane) {
  const std::string prefix = "lane." + lane + ".";
  for (const Signal& signal : one.run.catalogue().all()) {
    if (!signal.name.starts_with(prefix)) continue;
    const std::string rest = signal.name.substr(prefix.size());
    if (rest.starts_with("sensor.") || rest.starts_with("actuator.")) continue;
    const auto id = static_cast<std::size_t>(signal.id);
    const std::size_t ticks = std::min(one.capture.frames.size(), other.capture.frames.size());
    if (one.capture.frames.size() != other.capture.frames.size()) return true;
    for (std::size_t k = 0; k < ticks; ++k) {
      if (!test::same_bits(one.capture.frames[k].values[id], other.capture.frames[k].values[id])) return true;
    }
  }
  return false;
}

/// Short, with nothing of its own going on. Of the observers the one whose gains are printed: others need a solver.
Json document_of(const std::string& preset) {
  Json document = Scenario::preset(preset).document();
  document["adversary"] = Json::object();
  document["time"]["steps"] = kTicks;
  if (preset == "observer-pair") document["lanes"] = {{"printed", document["lanes"]["intermediate_printed"]}};
  return document;
}

/// Attacks that play something back need something to play; a batch that is jammed from the start never fills.
Json attack_of(const Json& row) {
  Json attack{{"type", row["attack"]}, {"on", {row["place"]}}, {"from", 6}, {"params", row["params"]}};
  if (row["attack"] == "replay") attack["params"] = {{"record_from", 2}, {"record_to", 4}, {"start", 6}};
  if (row["attack"] == "eavesdrop") attack["from"] = 0;  // against a code, who has missed the beginning hears nothing
  if (row["attack"] == "dos_fdi") attack["params"]["pfdi"] = 0.6;
  return attack;
}

class Compatibility : public testing::TestWithParam<const char*> {};

TEST_P(Compatibility, SaysWhatHappensInTwentyTicks) {
  const Json document = document_of(GetParam());
  const Json table = compatibility(Scenario::from_json(document));
  ASSERT_EQ(table["rows"].size(), 3 * Registry<AttackMake>::all().size());
  const Told clean(document);
  int met = 0;
  for (const Json& row : table["rows"]) {
    if (!row["reason"].is_null()) {
      EXPECT_FALSE(row["reason"].get<std::string>().empty());
      EXPECT_TRUE(row["cells"].empty());
      continue;
    }
    SCOPED_TRACE(row["attack"].get<std::string>() + " on " + row["place"].get<std::string>());
    Json attacked = document;
    attacked["adversary"]["it"] = attack_of(row);
    const Told told(attacked);
    for (const Json& lane : table["lanes"]) {
      const Json& cell = row["cells"][lane["id"].get<std::string>()];
      EXPECT_EQ(differs(told, clean, lane["id"]), !cell["meets"].is_null()) << lane << cell;
      EXPECT_NE(cell["meets"].is_null(), cell["reason"].is_null()) << "a reason wherever they do not meet";
      met += cell["meets"].is_null() ? 0 : 1;
    }
  }
  EXPECT_GT(met, 0);
}

INSTANTIATE_TEST_SUITE_P(Presets, Compatibility,
                         testing::Values("consensus", "consensus-compass", "consensus-literal", "sparse",
                                         "replay-nongaussian", "replay-mixed", "replay-ubb", "observer-pair",
                                         "privacy-robot-linear", "privacy-robot-nonlinear", "privacy-turn",
                                         "privacy-engine"));

TEST(CompatibilityTable, NamesReasonsOnEveryChannel) {
  const Json table = compatibility(Scenario::preset("replay-mixed"));
  std::map<std::string, std::string> reasons;
  for (const Json& row : table["rows"]) {
    if (!row["reason"].is_null())
      reasons[row["attack"].get<std::string>() + row["channel"].get<std::string>()] = row["reason"].get<std::string>();
  }
  EXPECT_EQ(reasons["doslink"], "the network has no links");
  EXPECT_EQ(reasons["waveformsensor"], "it does not act on sensors");
  EXPECT_EQ(reasons.count("biasactuator"), 0U);
}

TEST(CompatibilityTable, ASparedLaneMeetsNothing) {
  Json document = Scenario::preset("replay-mixed").document();
  document["lanes"]["zeta1"]["adversary"] = false;
  const Json table = compatibility(Scenario::from_json(document));
  for (const Json& row : table["rows"]) {
    if (row["reason"].is_null()) {
      EXPECT_TRUE(row["cells"]["zeta1"]["meets"].is_null());
    }
  }
}

TEST(CompatibilityTable, NeedsTheTraceThatTheScenarioNeeds) {
  EXPECT_THROW(compatibility(Scenario::preset("mrclam")), InputError);
}

}  // namespace
}  // namespace vigil::compatibility_test
