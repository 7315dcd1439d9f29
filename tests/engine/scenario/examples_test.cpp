// The documents that docs/scenario.md shows are documents, and they run.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "engine/run/design.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::examples_test {
namespace {

TEST(Documentation, ScenarioExamplesRun) {
  std::ifstream file(std::string(VIGIL_SOURCE_DIR) + "/docs/scenario.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::string page = text.str();
  const std::string open = "```json\n", close = "```";
  int examples = 0;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    const std::string example = page.substr(at, page.find(close, at) - at);
    SCOPED_TRACE(example);
    Json document = Json::parse(example);
    if (!document.contains("time")) document["time"] = {{"steps", 20}};
    const Scenario scenario = Scenario::from_json(document);
    if (!design_tasks(scenario).empty()) continue;  // gains need a solver: tests/server/synthesis runs those
    vigil::Run run(scenario, {1, nullptr, {}});
    test::Capture capture;
    test::run_to_end(run, capture);
    EXPECT_EQ(run.tick(), document["time"]["steps"].get<std::int64_t>());
    EXPECT_TRUE(run.faults().empty());
    ++examples;
  }
  EXPECT_GE(examples, 2);
}

}  // namespace
}  // namespace vigil::examples_test
