#include <cmath>

#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::compare_test {
namespace {

class CompareTest : public ApiTest {
 protected:
  std::string finished(std::uint64_t seed, const Json& patch = Json::object()) {
    Json body{{"scenario", "consensus"}, {"seed", seed}, {"patch", patch}};
    const std::string id = client_->start(body);
    EXPECT_TRUE(client_->reaches(id, "finished"));
    return id;
  }
  Answer compare(const std::string& query) { return client_->get("/api/v1/compare?" + query); }
  Json column(const std::string& run, const std::string& signal) {
    return client_->get("/api/v1/runs/" + run + "/samples?points=5000&signals=" + signal).json.at("series")[0].at("v");
  }
};

const Json* find(const Json& rows, const std::string& key, const Json& value, const std::string& run) {
  for (const Json& row : rows) {
    if (row.value(key, Json()) == value && row.value("run", "") == run) return &row;
  }
  return nullptr;
}

TEST_F(CompareTest, TwoSeedsDifferInNothingButTheirNumbers) {
  const std::string a = finished(1), b = finished(2), signal = "lane.consensus.1.error";
  const Json answer = compare("ids=" + a + "," + b + "&signals=lane.consensus.*.error&abs=0.5").json;
  EXPECT_TRUE(answer.at("parameters").empty()) << answer.at("parameters");
  EXPECT_EQ(answer.at("runs")[1].at("id"), b);
  EXPECT_EQ(answer.at("runs")[1].at("seed"), 2);
  EXPECT_EQ(answer.at("range"), (Json{{"from", 0}, {"to", 30}}));
  ASSERT_EQ(answer.at("series").size(), 8u);
  EXPECT_EQ(answer.at("series")[0].at("runs")[1].at("v"), column(b, signal));
  const Json one = column(a, signal), two = column(b, signal);
  int inside = 0, ticks = 0;
  double worst = 0, sum = 0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    if (one[k].is_null() || two[k].is_null()) {
      inside += one[k] == two[k] ? 1 : 0;
      ++ticks;
      continue;
    }
    const double d = two[k].get<double>() - one[k].get<double>();
    inside += std::abs(d) <= 0.5 ? 1 : 0;
    ++ticks;
    worst = std::max(worst, std::abs(d));
    sum += d;
  }
  const Json* verdict = find(answer.at("verdicts"), "signal", signal, b);
  ASSERT_NE(verdict, nullptr);
  EXPECT_EQ(verdict->at("against"), a);
  EXPECT_EQ(verdict->at("ticks"), ticks);
  EXPECT_DOUBLE_EQ(verdict->at("inside").get<double>(), static_cast<double>(inside) / ticks);
  EXPECT_DOUBLE_EQ(verdict->at("worst").get<double>(), worst);
  const Json* paired = find(answer.at("paired"), "signal", signal, b);
  ASSERT_NE(paired, nullptr);
  EXPECT_NEAR(paired->at("mean").get<double>(), sum / paired->at("n").get<double>(), 1e-12);
  EXPECT_EQ(paired->at("batches"), 15);
  EXPECT_LT(paired->at("ci")[0].get<double>(), paired->at("mean").get<double>());
}

TEST_F(CompareTest, MetricsAndTheirPairsBySeed) {
  const Json patch{{"lanes", {{"consensus", {{"params", {{"tau", 0.02}}}}}}}};
  const std::string ids = finished(1) + "," + finished(2) + "," + finished(1, patch) + "," + finished(2, patch);
  const Json answer = compare("ids=" + ids + "&points=0").json;
  ASSERT_EQ(answer.at("parameters").size(), 1u) << answer.at("parameters");
  EXPECT_EQ(answer.at("parameters")[0].at("path"), "lanes.consensus.params.tau");
  EXPECT_EQ(answer.at("parameters")[0].at("values")[2], 0.02);
  EXPECT_EQ(answer.at("parameters")[0].at("values")[0], answer.at("parameters")[0].at("values")[1]);
  EXPECT_TRUE(answer.at("series").empty());
  int seen = 0;
  for (const Json& row : answer.at("metrics")) {
    if (row.at("lane") != "consensus" || row.at("name") != "rmse_position" || !row.at("node").is_null()) continue;
    ++seen;
    const Json& values = row.at("values");
    EXPECT_TRUE(row.at("difference")[0].is_null());
    EXPECT_DOUBLE_EQ(row.at("difference")[3].get<double>(), values[3].get<double>() - values[0].get<double>());
    for (const Json& paired : answer.at("paired")) {
      if (!paired.contains("metric") || paired["metric"].at("name") != "rmse_position" ||
          paired["metric"].at("lane") != "consensus" || !paired["metric"].at("node").is_null())
        continue;
      ++seen;
      const double one = values[2].get<double>() - values[0].get<double>();
      const double two = values[3].get<double>() - values[1].get<double>();
      EXPECT_EQ(paired.at("n"), 2);
      EXPECT_NEAR(paired.at("mean").get<double>(), (one + two) / 2, 1e-12);
      EXPECT_NEAR(paired.at("se").get<double>(), std::abs(one - two) / 2, 1e-12);
    }
  }
  EXPECT_EQ(seen, 2);
}

// The fork is its parent up to the tick of the fork: the first tick outside of a tolerance of nothing is the one after.
TEST_F(CompareTest, AForkLeavesItsOriginWhereItWasMade) {
  const std::string origin = finished(3);
  const Answer made = client_->post("/api/v1/runs/" + origin + "/fork",
                                    {{"k", 12}, {"pace", "max"}, {"patch", {{"adversary", {{"links", nullptr}}}}}});
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string fork = made.json.at("id");
  ASSERT_TRUE(client_->reaches(fork, "finished"));
  const Json answer = compare("ids=" + origin + "," + fork + "&signals=link.*.state,lane.consensus.*.estimate.x").json;
  std::int64_t first = 1000;
  for (const Json& verdict : answer.at("verdicts")) {
    if (!verdict.at("first").is_null()) first = std::min(first, verdict.at("first").get<std::int64_t>());
  }
  EXPECT_EQ(first, 13);
  ASSERT_EQ(answer.at("parameters").size(), 1u) << answer.at("parameters");
  EXPECT_EQ(answer.at("parameters")[0].at("path").get<std::string>().substr(0, 12), "commands.13.");
  EXPECT_EQ(answer.at("runs")[1].at("parent").at("run"), origin);
}

TEST_F(CompareTest, RunsAreAlignedByTheirFirstAttack) {
  const auto late = [](int from) {
    return Json{{"time", {{"steps", 60}}},
                {"adversary", {{"links", {{"from", from}, {"params", {{"pdos", 1}, {"pfdi", 0}}}}}}}};
  };
  const std::string a = finished(5, late(10)), b = finished(5, late(25));
  const Json answer = compare("ids=" + a + "," + b + "&signals=link.*.state&align=attack&from=-5&to=5").json;
  EXPECT_EQ(answer.at("runs")[0].at("offset"), 10);
  EXPECT_EQ(answer.at("runs")[1].at("offset"), 25);
  EXPECT_EQ(answer.at("range"), (Json{{"from", -5}, {"to", 5}}));
  for (const Json& verdict : answer.at("verdicts")) {
    EXPECT_TRUE(verdict.at("holds").get<bool>()) << verdict;
    EXPECT_EQ(verdict.at("ticks"), 11);
  }
  const Json& drawn = answer.at("series")[0].at("runs")[1];
  EXPECT_EQ(drawn.at("k").front(), -5);
  EXPECT_EQ(drawn.at("v")[4], 0);
  EXPECT_EQ(drawn.at("v")[5], 1);
  const Json by_tick = compare("ids=" + a + "," + b + "&signals=link.*.state").json;
  EXPECT_EQ(by_tick.at("verdicts")[0].at("first"), 10);
  EXPECT_EQ(by_tick.at("verdicts")[0].at("outside"), (Json{{10, 24}}));
  const std::string calm = finished(5, {{"adversary", {{"links", {{"enabled", false}}}}}});
  expect_problem(compare("ids=" + a + "," + calm + "&align=attack"), 400, "/align");
}

// The frames of a run, used as its trace, give the same lanes bit for bit: nothing differs but what the runs ran on.
TEST_F(CompareTest, ATraceOfARunIsWithinAToleranceOfNothing) {
  const std::string a = finished(1);
  const Answer frames = client_->get("/api/v1/runs/" + a + "/samples", {{"Accept", "text/csv"}});
  const Answer trace = client_->send("POST", "/api/v1/traces", frames.body, "text/csv");
  ASSERT_EQ(trace.status, 201) << trace.body;
  const std::string b =
      client_->start({{"scenario", "consensus"}, {"seed", 1}, {"input", {{"trace", trace.json.at("id")}}}});
  ASSERT_TRUE(client_->reaches(b, "finished"));
  const Json answer = compare("ids=" + a + "," + b + "&signals=lane.*.error").json;
  ASSERT_EQ(answer.at("verdicts").size(), 49u) << "six lanes at eight cameras, one at the centre";
  for (const Json& verdict : answer.at("verdicts")) EXPECT_TRUE(verdict.at("holds").get<bool>()) << verdict;
  ASSERT_EQ(answer.at("parameters").size(), 1u) << answer.at("parameters");
  EXPECT_EQ(answer.at("parameters")[0].at("path"), "input");
  EXPECT_EQ(answer.at("parameters")[0].at("values")[0], "simulate");
}

TEST_F(CompareTest, RefusesWithOneSentence) {
  const std::string a = finished(1), b = finished(2), both = "ids=" + a + "," + b;
  expect_problem(compare(""), 400, "/ids");
  expect_problem(compare("ids=" + a), 400, "/ids");
  expect_problem(compare("ids=" + a + "," + a), 400, "/ids");
  expect_problem(compare("ids=" + a + ",x"), 400, "/ids");
  expect_problem(compare("ids=" + a + ",99999"), 404, "/ids");
  expect_problem(compare("ids=1,2,3,4,5,6,7,8,9,10,11"), a == "1" ? 404 : 400);
  expect_problem(compare(both + "&signals=no.such"), 400, "/signals");
  expect_problem(compare(both + "&signals=*"), 400, "/signals");
  expect_problem(compare(both + "&align=time"), 400, "/align");
  for (const char* bad : {"-1", "x", "nan", "inf", "1e", "1e999"}) {
    expect_problem(compare(both + "&abs=" + bad), 400, "/abs");
    expect_problem(compare(both + "&rel=" + bad), 400, "/rel");
  }
  expect_problem(compare(both + "&shift=-1"), 400, "/query/shift");
  expect_problem(compare(both + "&points=100000"), 400, "/query/points");
  EXPECT_EQ(compare(both).status, 200);
  EXPECT_EQ(compare(both).json.at("series").size(), 16u) << "what is taken where nothing is named";
  const Json empty = compare(both + "&from=5000").json;
  EXPECT_TRUE(empty.at("range").is_null());
  for (const Json& verdict : empty.at("verdicts")) EXPECT_FALSE(verdict.at("holds").get<bool>());
}

}  // namespace
}  // namespace vigil::api_test::compare_test
