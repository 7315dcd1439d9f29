// The small parts of server/runs that need no server.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <string>

#include "engine/core/input_error.hpp"
#include "server/api/signal_query.hpp"
#include "server/cli/scenario_options.hpp"
#include "server/front/message.hpp"
#include "server/runs/bundle.hpp"
#include "server/runs/campaign_runner.hpp"
#include "server/runs/fork.hpp"
#include "server/runs/glob.hpp"
#include "server/runs/order.hpp"

namespace vigil::pieces_test {
namespace {

TEST(Glob, StarsAndQuestionMarks) {
  EXPECT_TRUE(glob_match("*", ""));
  EXPECT_TRUE(glob_match("truth.?", "truth.x"));
  EXPECT_FALSE(glob_match("truth.?", "truth.xy"));
  EXPECT_TRUE(glob_match("lane.*.error", "lane.consensus.1.error"));
  EXPECT_FALSE(glob_match("lane.*.error", "lane.consensus.1.errors"));
  EXPECT_TRUE(glob_match("*a*b*", "xxaxxabx"));
  EXPECT_FALSE(glob_match("", "x"));
  EXPECT_FALSE(glob_match(std::string(2000, '*') + "b", std::string(2000, 'a')));
}

TEST(PaceOfARun, IsMaxOrTicksPerSecond) {
  EXPECT_FALSE(Pace::from_json("max", "/pace").paced());
  EXPECT_EQ(Pace::from_json(20, "/pace").to_json(), 20.0);
  for (const Json& bad : {Json(0), Json(-1), Json("20"), Json(), Json(1e9), Json::array()}) {
    EXPECT_THROW(Pace::from_json(bad, "/pace"), InputError) << bad;
  }
}

TEST(LogOfARun, FollowsTheDocumentThenThePace) {
  Json document = Scenario::preset("consensus").document();
  EXPECT_EQ(log_policy(document, Pace{}), LogPolicy::lossless);
  EXPECT_EQ(log_policy(document, Pace{20}), LogPolicy::live);
  document["log"]["policy"] = "lossless";
  EXPECT_EQ(log_policy(document, Pace{20}), LogPolicy::lossless);
  RunOrder order;
  order.scenario = Scenario::preset("consensus");
  const vigil::Run run = make_run(order);
  EXPECT_TRUE(log_selection(document, run.catalogue()).signals.empty());
  document["log"]["signals"] = {"truth.*"};
  document["log"]["every"] = 4;
  const LogSelection selection = log_selection(document, run.catalogue());
  EXPECT_EQ(selection.every, 4);
  ASSERT_EQ(selection.signals.size(), 3u);
  for (const int id : selection.signals) EXPECT_EQ(run.catalogue()[id].name.rfind("truth.", 0), 0u);
}

TEST(Topics, OverviewLanesAndAll) {
  RunOrder order;
  order.scenario = Scenario::preset("consensus");
  const vigil::Run run = make_run(order);
  const auto topics = hub_topics(run.catalogue(), order.scenario.document());
  ASSERT_EQ(topics.size(), 2 + order.scenario.document().at("lanes").size());
  EXPECT_EQ(topics.front().name, "overview");
  EXPECT_EQ(topics[1].name, "lane:consensus");
  EXPECT_EQ(topics.back().name, "all");
  EXPECT_EQ(static_cast<int>(topics.back().signals.size()), run.catalogue().size());
  const auto names = [&](const HubTopic& topic) {
    std::set<std::string> result;
    for (const int id : topic.signals) result.insert(run.catalogue()[id].name);
    return result;
  };
  const auto overview = names(topics.front());
  EXPECT_TRUE(overview.contains("lane.consensus.1.error"));
  EXPECT_TRUE(overview.contains("sensor.1.state"));
  EXPECT_FALSE(overview.contains("sensor.1.p"));
  EXPECT_FALSE(names(topics[1]).contains("sensor.1.p.injected"));
}

TEST(Topics, ALaneThatReconstructsComesWithWhatWasInjected) {
  RunOrder order;
  order.scenario = Scenario::preset("sparse");
  const vigil::Run run = make_run(order);
  for (const HubTopic& topic : hub_topics(run.catalogue(), order.scenario.document())) {
    const auto carries = [&](const char* name) {
      return std::any_of(topic.signals.begin(), topic.signals.end(),
                         [&](int id) { return run.catalogue()[id].name == name; });
    };
    const bool reconstructs = topic.name == "all" || carries("lane.omp_game.1.attack.range") ||
                              carries("lane.omp.1.attack.range") || carries("lane.l1.1.attack.range") ||
                              carries("lane.etpg.1.attack.range") || carries("lane.omp_game_channels.1.attack.range");
    EXPECT_EQ(carries("sensor.1.range.injected"), reconstructs) << topic.name;
    EXPECT_EQ(carries("sensor.1.range"), topic.name == "all") << topic.name;
  }
}

TEST(Topics, LanesWithAFusionCentreAreComparedInTheOverviewAndEachSaysWhoIsOverheard) {
  const auto carries = [](const char* preset, const std::string& wanted, const char* name) {
    RunOrder order;
    order.scenario = Scenario::preset(preset);
    const vigil::Run run = make_run(order);
    for (const HubTopic& topic : hub_topics(run.catalogue(), order.scenario.document())) {
      if (topic.name != wanted) continue;
      return std::any_of(topic.signals.begin(), topic.signals.end(),
                         [&](int id) { return run.catalogue()[id].name == name; });
    }
    return false;
  };
  EXPECT_TRUE(carries("privacy-robot-linear", "lane:contamination", "link.1-fused.overheard"));
  EXPECT_TRUE(carries("privacy-robot-linear", "lane:contamination", "lane.contamination.eve.fusing.square"));
  EXPECT_FALSE(carries("privacy-robot-linear", "lane:contamination", "link.1-fused.state"));
  EXPECT_FALSE(carries("consensus", "lane:consensus", "link.1-2.overheard"));
  for (const char* own : {"fused.square", "fused.trace", "eve.fusing.square", "eve.zero.trace"}) {
    EXPECT_TRUE(carries("privacy-robot-linear", "overview", (std::string("lane.unprotected.") + own).c_str())) << own;
  }
  EXPECT_FALSE(carries("privacy-robot-linear", "overview", "lane.unprotected.1.square"));
  EXPECT_FALSE(carries("privacy-robot-linear", "overview", "lane.unprotected.eve.fusing.estimate.position"));
}

TEST(Topics, TheOverviewHasEveryAlarm) {
  RunOrder order;
  order.scenario = Scenario::preset("replay-ubb");
  const vigil::Run run = make_run(order);
  const auto topics = hub_topics(run.catalogue(), order.scenario.document());
  const auto carries = [&](const char* name) {
    return std::any_of(topics.front().signals.begin(), topics.front().signals.end(),
                       [&](int id) { return run.catalogue()[id].name == name; });
  };
  EXPECT_TRUE(carries("lane.repaired.1.alarm"));
  EXPECT_TRUE(carries("lane.zonotope.1.alarm"));
  EXPECT_FALSE(carries("lane.repaired.1.statistic"));
}

TEST(RecordOfARun, HashesADocumentHoweverItsNumbersAreWritten) {
  RunOrder order;
  order.scenario = Scenario::preset("replay-ubb");
  const std::string hash = make_record(order, make_run(order)).document_hash;
  Json document = order.scenario.document();
  ASSERT_TRUE(document["plant"]["params"]["A"][0][0].is_number_float());
  document["plant"]["params"]["A"][0][0] = 1;
  order.scenario = Scenario::from_json(document);
  EXPECT_EQ(make_record(order, make_run(order)).document_hash, hash);
  document["plant"]["params"]["A"][0][0] = 1.0625;
  order.scenario = Scenario::from_json(document);
  EXPECT_NE(make_record(order, make_run(order)).document_hash, hash);
}

TEST(SignalQuery, KeepsTheOrderAskedFor) {
  const std::vector<Signal> signals{
      {.id = 0, .name = "truth.x"}, {.id = 1, .name = "truth.y"}, {.id = 2, .name = "lane.a.rmse"}};
  EXPECT_EQ(pick_signals("", signals), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(pick_signals("lane.*,truth.y,1,*", signals), (std::vector<int>{2, 1, 0}));
  EXPECT_THROW(pick_signals("truth.z", signals), HttpError);
  EXPECT_THROW(pick_signals("3", signals), HttpError);
  EXPECT_THROW(pick_signals("99999999999999999999", signals), HttpError);
}

TEST(Assignments, AreJsonOrAWord) {
  EXPECT_EQ(parse_set("a.b=[1,2]").second, Json({1, 2}));
  EXPECT_EQ(parse_set("a.b=strict").second, "strict");
  EXPECT_EQ(parse_set("a.b=null").second, nullptr);
  EXPECT_EQ(parse_set("a=\"x=y\"").second, "x=y");
  for (const char* bad : {"a", "=1", "a=", "a={", "a=1e999", "a=NaN", "a=1,2"}) EXPECT_ANY_THROW(parse_set(bad)) << bad;
  EXPECT_EQ(parse_sweep("a=1,[2,3],\"x,y\",null").second, (std::vector<Json>{1, {2, 3}, "x,y", nullptr}));
  EXPECT_ANY_THROW(parse_sweep("a="));
  EXPECT_ANY_THROW(parse_sweep("a=1,,2"));
}

TEST(Assignments, ThatAreValidTogetherMayComeInAnyOrder) {
  const Scenario base = Scenario::preset("consensus");
  const std::pair<std::string, Json> graph{"network.graph", "edges"}, edges{"network.edges", Json{{1, 2}, {2, 3}}};
  EXPECT_THROW(with_all(base, {graph}), InputError);
  EXPECT_EQ(with_all(base, {graph, edges}).document().at("network"),
            with_all(base, {edges, graph}).document().at("network"));
}

TEST(Fork, ChangesOfTheFutureBecomeCommands) {
  RunRow parent;
  parent.id = 4;
  parent.document = Scenario::preset("consensus").document();
  parent.seed = 9;
  parent.commands = {{2, {{"params", {{"lanes.consensus.params.tau", 0.02}}}}},
                     {8, {{"params", {{"lanes.consensus.params.tau", 0.03}}}}}};
  const Json patch = {{"time", {{"steps", 50}}}, {"adversary", {{"links", nullptr}}}};
  const RunOrder order = fork_order(parent, 5, patch, nullptr);
  EXPECT_EQ(order.seed, 9u);
  EXPECT_EQ(order.fast_until, 5);
  EXPECT_EQ(order.scenario.document().at("time").at("steps"), 50);
  ASSERT_EQ(order.commands.size(), 2u);
  EXPECT_EQ(order.commands[0].k, 2);
  EXPECT_EQ(order.commands[1].k, 6);
  EXPECT_EQ(order.commands[1].body.at("params").at("adversary.links.enabled"), false);
}

TEST(BundleFile, ComesBackAsItWas) {
  RunRow run;
  run.document = Scenario::preset("consensus").document();
  run.seed = 3;
  run.k = 17;
  run.state = "stopped";
  run.version = "0.1.0";
  run.tags = {"demo", "mine"};
  run.commands = {{5, {{"params", {{"lanes.consensus.params.tau", 0.02}}}}}};
  const Bundle bundle = read_bundle(Json::parse(bundle_head(run, {}, std::nullopt).dump()));
  EXPECT_EQ(bundle.order.seed, 3u);
  EXPECT_EQ(bundle.order.last, 17);
  EXPECT_EQ(bundle.order.end_state, "stopped");
  EXPECT_EQ(bundle.order.tags, std::vector<std::string>{"mine"});
  ASSERT_EQ(bundle.order.commands.size(), 1u);
  EXPECT_EQ(bundle.order.commands[0].body, run.commands[0].body);
  EXPECT_EQ(bundle.order.scenario.document(), run.document);
}

TEST(Campaign, CallsBackInOrderAndStopsWhenAsked) {
  CampaignPlan plan;
  plan.points =
      make_grid(Scenario::preset("consensus").with("time.steps", 3), {{"lanes.consensus.params.tau", {0.01, 0.02}}});
  plan.runs = 5;
  plan.threads = 3;
  std::atomic<bool> stop{false};
  std::vector<std::int64_t> order;
  std::vector<std::uint64_t> seeds;
  run_campaign(plan, stop, [&](std::int64_t index, const TrialResult& trial) {
    order.push_back(index);
    seeds.push_back(trial.seed);
  });
  EXPECT_EQ(order, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(seeds, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 1, 2, 3, 4, 5}));
  order.clear();
  run_campaign(plan, stop, [&](std::int64_t index, const TrialResult&) {
    order.push_back(index);
    stop = index == 2;
  });
  EXPECT_LE(order.size(), 4u);
}

}  // namespace
}  // namespace vigil::pieces_test
