/// What drawings of a campaign are made of: outlines, figures of chosen metrics, values of all trials.
#include "server/campaigns/results.hpp"
#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::campaign_results_test {
namespace {

class CampaignResultRoutes : public ApiTest {
 protected:
  std::string made(const Json& body, const std::string& state = "finished") {
    const std::string id = client_->post("/api/v1/campaigns", body).json.value("id", "0");
    path_ = "/api/v1/campaigns/" + id;
    EXPECT_TRUE(eventually([&] { return client_->get(path_).json.value("state", "") == state; }));
    return id;
  }
  Json get(const std::string& rest) const {
    const Answer answer = client_->get(path_ + rest);
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.json;
  }
  static Json small() {
    return {{"scenario", "consensus"},
            {"patch", {{"time", {{"steps", 5}}}}},
            {"runs", 4},
            {"sweep", {{"adversary.links.params.pdos", {0.1, 0.4, 0.7}}}}};
  }
  /// Every row of /results is the row of the whole answer with the same names.
  void expect_same_figures(const Json& results, const Json& whole) const {
    std::size_t found = 0;
    for (const Json& row : results.at("rows")) {
      const Json lane = results.at("lanes").at(row.at(1).get<std::size_t>());
      const Json metric = results.at("metrics").at(row.at(2).get<std::size_t>());
      for (const Json& one : whole.at("metrics")) {
        if (one.at("cell") != row.at(0) || one.at("lane") != lane || one.at("name") != metric ||
            !one.at("node").is_null())
          continue;
        ++found;
        for (std::size_t i = 0; i < results.at("figures").size(); ++i) {
          const std::string figure = results.at("figures").at(i);
          const Json& value = one.contains(figure) ? one.at(figure) : one.at("quantiles").at(figure);
          EXPECT_EQ(row.at(3 + i), value) << figure;
        }
      }
    }
    EXPECT_EQ(found, results.at("rows").size());
  }
  std::string path_;
};

TEST_F(CampaignResultRoutes, AnOutlineNamesWhatTheResultsHave) {
  made(small());
  const Json whole = get(""), outline = get("?results=false");
  EXPECT_FALSE(outline.contains("metrics"));
  EXPECT_FALSE(outline.contains("faults"));
  EXPECT_EQ(outline.at("trials"), whole.at("trials"));
  EXPECT_EQ(outline.at("cells"), whole.at("cells"));
  EXPECT_EQ(outline.at("document"), whole.at("document"));
  EXPECT_EQ(outline.at("warnings"), whole.at("warnings"));
  const Json& names = outline.at("names");
  EXPECT_EQ(names.at("lanes").at(0), whole.at("metrics").at(0).at("lane"));
  bool node = false;
  for (const Json& metric : names.at("metrics")) {
    EXPECT_FALSE(metric.at("lanes").empty());
    node = node || metric.at("node") == "1";
  }
  EXPECT_TRUE(node);
  expect_problem(client_->get(path_ + "?results=maybe"), 400);
}

TEST_F(CampaignResultRoutes, FiguresAreThoseOfTheWholeAnswer) {
  made(small());
  const Json whole = get("");
  const Json one = get("/results?metric=rmse_position");
  EXPECT_EQ(one.at("metrics"), Json{"rmse_position"});
  EXPECT_EQ(one.at("rows").size(), 3 * one.at("lanes").size());
  expect_same_figures(one, whole);
  const Json all = get("/results");
  EXPECT_GT(all.at("metrics").size(), 3u);
  EXPECT_GT(all.at("rows").size(), one.at("rows").size());
  EXPECT_EQ(get("/results?metric=rmse_position&lane=consensus&from=2").at("rows").size(), 1u);
  EXPECT_EQ(get("/results?metric=1.rmse_position,rmse_heading&lane=consensus").at("rows").size(), 6u);
  EXPECT_TRUE(get("/results?metric=nosuch").at("rows").empty());
}

// The cell that is under way is merged as its trials come; what is told of it is what it will be told of anew.
TEST_F(CampaignResultRoutes, ACellUnderWayIsToldAsFarAsItIs) {
  Json body = small();
  body["runs"] = 50'000;
  const std::string id = client_->post("/api/v1/campaigns", body).json.value("id", "0");
  path_ = "/api/v1/campaigns/" + id;
  Json first;
  ASSERT_TRUE(eventually([&] { return !(first = get("/results?metric=rmse_position")).at("rows").empty(); }));
  const std::int64_t before = first.at("rows").at(0).back();
  ASSERT_TRUE(eventually([&] { return get("/results?metric=rmse_position").at("rows").at(0).back() > before; }));
  client_->patch(path_, {{"state", "paused"}});
  const Json whole = get("");
  expect_same_figures(get("/results"), whole);
  EXPECT_EQ(get("?results=false").at("trials"), whole.at("trials"));
  const LogReader reader(options_.db);
  CampaignResults fresh(reader);
  EXPECT_EQ(get("/cells/0").at("result").dump(), fresh.result(*reader.campaign(std::stoll(id)), 0).dump())
      << "merged bit by bit or at once, it is the same";
}

TEST_F(CampaignResultRoutes, ValuesAreThoseOfTheTrials) {
  made(small());
  const Json values = get("/values?metric=consensus.rmse_position,consensus.1.rmse_position");
  EXPECT_EQ(values.at("n"), 12);
  EXPECT_TRUE(values.at("next").is_null());
  ASSERT_EQ(values.at("values").size(), 2u);
  for (int cell = 0; cell < 3; ++cell) {
    const Json trials = get("/trials?metric=consensus.rmse_position&cell=" + std::to_string(cell)).at("items");
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(values.at("values").at(0).at(4 * static_cast<std::size_t>(cell) + i), trials.at(i).at("value"));
  }
  const Json part = get("/values?metric=consensus.rmse_position&from=3&limit=2");
  EXPECT_EQ(part.at("values").at(0).dump(),
            Json({values.at("values").at(0).at(3), values.at("values").at(0).at(4)}).dump());
  EXPECT_EQ(part.at("next"), 5);
  EXPECT_EQ(get("/values?metric=consensus.rmse_position&cell=2").at("from"), 8);
  EXPECT_GT(get("/values").at("metrics").size(), 5u);
  expect_problem(client_->get(path_ + "/values?metric=nosuch"), 400, "/metric");
  expect_problem(client_->get(path_ + "/values?cell=3"), 404);
}

// A lane that only one point has: its values are there, and null everywhere else.
TEST_F(CampaignResultRoutes, WhatATrialLacksIsNull) {
  made({{"scenario", "privacy-turn"},
        {"patch", {{"time", {{"steps", 5}}}}},
        {"runs", 2},
        {"sweep", {{"network.graph", {"centre", "none"}}}}});
  const Json values = get("/values");
  ASSERT_FALSE(values.at("values").empty());
  EXPECT_TRUE(values.at("values").at(0).at(0).is_number());
  EXPECT_TRUE(values.at("values").at(0).at(2).is_null()) << "its trials failed";
}

}  // namespace
}  // namespace vigil::api_test::campaign_results_test
