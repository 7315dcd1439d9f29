// What a system is, over HTTP.
#include "engine/run/system_report.hpp"
#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::check_test {
namespace {

class CheckTest : public ApiTest {
 protected:
  Answer check(const Json& body) const { return client_->post("/api/v1/systems/check", body); }
};

TEST_F(CheckTest, IsTheEnginesReport) {
  const Answer preset = check({{"scenario", "replay-mixed"}});
  ASSERT_EQ(preset.status, 200) << preset.body;
  EXPECT_EQ(preset.json, Json::parse(system_report(Scenario::preset("replay-mixed")).dump()));
  Json patch;
  patch["nodes"]["1"]["sensor"]["params"]["C"] = {{0, 0}, {0, 0}};
  const Answer patched = check({{"scenario", Scenario::preset("replay-mixed").document()}, {"patch", patch}});
  ASSERT_EQ(patched.status, 200) << patched.body;
  EXPECT_EQ(patched.json.at("joint").at("rank"), 0);
  EXPECT_EQ(client_->get("/api/v1/runs").json.at("items"), Json::array()) << "nothing was run";
}

TEST_F(CheckTest, WhatIsWrongHasItsPlace) {
  expect_problem(check(Json::object()), 422, "/scenario");
  expect_problem(check({{"scenario", "consensus"}, {"seed", 3}}), 422, "/seed");
  expect_problem(check({{"scenario", "nothing"}}), 422, "/scenario");
  expect_problem(check({{"scenario", "consensus"}, {"patch", 3}}), 422, "/patch");
  Json document = Scenario::preset("replay-mixed").document();
  document["plant"]["params"]["A"] = {{1, 2}};
  expect_problem(check({{"scenario", document}}), 422, "/scenario/plant/params/A");
  document = Scenario::preset("replay-mixed").document();
  document["nodes"]["1"]["sensor"]["params"]["R"] = {{1, 2, 3}};
  expect_problem(check({{"scenario", document}}), 422, "/scenario/nodes/1/sensor/params/R");
  document["nodes"]["1"]["sensor"]["params"]["C"] = {{1, 2, 3}};
  expect_problem(check({{"scenario", document}}), 422, "/scenario/nodes/1/sensor/params/C");
}

}  // namespace
}  // namespace vigil::api_test::check_test
