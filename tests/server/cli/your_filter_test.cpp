// The snippets of docs/your_filter.md, as they stand there.
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::your_filter_test {
namespace {

/// The page's code block of that language.
std::string snippet(const std::string& language) {
  std::ostringstream page;
  page << std::ifstream(VIGIL_SOURCE_DIR "/docs/your_filter.md").rdbuf();
  const std::string text = page.str(), fence = "```" + language + "\n";
  const std::size_t begin = text.find(fence) + fence.size(), end = text.find("```", begin);
  return text.substr(begin, end - begin);
}

bool installed(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

TEST(YourFilter, ThePythonSnippetsLaneIsOurs) {
  if (!installed("python3")) GTEST_SKIP() << "python3 is not installed";
  const TemporaryFolder folder;
  std::ofstream(folder.file("your_filter.py")) << snippet("python");
  ServerProcess server({"--db", folder.file("log.db"), "--no-demo"});
  const std::string command = "timeout 60 python3 '" + folder.file("your_filter.py") +
                              "' http://127.0.0.1:" + std::to_string(server.port()) + " > '" + folder.file("said") +
                              "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream said(folder.file("said"));
  std::string run, lane;
  double value = 0;
  std::map<std::string, double> rmse;
  while (said >> run >> lane >> value) rmse[lane] = value;
  ASSERT_EQ(rmse.size(), 2u) << "ours and mine";
  EXPECT_GT(rmse["ours"], 0);
  EXPECT_NEAR(rmse["mine"], rmse["ours"], 1e-9 * rmse["ours"]) << "the same filter on the same readings";
}

TEST(YourFilter, TheMatlabSnippetParses) {
  if (!installed("octave")) GTEST_SKIP() << "octave is not installed";
  const TemporaryFolder folder;
  std::ofstream(folder.file("your_filter.m")) << snippet("matlab");
  EXPECT_EQ(std::system(("octave --no-gui --eval \"__parse_file__('" + folder.file("your_filter.m") + "')\"").c_str()),
            0);
}

}  // namespace
}  // namespace vigil::api_test::your_filter_test
