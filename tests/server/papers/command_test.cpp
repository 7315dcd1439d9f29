// `vigil papers`: as text, as JSON, as a page, refusals.
#include "tests/server/cli/command.hpp"

#include <gtest/gtest.h>

#include "engine/core/json.hpp"

namespace vigil::api_test::command_test {
namespace {

TEST(PapersCommand, PrintsTheVerdicts) {
  const Outcome outcome = vigil_command({"papers", "--only", "000/fig1", "--only", "004/eq4-33"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  for (const char* words : {"000/fig1", "004/eq4-33", "reproduced after correction", "2 items, 200 runs"})
    EXPECT_NE(outcome.output.find(words), std::string::npos) << words << "\n" << outcome.output;
}

TEST(PapersCommand, WritesJsonOfTheChosenItems) {
  const Outcome outcome = vigil_command({"papers", "--only", "004/fig3-3", "--runs", "5", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const Json items = Json::parse(outcome.output);
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(items[0]["key"], "004/fig3-3");
  EXPECT_EQ(items[0]["runs"], 5);
  EXPECT_GT(items[0]["se"].get<double>(), 0);
}

TEST(PapersCommand, RefusesWhatThereIsNot) {
  const Outcome outcome = vigil_command({"papers", "--only", "000/fig9"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.error.find("000/fig9"), std::string::npos) << outcome.error;
  EXPECT_EQ(vigil_command({"papers", "--runs", "1"}).code, 2) << "one run has no standard error";
}

}  // namespace
}  // namespace vigil::api_test::command_test
