// `vigil compatibility`: as text, as JSON, refusals.
#include "engine/run/compatibility.hpp"

#include <gtest/gtest.h>

#include "tests/server/cli/command.hpp"

namespace vigil::api_test::compatibility_test {
namespace {

TEST(CompatibilityCommand, PrintsTheTableAndItsReasons) {
  const Outcome outcome = vigil_command({"compatibility", "replay-mixed"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  for (const char* words : {"attack", "stealthy", "actuators", "plant", ": the network has no links\n"})
    EXPECT_NE(outcome.output.find(words), std::string::npos) << words << "\n" << outcome.output;
}

TEST(CompatibilityCommand, WritesJson) {
  const Outcome outcome = vigil_command({"compatibility", "replay-mixed", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(Json::parse(outcome.output), Json::parse(compatibility(Scenario::preset("replay-mixed")).dump()));
}

TEST(CompatibilityCommand, NeedsTheTraceThatTheScenarioNeeds) {
  const Outcome outcome = vigil_command({"compatibility", "mrclam"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.error.find("trace"), std::string::npos) << outcome.error;
}

}  // namespace
}  // namespace vigil::api_test::compatibility_test
