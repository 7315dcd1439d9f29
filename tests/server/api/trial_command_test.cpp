/// The line that repeats a trial, typed into a shell.
#include "server/api/trial_command.hpp"

#include <cstdio>
#include <fstream>

#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::trial_command_test {
namespace {

class TrialCommand : public ApiTest {
 protected:
  /// Standard output of a line for sh, in the test's folder, with the executable found as `vigil`.
  std::string shell(const std::string& line) const {
    std::filesystem::create_directories(folder_.file("bin"));
    const std::filesystem::path link = folder_.file("bin/vigil");
    if (!std::filesystem::exists(link)) std::filesystem::create_symlink(VIGIL_EXECUTABLE, link);
    const std::string script = folder_.file("line.sh");
    std::ofstream(script) << "cd " << shell_word(folder_.file("")) << "\nPATH=" << shell_word(folder_.file("bin"))
                          << ":$PATH\n"
                          << line << "\n";
    FILE* pipe = popen(("sh " + shell_word(script)).c_str(), "r");
    std::string text;
    char part[4096];
    for (std::size_t n = 0; pipe != nullptr && (n = fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
    EXPECT_EQ(pipe != nullptr ? pclose(pipe) : -1, 0) << line << "\n" << text;
    return text;
  }
  /// The campaign's last trial has, typed, the metrics that the log has of it.
  std::string expect_repeated(const Json& body) const {
    const std::string id = client_->post("/api/v1/campaigns", body).json.value("id", "0");
    const std::string path = "/api/v1/campaigns/" + id;
    EXPECT_TRUE(eventually([&] { return client_->get(path).json.value("state", "") == "finished"; }));
    const std::int64_t trials = client_->get(path).json.at("progress").at("trials");
    const Json trial = client_->get(path + "/trials/" + std::to_string(trials - 1)).json;
    const std::string line = trial.at("command");
    const Json outcome = Json::parse(shell(line + " --json -"), nullptr, false);
    if (!outcome.is_object()) {
      ADD_FAILURE() << line;
      return line;
    }
    EXPECT_EQ(outcome.value("metrics", Json()).dump(), trial.at("metrics").dump()) << line;
    return line;
  }
};

TEST_F(TrialCommand, APresetIsRepeatedByWhatWasSet) {
  const std::string line = expect_repeated({{"scenario", "consensus"},
                                            {"patch", {{"time", {{"steps", 20}}}}},
                                            {"runs", 2},
                                            {"first_seed", 5},
                                            {"sweep", {{"adversary.links.params.pdos", {0.1, 0.30000000000000004}}}}});
  EXPECT_EQ(line,
            "vigil run consensus --seed 6 --set time.steps=20 --set "
            "adversary.links.params.pdos=0.30000000000000004");
}

TEST_F(TrialCommand, ALaneThatWasTakenAwayIsPatchedAway) {
  const std::string line =
      expect_repeated({{"scenario", "consensus"},
                       {"patch", {{"time", {{"steps", 20}}}, {"lanes", {{"naive_hold", nullptr}}}}},
                       {"runs", 1},
                       {"sweep", {{"lanes.consensus.params.tau", {0.02}}}}});
  EXPECT_NE(line.find("--patch /dev/stdin"), std::string::npos) << line;
}

TEST_F(TrialCommand, AnOwnDocumentGoesAlongWhole) {
  Json own = Scenario::preset("consensus").document();
  own["id"] = "mine";
  own["title"]["en"] = "It's mine";
  own["time"]["steps"] = 20;
  const std::string line = expect_repeated({{"scenario", own}, {"runs", 2}});
  EXPECT_NE(line.find("vigil run /dev/stdin --seed 2"), std::string::npos) << line;
}

TEST_F(TrialCommand, ATraceIsFetchedFirst) {
  if (std::system("curl --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "curl is not installed";
  const std::string run =
      client_->start({{"scenario", "consensus"}, {"pace", "max"}, {"patch", {{"time", {{"steps", 20}}}}}});
  ASSERT_TRUE(client_->reaches(run, "finished"));
  const Json columns = client_->get("/api/v1/scenarios/consensus/columns").json.at("columns");
  std::string names;
  for (const Json& name : columns) names += (names.empty() ? "" : ",") + name.get<std::string>();
  const Answer csv =
      client_->get("/api/v1/runs/" + run + "/samples?from=0&to=20&signals=" + names, {{"Accept", "text/csv"}});
  ASSERT_EQ(csv.status, 200) << csv.body;
  const Answer trace = client_->send("POST", "/api/v1/traces", csv.body, "text/csv");
  ASSERT_EQ(trace.status, 201) << trace.body;
  const std::string line = expect_repeated({{"scenario", "consensus"},
                                            {"patch", {{"time", {{"steps", 20}}}}},
                                            {"runs", 2},
                                            {"input", {{"trace", trace.json.at("id")}}}});
  EXPECT_TRUE(line.starts_with("curl -fsS ")) << line;
}

TEST(ShellWord, KeepsEveryCharacter) {
  EXPECT_EQ(shell_word("a.b=0.5"), "a.b=0.5");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
}

}  // namespace
}  // namespace vigil::api_test::trial_command_test
