// The table of attacks and lanes, over HTTP.
#include "engine/run/compatibility.hpp"

#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::compatibility_test {
namespace {

class CompatibilityApi : public ApiTest {};

TEST_F(CompatibilityApi, IsTheEnginesTable) {
  const Json expected = Json::parse(compatibility(Scenario::preset("replay-mixed")).dump());
  const Answer stored = client_->get("/api/v1/scenarios/replay-mixed/compatibility");
  ASSERT_EQ(stored.status, 200) << stored.body;
  EXPECT_EQ(stored.json, expected);
  const Answer asked = client_->post("/api/v1/compatibility", {{"scenario", "replay-mixed"}});
  ASSERT_EQ(asked.status, 200) << asked.body;
  EXPECT_EQ(asked.json, expected);
}

TEST_F(CompatibilityApi, FollowsAPatch) {
  const Answer asked =
      client_->post("/api/v1/compatibility",
                    {{"scenario", "replay-mixed"}, {"patch", {{"lanes", {{"zeta1", {{"adversary", false}}}}}}}});
  ASSERT_EQ(asked.status, 200) << asked.body;
  for (const Json& row : asked.json.at("rows")) {
    if (row.at("reason").is_null()) {
      EXPECT_NE(row.at("cells").at("zeta1").at("reason"), nullptr) << row;
    }
  }
}

TEST_F(CompatibilityApi, SaysWhyThereIsNone) {
  EXPECT_EQ(client_->get("/api/v1/scenarios/nothing/compatibility").status, 404);
  expect_problem(client_->post("/api/v1/compatibility", {{"scenario", "nothing"}}), 422, "/scenario");
  expect_problem(client_->post("/api/v1/compatibility", {{"scenario", "consensus"}, {"seed", 1}}), 422, "/seed");
  EXPECT_EQ(client_->get("/api/v1/scenarios/mrclam/compatibility").status, 422) << "it needs a trace";
}

}  // namespace
}  // namespace vigil::api_test::compatibility_test
