#include <fstream>
#include <sstream>

#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::api_test::bundle_test {
namespace {

class BundleTest : public ApiTest {
 protected:
  std::string path(const std::string& id) const { return "/api/v1/runs/" + id; }
  std::string frames(const std::string& id, const std::string& query = "") const {
    return client_->get(path(id) + "/samples" + query, {{"Accept", "text/csv"}}).body;
  }
  /// A run that was changed and attacked by hand, and stopped.
  std::string eventful() {
    const std::string id =
        client_->start({{"scenario", "consensus"},
                        {"seed", 11},
                        {"pace", 200},
                        {"patch", {{"time", {{"steps", nullptr}}}, {"log", {{"policy", "lossless"}}}}}});
    const auto after = [&](std::int64_t ticks) {
      const std::int64_t k = client_->tick(id);
      EXPECT_TRUE(eventually([&] { return client_->tick(id) >= k + ticks; }));
    };
    after(5);
    EXPECT_EQ(client_->patch(path(id), {{"params", {{"lanes.consensus.params.tau", 0.03}}}}).status, 200);
    after(5);
    EXPECT_EQ(client_
                  ->post(path(id) + "/attacks",
                         {{"id", "jam"}, {"type", "dos"}, {"on", {"link:*"}}, {"params", {{"probability", 0.5}}}})
                  .status,
              201);
    after(5);
    EXPECT_EQ(client_->remove(path(id) + "/attacks/jam").status, 200);
    EXPECT_EQ(client_->patch(path(id), {{"params", {{"adversary.links.enabled", false}}}}).status, 200);
    after(5);
    EXPECT_EQ(client_->patch(path(id), {{"state", "stopped"}}).json.at("state"), "stopped");
    return id;
  }
};

TEST_F(BundleTest, ARunWithLiveCommandsIsRepeatedByteForByte) {
  const std::string id = eventful();
  const Answer bundle = client_->get(path(id) + "/bundle");
  ASSERT_EQ(bundle.status, 200);
  ASSERT_EQ(bundle.json.at("commands").size(), 4u);
  const std::string original = frames(id);
  EXPECT_EQ(bundle.json.at("frames"), original);

  std::ofstream(folder_.file("bundle.json")) << bundle.body;
  const Outcome run =
      vigil_command({"run", folder_.file("bundle.json"), "--frames", folder_.file("frames.csv"), "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.error;
  std::ostringstream again;
  again << std::ifstream(folder_.file("frames.csv")).rdbuf();
  EXPECT_EQ(again.str(), original);
  EXPECT_EQ(Json::parse(run.output).at("metrics"), bundle.json.at("metrics"));

  const Answer imported = client_->send("POST", "/api/v1/runs/import", bundle.body);
  ASSERT_EQ(imported.status, 201) << imported.body;
  const std::string copy = imported.json.at("id");
  ASSERT_TRUE(client_->reaches(copy, "stopped"));
  EXPECT_EQ(frames(copy), original);
  EXPECT_EQ(client_->get(path(copy)).json.at("metrics"), bundle.json.at("metrics"));
}

// What a hand's attack means may depend on its tick: a playback plays what came before it.
TEST_F(BundleTest, APlaybackByHandIsRepeatedAndForked) {
  const std::string id =
      client_->start({{"scenario", "replay-mixed"},
                      {"seed", 3},
                      {"pace", 5},
                      {"patch", {{"adversary", {{"replay", nullptr}}}, {"time", {{"steps", 120}}}}}});
  ASSERT_TRUE(eventually([&] { return client_->tick(id) >= 0; }));
  ASSERT_EQ(client_->patch(path(id), {{"state", "paused"}}).status, 200);
  ASSERT_EQ(client_->patch(path(id), {{"step", 80 - client_->tick(id)}}).status, 200);
  ASSERT_TRUE(eventually([&] { return client_->tick(id) >= 80; }));
  ASSERT_EQ(client_->post(path(id) + "/attacks", {{"type", "replay"}, {"on", {"sensor:1"}}}).status, 201);
  ASSERT_EQ(client_->patch(path(id), {{"pace", "max"}, {"state", "running"}}).status, 200);
  ASSERT_TRUE(client_->reaches(id, "finished"));
  const Answer imported = client_->send("POST", "/api/v1/runs/import", client_->get(path(id) + "/bundle").body);
  ASSERT_EQ(imported.status, 201) << imported.body;
  const std::string copy = imported.json.at("id");
  ASSERT_TRUE(client_->reaches(copy, "finished"));
  EXPECT_EQ(frames(copy), frames(id));
  const Answer fork = client_->post(
      path(id) + "/fork",
      {{"k", 100},
       {"patch",
        {{"adversary",
          {{"late", {{"type", "dos"}, {"on", {"sensor:1"}}, {"from", 110}, {"params", Json::object()}}}}}}},
       {"pace", "max"}});
  ASSERT_EQ(fork.status, 201) << fork.body;
  ASSERT_TRUE(client_->reaches(fork.json.at("id"), "finished"));
  EXPECT_EQ(frames(fork.json.at("id"), "?to=109"), frames(id, "?to=109"));
  EXPECT_NE(frames(fork.json.at("id")), frames(id));
}

TEST_F(BundleTest, AForkSharesThePastAndGoesItsOwnWay) {
  const std::string id = eventful();
  const std::int64_t last = client_->tick(id);
  const std::int64_t k = last - 2;
  const Answer forked =
      client_->post(path(id) + "/fork", {{"k", k}, {"pace", "max"}, {"patch", {{"time", {{"steps", last + 10}}}}}});
  ASSERT_EQ(forked.status, 201) << forked.body;
  const std::string same = forked.json.at("id");
  EXPECT_EQ(forked.json.at("parent"), (Json{{"run", id}, {"k", k}}));
  ASSERT_TRUE(client_->reaches(same, "finished"));
  EXPECT_EQ(frames(same, "?to=" + std::to_string(last)), frames(id));
  EXPECT_EQ(client_->tick(same), last + 10);

  const Answer other = client_->post(
      path(id) + "/fork",
      {{"k", k},
       {"pace", "max"},
       {"patch", {{"time", {{"steps", last}}}, {"lanes", {{"consensus", {{"params", {{"tau", 0.1}}}}}}}}}});
  ASSERT_EQ(other.status, 201) << other.body;
  const std::string differs = other.json.at("id");
  ASSERT_TRUE(client_->reaches(differs, "finished"));
  const std::string before = "?to=" + std::to_string(k);
  EXPECT_EQ(frames(differs, before), frames(id, before));
  EXPECT_NE(frames(differs), frames(id));
}

TEST_F(BundleTest, AForkMayNotAlterThePast) {
  const std::string id = eventful();
  const auto refused = [&](const Json& body, const std::string& pointer) {
    SCOPED_TRACE(body.dump());
    expect_problem(client_->post(path(id) + "/fork", body), 422, pointer);
  };
  refused({{"patch", Json::object()}}, "/k");
  refused({{"k", -1}}, "/k");
  refused({{"k", 1'000'000}}, "/k");
  refused({{"k", 1.5}}, "/k");
  refused({{"k", 3}, {"patch", 5}}, "/patch");
  refused({{"k", 3}, {"patch", {{"plant", {{"params", {{"b", 1}}}}}}}}, "/patch/plant/params/b");
  refused({{"k", 3}, {"patch", {{"noise", {{"Q", {1, 1, 1}}}}}}}, "/patch/noise/Q");
  refused({{"k", 3}, {"patch", {{"time", {{"dt", 2}}}}}}, "/patch/time/dt");
  refused({{"k", 3}, {"patch", {{"time", {{"steps", 2}}}}}}, "/patch/time/steps");
  refused({{"k", 3}, {"patch", {{"adversary", {{"late", {{"type", "dos"}, {"on", {"link:*"}}, {"from", 2}}}}}}}},
          "/patch/adversary/late/from");
  refused({{"k", 3}, {"patch", {{"lanes", {{"consensus", {{"params", {{"tau", -1}}}}}}}}}}, "/patch");
  const Answer late = client_->post(
      path(id) + "/fork",
      {{"k", 3},
       {"pace", "max"},
       {"patch",
        {{"time", {{"steps", 9}}}, {"adversary", {{"late", {{"type", "dos"}, {"on", {"link:*"}}, {"from", 6}}}}}}}});
  EXPECT_EQ(late.status, 201) << late.body;
}

// Neither the old time nor the new one may reach back to the tick of the fork.
TEST_F(BundleTest, AForkMovesAnAttackThatHasNotBegun) {
  const std::string id = client_->start({{"scenario", "sparse"}, {"patch", {{"time", {{"steps", 40}}}}}});
  const Json times{{"from", 30}, {"to", 34}};
  const auto fork = [&](const std::string& run, std::int64_t k, const Json& patch) {
    return client_->post(path(run) + "/fork",
                         {{"k", k}, {"pace", "max"}, {"patch", {{"adversary", {{"node3", patch}}}}}});
  };
  ASSERT_TRUE(client_->reaches(id, "finished"));
  const Answer moved = fork(id, 20, times);
  ASSERT_EQ(moved.status, 201) << moved.body;
  const Json attack = moved.json.at("document").at("adversary").at("node3");
  EXPECT_EQ(attack.at("from"), 30);
  EXPECT_EQ(attack.at("to"), 34);
  EXPECT_EQ(attack.at("type"), "radar_fdi");
  const std::string other = moved.json.at("id");
  ASSERT_TRUE(client_->reaches(other, "finished"));
  EXPECT_EQ(frames(other, "?to=29"), frames(id, "?to=29"));
  EXPECT_NE(frames(other), frames(id));
  Json begins = Json::array();
  const Answer marks = client_->get(path(other) + "/marks?type=attack");
  for (const Json& mark : marks.json.at("items")) {
    if (mark.at("id") == "node3") begins.push_back(Json::array({mark.at("edge"), mark.at("k")}));
  }
  EXPECT_EQ(begins, Json::array({Json::array({"begin", 30}), Json::array({"end", 35})}));
  expect_problem(fork(id, 30, times), 422, "/patch/adversary/node3/from");
  expect_problem(fork(other, 31, {{"from", 38}}), 422, "/patch/adversary/node3/from");
  expect_problem(fork(other, 31, {{"to", 38}}), 422, "/patch/adversary/node3/to");
  expect_problem(fork(id, 20, {{"from", 30}, {"to", 25}}), 422, "/adversary/node3/to");
}

TEST_F(BundleTest, BadBundlesAreNamed) {
  const std::string id = client_->start({{"scenario", "consensus"}});
  ASSERT_TRUE(client_->reaches(id, "finished"));
  const Json good = client_->get(path(id) + "/bundle?frames=false").json;
  EXPECT_FALSE(good.contains("frames"));
  const auto refused = [&](const char* key, const Json& value, const std::string& pointer) {
    SCOPED_TRACE(std::string(key) + " " + value.dump());
    Json bundle = good;
    bundle[key] = value;
    expect_problem(client_->post("/api/v1/runs/import", bundle), 422, pointer);
  };
  refused("vigil_bundle", 2, "/vigil_bundle");
  refused("seed", -1, "/seed");
  refused("seed", "x", "/seed");
  refused("k", "x", "/k");
  refused("document", nullptr, "/document");
  refused("document", Json::object(), "");
  refused("commands", {1}, "/commands/0");
  refused("commands", Json::array({{{"k", 1}, {"body", {{"nosuch", 1}}}}}), "/commands/0/body");
  refused("commands", Json::array({{{"k", 1}, {"body", {{"params", {{"no.such", 1}}}}}}}), "");
  refused("trace", 5, "/trace");
  refused("trace", "nonsense", "");
  expect_problem(client_->post("/api/v1/runs/import", Json::object()), 422);
  expect_problem(client_->get(path(id) + "/bundle?frames=perhaps"), 400);
}

}  // namespace
}  // namespace vigil::api_test::bundle_test
