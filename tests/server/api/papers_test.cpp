/// The papers over HTTP: items are run, kept, refused, cancelled.
#include "server/papers/kept.hpp"
#include "server/papers/report.hpp"
#include "server/papers/threads.hpp"
#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::papers_test {
namespace {

constexpr const char* kPath = "/api/v1/papers";

const papers::Item& item(const std::string& key) {
  for (const papers::Item& one : papers::items()) {
    if (one.key == key) return one;
  }
  throw std::out_of_range(key);
}

class PapersApi : public ApiTest {
 protected:
  Json all() const { return client_->get(kPath).json; }
  bool ends() const {
    return eventually([&] { return all().at("job").at("state") != "running"; });
  }
  Json of(const std::string& key) const {
    const Json list = all();
    for (const Json& one : list.at("items")) {
      if (one.at("key") == key) return one;
    }
    return {};
  }
  void run(const Json& body) const {
    const Answer answer = client_->post(kPath, body);
    ASSERT_EQ(answer.status, 202) << answer.body;
    EXPECT_EQ(answer.json.at("job").at("state"), "running");
    ASSERT_TRUE(ends());
  }
  /// More than is done before anybody cancels it.
  static Json long_one() { return {{"only", {"003/fig5"}}, {"runs", 10'000}}; }
};

TEST_F(PapersApi, EveryItemIsThereBeforeAnyIsRun) {
  const Json list = all();
  ASSERT_EQ(list.at("items").size(), papers::items().size());
  EXPECT_TRUE(list.at("job").is_null());
  for (const Json& one : list.at("items")) {
    EXPECT_TRUE(one.at("verdict").is_null());
    EXPECT_FALSE(one.at("rule").get<std::string>().empty());
    const Json whole = client_->get(std::string(kPath) + "/" + one.at("key").get<std::string>()).json;
    EXPECT_TRUE(whole.at("figure").is_null()) << one.at("key");
  }
  expect_problem(client_->get(std::string(kPath) + "/report.html"), 404);
  expect_problem(client_->get(std::string(kPath) + "/000/fig99"), 404);
}

TEST_F(PapersApi, AnItemSaysWhatTheEngineSays) {
  run({{"only", {"004/eq4-33", "000/fig1", "000/fig1"}}, {"runs", 3}, {"seed", 7}});
  const Json job = all().at("job"), keys{"000/fig1", "004/eq4-33"};
  EXPECT_EQ(job.at("items"), keys) << "each once, in the order of the sources";
  EXPECT_EQ(job.at("state"), "finished");
  EXPECT_EQ(job.at("done"), 2);
  EXPECT_TRUE(job.at("failed").empty()) << job;
  LaboratoryOptions options;
  options.runs = 3;
  options.first_seed = 7;
  ThreadedLaboratory laboratory(options);
  for (const char* key : {"000/fig1", "004/eq4-33"}) {
    const Json expected = papers::to_json(item(key), item(key).measure(laboratory));
    const Json whole = client_->get(std::string(kPath) + "/" + key).json, listed = of(key);
    for (const char* member : {"title", "paper", "ours", "se", "verdict", "reason", "runs", "scenario", "spec"}) {
      EXPECT_EQ(whole.at(member), expected.at(member)) << key << " " << member;
      EXPECT_EQ(listed.at(member), expected.at(member)) << key << " " << member;
    }
    EXPECT_EQ(whole.at("figure").dump(), expected.at("figure").dump()) << key;
    EXPECT_FALSE(listed.contains("figure"));
    EXPECT_EQ(listed.at("seed"), 7);
    EXPECT_EQ(listed.at("version"), std::string(version()));
    EXPECT_TRUE(listed.at("ended").is_string());
  }
}

TEST_F(PapersApi, ARestartKeepsResultsAndANewerOneReplacesThem) {
  run({{"only", {"004/fig2-3"}}, {"runs", 3}, {"seed", 1}});
  const Json first = of("004/fig2-3");
  const Json figure = client_->get(std::string(kPath) + "/004/fig2-3").json.at("figure");
  ASSERT_FALSE(first.at("verdict").is_null());
  server_.reset();
  begin();
  EXPECT_EQ(of("004/fig2-3").dump(), first.dump());
  EXPECT_EQ(client_->get(std::string(kPath) + "/004/fig2-3").json.at("figure").dump(), figure.dump());
  EXPECT_EQ(all().at("job").at("state"), "finished") << "what is over is not run again";
  run({{"only", {"004/fig2-3"}}, {"runs", 3}, {"seed", 2}});
  EXPECT_EQ(of("004/fig2-3").at("seed"), 2);
  EXPECT_NE(of("004/fig2-3").at("ours"), first.at("ours"));
}

TEST_F(PapersApi, RefusesWhatIsNoOrder) {
  expect_problem(client_->post(kPath, {{"only", {"000/fig1", "000/fig99"}}}), 422, "/only/1");
  expect_problem(client_->post(kPath, {{"only", {7}}}), 422, "/only/0");
  expect_problem(client_->post(kPath, {{"only", Json::array()}}), 422, "/only");
  expect_problem(client_->post(kPath, {{"only", "000/fig1"}}), 422, "/only");
  expect_problem(client_->post(kPath, {{"runs", 1}}), 422, "/runs");
  expect_problem(client_->post(kPath, {{"runs", 10'001}}), 422, "/runs");
  expect_problem(client_->post(kPath, {{"seed", -1}}), 422, "/seed");
  expect_problem(client_->post(kPath, {{"seed", 1.5}}), 422, "/seed");
  expect_problem(client_->post(kPath, {{"figures", 1}}), 422, "/figures");
  expect_problem(client_->send("POST", kPath, "[]"), 400);
  EXPECT_TRUE(all().at("job").is_null());
}

TEST_F(PapersApi, OneJobAtATimeThatCanBeCancelled) {
  ASSERT_EQ(client_->post(kPath, long_one()).status, 202);
  expect_problem(client_->post(kPath, {{"only", {"000/fig1"}}}), 409);
  ASSERT_TRUE(eventually([&] { return all().at("job").at("runs_made") > 0; }));
  EXPECT_EQ(client_->remove(std::string(kPath) + "/job").status, 204);
  EXPECT_EQ(all().at("job").at("state"), "cancelled");
  EXPECT_EQ(all().at("job").at("done"), 0);
  EXPECT_TRUE(of("003/fig5").at("verdict").is_null());
  EXPECT_EQ(client_->remove(std::string(kPath) + "/job").status, 204) << "none goes on";
  run({{"only", {"000/fig1"}}, {"runs", 2}});
  EXPECT_FALSE(of("000/fig1").at("verdict").is_null());
}

TEST_F(PapersApi, AServerThatEndsDoesNotWaitForTheJob) {
  ASSERT_EQ(client_->post(kPath, long_one()).status, 202);
  ASSERT_TRUE(eventually([&] { return all().at("job").at("runs_made") > 0; }));
  server_.reset();
  begin();
  EXPECT_TRUE(of("003/fig5").at("verdict").is_null()) << "half an item is none";
}

TEST_F(PapersApi, AJobGoesOnAfterARestart) {
  ASSERT_EQ(client_->post(kPath, {{"only", {"000/fig1", "003/fig5"}}, {"runs", 100}, {"seed", 5}}).status, 202);
  ASSERT_TRUE(eventually([&] { return all().at("job").at("done") == 1 && all().at("job").at("runs_made") > 0; }));
  const Json first = of("000/fig1");
  server_.reset();
  begin();
  EXPECT_EQ(all().at("job").at("state"), "running");
  EXPECT_EQ(all().at("job").at("taken_up").at("done"), 1);
  ASSERT_TRUE(ends() || ends());
  const Json job = all().at("job");
  EXPECT_EQ(job.at("state"), "finished");
  EXPECT_EQ(job.at("done"), 2);
  EXPECT_TRUE(job.at("failed").empty()) << job;
  EXPECT_EQ(of("000/fig1").dump(), first.dump()) << "what was done stays";
  EXPECT_EQ(of("003/fig5").at("seed"), 5);
  EXPECT_EQ(of("003/fig5").at("runs"), 100);
}

TEST_F(PapersApi, ACancelledJobDoesNotGoOnAfterARestart) {
  ASSERT_EQ(client_->post(kPath, long_one()).status, 202);
  ASSERT_TRUE(eventually([&] { return all().at("job").at("runs_made") > 0; }));
  EXPECT_EQ(client_->remove(std::string(kPath) + "/job").status, 204);
  server_.reset();
  begin();
  EXPECT_EQ(all().at("job").at("state"), "cancelled");
}

TEST_F(PapersApi, AnItemLeadsToItsRunsEquationsAndMethods) {
  const Json whole = client_->get(std::string(kPath) + "/000/fig2").json;
  EXPECT_EQ(whole.at("zh").at("reason"), papers::words_json(item("000/fig2"), nullptr).at("reason"));
  ASSERT_EQ(whole.at("scenes").size(), 1U);
  const Json& scene = whole.at("scenes")[0];
  const Answer started = client_->post(
      "/api/v1/runs", {{"scenario", scene.at("scenario")}, {"patch", scene.at("patch")}, {"pace", "max"}, {"seed", 1}});
  ASSERT_EQ(started.status, 201) << started.body;
  EXPECT_NE(whole.at("equations")[0].at("mathml").get<std::string>().find("<math"), std::string::npos);
  for (const Json& method : whole.at("methods")) {
    const Json page = client_->get("/api/v1/documentation/" + method.at("id").get<std::string>()).json;
    EXPECT_EQ(page.at("title"), method.at("title"));
    for (const char* part : {"equations", "steps", "parameters"}) EXPECT_FALSE(page.at(part).empty()) << part;
  }
  EXPECT_GT(client_->get("/api/v1/documentation").json.at("items").size(), 25U);
  expect_problem(client_->get("/api/v1/documentation/nosuch"), 404);
}

TEST_F(PapersApi, TheReportIsThatOfTheCommand) {
  run({{"only", {"000/fig1", "004/fig2-3"}}, {"runs", 4}});
  const Answer report = client_->get(std::string(kPath) + "/report.html");
  EXPECT_EQ(report.header("Content-Type"), "text/html; charset=utf-8");
  EXPECT_NE(report.header("Content-Disposition").find("vigil-papers.html"), std::string::npos);
  LaboratoryOptions options;
  options.runs = 4;
  ThreadedLaboratory laboratory(options);
  for (const char* key : {"000/fig1", "004/fig2-3"}) {
    EXPECT_NE(report.body.find("id=\"" + std::string(key) + "\""), std::string::npos);
    const papers::Findings found = item(key).measure(laboratory);
    const papers::Findings back = papers::findings_of(Json::parse(papers::to_json(item(key), found).dump()));
    EXPECT_EQ(papers::report_html({{&item(key), back}}, 4, 1), papers::report_html({{&item(key), found}}, 4, 1));
  }
}

}  // namespace
}  // namespace vigil::api_test::papers_test
