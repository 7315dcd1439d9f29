#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "engine/adversary/attack.hpp"
#include "engine/methods/method.hpp"
#include "engine/run/compatibility.hpp"
#include "engine/scenario/markdown.hpp"
#include "engine/scenario/scenario.hpp"
#include "tests/engine/scenario/small_schema.hpp"
#include "tests/fuzz/cases.hpp"

namespace vigil::schema_test {
namespace {

TEST(Schema, AcceptsEveryPreset) {
  for (const auto& id : Scenario::preset_ids()) {
    const Scenario preset = Scenario::preset(id);
    const Json schema = preset.schema();
    EXPECT_EQ(SmallSchema(schema).check(preset.document()), "") << id;
  }
}

struct Bad {
  const char* place;
  const char* value;
};

class AgainstSchema : public testing::TestWithParam<Bad> {};

TEST_P(AgainstSchema, IsRefusedByBoth) {
  const Scenario preset = Scenario::preset("consensus");
  Json document = preset.document();
  document[Json::json_pointer(GetParam().place)] = Json::parse(GetParam().value);
  const Json schema = preset.schema();
  EXPECT_NE(SmallSchema(schema).check(document), "");
  EXPECT_THROW(Scenario::from_json(document), InputError);
}

INSTANTIATE_TEST_SUITE_P(
    Schema, AgainstSchema,
    testing::Values(Bad{"/extra", "1"}, Bad{"/time/dt", "0"}, Bad{"/time/steps", "0"}, Bad{"/nodes/a-b", "{}"},
                    Bad{"/nodes/1/sensor/params/z", "0"}, Bad{"/nodes/1/sensor/params/zz", "0"},
                    Bad{"/nodes/1/sensor", "{\"type\":\"camera\"}"}, Bad{"/plant/params/b", "-1"},
                    Bad{"/plant/type", "\"car\""}, Bad{"/network/graph", "\"star\""}, Bad{"/network/edges", "[[1]]"},
                    Bad{"/noise/Q", "-1"}, Bad{"/initial/estimates", "\"false\""},
                    Bad{"/initial/estimates", "{\"9\":[1]}"}, Bad{"/adversary/links/params/pdos", "1.5"},
                    Bad{"/adversary/links/params/tau", "1"}, Bad{"/adversary/links/type", "\"flood\""},
                    Bad{"/adversary/links/on", "[\"engine:1\"]"}, Bad{"/adversary/links/from", "-1"},
                    Bad{"/lanes/consensus/params/tau", "-1"}, Bad{"/lanes/consensus/params/guard", "\"soft\""},
                    Bad{"/lanes/isolated/params/tau", "1"}, Bad{"/lanes/consensus/method", "\"magic\""},
                    Bad{"/lanes/consensus/path", "\"x\""}, Bad{"/lanes/B", "{}"}, Bad{"/log/policy", "\"x\""},
                    Bad{"/log/every", "0"}, Bad{"/log/keep", "0"}, Bad{"/metrics/window", "3"}));

/// Every leaf that a form would show has words in both languages.
void expect_words(const Json& schema, const std::string& where) {
  const Json properties = schema.value("properties", Json::object());
  for (const auto& [key, member] : properties.items()) {
    if (member.contains("$ref") || key == "params" || key == "sensor") continue;
    EXPECT_FALSE(member.value("title", "").empty()) << where << "/" << key;
    EXPECT_FALSE(member.value("x-zh", "").empty()) << where << "/" << key;
    expect_words(member, where + "/" + key);
  }
}

TEST(Schema, SpeaksBothLanguages) {
  const Json schema = Scenario::preset("consensus").schema();
  expect_words(schema, "");
  for (const auto& [name, definition] : schema["$defs"].items()) expect_words(definition, name);
}

TEST(Schema, DefinesEveryMethodAndAttack) {
  const Json definitions = Scenario::preset("consensus").schema()["$defs"];
  for (const auto& id : Registry<MethodMake>::ids()) EXPECT_TRUE(definitions.contains("method." + id)) << id;
  for (const auto& id : Registry<AttackMake>::ids()) EXPECT_TRUE(definitions.contains("attack." + id)) << id;
  EXPECT_EQ(definitions["method.consensus_ekf"]["properties"]["tau"]["x-live"], true);
  EXPECT_EQ(definitions["method.consensus_ekf"]["properties"]["mode"]["x-live"], false);
}

/// A default that its own table refuses would make every document that leaves it out invalid.
template <class Make>
void expect_defaults_legal() {
  for (const auto& entry : Registry<Make>::all()) {
    EXPECT_FALSE(entry.title.en.empty() || entry.title.zh.empty() || entry.source.empty()) << entry.id;
    for (const auto& param : entry.params.all()) {
      const bool legal = param.required || !entry.params.check(param, param.fallback, "").has_value();
      EXPECT_TRUE(legal) << entry.id << "." << param.name;
      EXPECT_FALSE(param.meaning.en.empty() || param.meaning.zh.empty()) << entry.id << "." << param.name;
    }
  }
}

TEST(Registries, DeclareLegalDefaultsAndWords) {
  expect_defaults_legal<PlantMake>();
  expect_defaults_legal<SensorMake>();
  expect_defaults_legal<AttackMake>();
  expect_defaults_legal<MethodMake>();
}

TEST(Registries, AreWrittenAsJson) {
  const Json all = registry_json();
  for (const char* kind : {"methods", "attacks", "plants", "sensors", "laws"}) {
    ASSERT_FALSE(all[kind].empty()) << kind;
    for (const auto& entry : all[kind]) {
      EXPECT_FALSE(entry["title"]["zh"].get<std::string>().empty()) << entry["id"];
      EXPECT_TRUE(entry["parameters"].is_array()) << entry["id"];
    }
  }
}

std::string page(const std::string& name) {
  std::ifstream file(std::string(VIGIL_SOURCE_DIR) + "/docs/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Documentation, SmallestDocumentRuns) {
  const std::string text = page("scenario.md");
  const std::string begin = "```json\n";
  const std::size_t from = text.find(begin) + begin.size();
  ASSERT_LT(from, text.size());
  EXPECT_TRUE(fuzz::run_case(Json::parse(text.substr(from, text.find("```", from) - from))));
}

TEST(Documentation, ParametersPageFollowsTheCode) {
  const std::string path = std::string(VIGIL_SOURCE_DIR) + "/docs/parameters.md";
  if (std::getenv("VIGIL_UPDATE_DOCS") != nullptr) std::ofstream(path) << parameters_markdown();
  EXPECT_EQ(page("parameters.md"), parameters_markdown())
      << "run the engine tests with VIGIL_UPDATE_DOCS=1 and commit docs/parameters.md";
}

TEST(Documentation, CompatibilityPageFollowsTheCode) {
  const std::string path = std::string(VIGIL_SOURCE_DIR) + "/docs/compatibility.md";
  if (std::getenv("VIGIL_UPDATE_DOCS") != nullptr) std::ofstream(path) << compatibility_markdown();
  EXPECT_EQ(page("compatibility.md"), compatibility_markdown())
      << "run the engine tests with VIGIL_UPDATE_DOCS=1 and commit docs/compatibility.md";
}

}  // namespace
}  // namespace vigil::schema_test
