// Gains from the command line: synthesize, and runs and campaigns that find theirs first.
#include <fstream>

#include "engine/linalg/sdp.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/world/interconnected/examples.hpp"
#include "engine/world/interconnected/plant.hpp"
#include "tests/server/cli/command.hpp"
#include "tests/server/synthesis/scripts.hpp"

namespace vigil::api_test::synthesize_test {
namespace {

/// A ring of so many subsystems with one lane, as a file.
std::string ring_file(const TemporaryFolder& folder, int subsystems) {
  Json document = Scenario::preset("observer-pair").document();
  document["id"] = "ring";
  document["plant"] = {{"type", "interconnected"}, {"params", observer::write_network(observer::ring(subsystems))}};
  document["nodes"] = Json::object();
  for (int i = 1; i <= subsystems; ++i) {
    document["nodes"][std::to_string(i)] = {{"sensor", {{"type", "subsystem"}, {"params", {{"number", i}}}}}};
  }
  document["adversary"] = Json::object();
  document["initial"] = Json::object();
  document["time"]["steps"] = 20;
  document["lanes"] = {{"ref", {{"method", "intermediate_observer"}, {"params", {{"preset", "ref"}}}}}};
  const std::string file = folder.file("ring.json");
  std::ofstream(file) << document;
  return file;
}

TEST(Synthesize, PrintsATableJsonAndProblems) {
  const TemporaryFolder folder;
  const Outcome table = vigil_command({"synthesize", "observer-single", "--sdpa", folder.file("problems")});
  ASSERT_EQ(table.code, 0) << table.error;
  EXPECT_EQ(table.error, "");
  for (const char* word : {"lane", "certificate", "intermediate_fast", "classical_ref", "DSDP", "holds", "norm_l"}) {
    EXPECT_NE(table.output.find(word), std::string::npos) << word << "\n" << table.output;
  }
  const Outcome json = vigil_command({"synthesize", "observer-single", "--json"});
  ASSERT_EQ(json.code, 0) << json.error;
  const Json result = Json::parse(json.output);
  EXPECT_EQ(result.at("scenario"), "observer-single");
  ASSERT_EQ(result.at("items").size(), 4u);
  for (const Json& item : result.at("items")) {
    EXPECT_EQ(item.at("state"), "done");
    EXPECT_EQ(item.at("record").at("holds"), true);
    std::ifstream file(folder.file("problems/" + item.at("lane").get<std::string>() + ".dat-s"));
    const std::string text(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(content_hash(read_sdpa(text)), item.at("key"));
  }
  const Outcome none = vigil_command({"synthesize", "consensus"});
  EXPECT_EQ(none.code, 0);
  EXPECT_EQ(none.output, "No lane of consensus needs gains.\n");
}

TEST(Synthesize, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const Outcome bad =
      vigil_command({"synthesize", "observer-single", "--set", "lanes.intermediate_ref.params.pmin=1e9"});
  EXPECT_EQ(bad.code, 2) << bad.output;
  EXPECT_NE(bad.error.find("pmax"), std::string::npos) << bad.error;
  const Outcome late = vigil_command({"synthesize", ring_file(folder, 18), "--design-limit", "0.4"});
  EXPECT_EQ(late.code, 3) << late.error;
  EXPECT_NE(late.output.find("none"), std::string::npos) << late.output;
  EXPECT_NE(late.output.find("timed_out"), std::string::npos) << late.output;
  const Outcome run = vigil_command({"run", ring_file(folder, 18), "--design-limit", "0.4"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.error.find("no certified gains"), std::string::npos) << run.error;
  EXPECT_EQ(vigil_command({"synthesize", "nothing"}).code, 2);
  EXPECT_EQ(vigil_command({"solve-sdp"}).output, "");
  EXPECT_EQ(vigil_command({"--help"}).output.find("solve-sdp"), std::string::npos);
}

TEST(Synthesize, ARunFindsItsGainsAndPrintsTheSameBytesAgain) {
  const std::vector<std::string> words{"run", "observer-pair", "--steps", "100", "--json", "-"};
  Json results[2];
  for (Json& result : results) {
    const Outcome outcome = vigil_command(words);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_EQ(outcome.error, "");
    result = Json::parse(outcome.output);
    const Json timing = result.at("timing").at("design");
    EXPECT_GT(timing.at("seconds"), 0);
    EXPECT_EQ(timing.at("lanes").size(), 3u);
    result.erase("timing");
    for (const auto& [lane, record] : result.at("design").items()) EXPECT_FALSE(record.contains("seconds")) << lane;
  }
  EXPECT_EQ(results[0].dump(), results[1].dump());
  EXPECT_EQ(results[0].at("design").at("intermediate_fast").at("holds"), true);
}

TEST(Synthesize, ASweepSolvesEachProblemOnce) {
  const Outcome outcome =
      vigil_command({"campaign", "observer-single", "--runs", "2", "--steps", "50", "--sweep",
                     "lanes.intermediate_ref.params.cnu=1e-5,1e-4", "--set", "lanes.classical_fast.enabled=false",
                     "--set", "lanes.classical_ref.enabled=false", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const Json result = Json::parse(outcome.output);
  ASSERT_EQ(result.at("design").size(), 2u);
  const Json one = result.at("design").at(0).at("design"), other = result.at("design").at(1).at("design");
  EXPECT_EQ(one.at("intermediate_fast"), other.at("intermediate_fast"));
  EXPECT_NE(one.at("intermediate_ref").at("objective"), other.at("intermediate_ref").at("objective"));
  EXPECT_EQ(result.at("timing").at("design").at("lanes").size(), 2u);
}

TEST(Synthesize, ABundleBringsItsGains) {
  const TemporaryFolder folder;
  ServerProcess server({"--db", folder.file("log.db"), "--no-demo"});
  const Client client(server.port());
  const std::string id = client.start({{"scenario", "observer-pair"}, {"patch", {{"time", {{"steps", 100}}}}}});
  ASSERT_TRUE(client.reaches(id, "finished")) << client.get("/api/v1/runs/" + id).body;
  const Answer bundle = client.get("/api/v1/runs/" + id + "/bundle");
  std::ofstream(folder.file("bundle.json")) << bundle.body;
  const Outcome outcome =
      vigil_command({"run", folder.file("bundle.json"), "--frames", folder.file("frames.csv"), "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_FALSE(Json::parse(outcome.output).at("timing").contains("design"));
  std::ifstream frames(folder.file("frames.csv"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(frames), {}), bundle.json.at("frames"));
}

/// Of this process's children and theirs, one whose parent is `parent`; 0: none.
pid_t child_process_of(pid_t parent) {
  pid_t found = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "stat");
    std::string text;
    if (!std::getline(file, text)) continue;
    const auto end = text.rfind(") ");
    if (end == std::string::npos) continue;
    if (std::stol(text.substr(end + 4)) == parent) found = static_cast<pid_t>(std::stol(text));
  }
  return found;
}

TEST(Synthesize, AServerEndsInTheMiddleOfASolve) {
  for (const int signal : {SIGTERM, SIGKILL}) {
    const TemporaryFolder folder;
    std::ifstream file(ring_file(folder, 18));
    const Json document = Json::parse(file);
    std::string id;
    pid_t child = 0;
    {
      ServerProcess server({"--db", folder.file("log.db"), "--no-demo"});
      const Client client(server.port());
      id = client.start({{"scenario", document}});
      EXPECT_EQ(client.state(id), "designing");
      ASSERT_TRUE(eventually([&] { return (child = child_process_of(server.pid())) != 0; }));
      EXPECT_EQ(client.get("/healthz").status, 200);
      EXPECT_EQ(server.end(signal), signal == SIGTERM ? 0 : 128 + SIGKILL);
    }
    EXPECT_TRUE(eventually([&] { return gone(child); }));
    ServerProcess next({"--db", folder.file("log.db"), "--no-demo"});
    EXPECT_EQ(Client(next.port()).state(id), "interrupted");
  }
}

}  // namespace
}  // namespace vigil::api_test::synthesize_test
