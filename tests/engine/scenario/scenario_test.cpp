#include "engine/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/scenario/document.hpp"

namespace vigil::scenario_test {
namespace {

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> result;
  for (const auto& [key, value] : object.items()) result.push_back(key);
  return result;
}

TEST(Presets, AreValidCompleteAndStable) {
  for (const auto& id : Scenario::preset_ids()) {
    const Scenario preset = Scenario::preset(id);
    EXPECT_EQ(preset.id(), id);
    const bool named =
        id == "sparse" || id.starts_with("replay-") || id.starts_with("observer-") || id.starts_with("privacy-");
    EXPECT_EQ(preset.family(), named ? id.substr(0, id.find('-')) : "consensus");
    EXPECT_EQ(Scenario::from_json(preset.document()).document().dump(), preset.document().dump()) << id;
    EXPECT_EQ(Scenario::from_json(Json::parse(preset.document().dump())).document(), preset.document()) << id;
    EXPECT_NE(preset.document()["title"]["en"], preset.document()["title"]["zh"]);
  }
}

TEST(Presets, HaveTheContractsLanesInOrder) {
  const std::vector<std::string> consensus{"consensus",  "clean",    "drop",       "naive_hold",
                                           "naive_zero", "isolated", "centralized"};
  for (const char* id : {"consensus", "consensus-compass", "consensus-literal"})
    EXPECT_EQ(keys(Scenario::preset(id).document()["lanes"]), consensus);
  const std::vector<std::string> mrclam{"consensus", "isolated", "centralized", "centralized_gated", "dead_reckoning"};
  EXPECT_EQ(keys(Scenario::preset("mrclam").document()["lanes"]), mrclam);
  EXPECT_EQ(Scenario::preset("consensus").document()["lanes"]["clean"]["adversary"], false);
  const std::vector<std::string> sparse{"omp_game",         "l1", "dkf", "etpg", "sdlms", "omp", "ekf", "pred",
                                        "omp_game_channels"};
  EXPECT_EQ(keys(Scenario::preset("sparse").document()["lanes"]), sparse);
  std::vector<std::string> replay{
      "as_written",      "innov",    "zeta1",         "zeta1_freeze", "eq29",         "eq29_freeze", "zeta1_wm",
      "zeta1_wm_freeze", "repaired", "repaired_ctrl", "fixed_norm",   "fixed_square", "ufir"};
  EXPECT_EQ(keys(Scenario::preset("replay-mixed").document()["lanes"]), replay);
  replay.emplace_back("gmeekf");
  EXPECT_EQ(keys(Scenario::preset("replay-nongaussian").document()["lanes"]), replay);
  replay.back() = "zonotope";
  EXPECT_EQ(keys(Scenario::preset("replay-ubb").document()["lanes"]), replay);
  const auto lanes = [](const char* id) { return keys(Scenario::preset(id).document()["lanes"]); };
  EXPECT_EQ(lanes("privacy-robot-linear"), (std::vector<std::string>{"unprotected", "contamination", "complex_noise"}));
  EXPECT_EQ(lanes("privacy-robot-nonlinear"), (std::vector<std::string>{"unprotected", "contamination"}));
  EXPECT_EQ(lanes("privacy-turn"),
            (std::vector<std::string>{"unprotected", "dp_centre", "dp_uniform", "dp_one_sensor"}));
  EXPECT_EQ(lanes("privacy-engine"),
            (std::vector<std::string>{"unprotected", "two_step", "contamination", "secrecy_code_a", "secrecy_code_l"}));
  EXPECT_EQ(lanes("observer-pair"),
            (std::vector<std::string>{"intermediate_fast", "intermediate_ref", "intermediate_printed"}));
  EXPECT_EQ(lanes("observer-areas"),
            (std::vector<std::string>{"intermediate_fast", "intermediate_ref", "matched_uio"}));
  EXPECT_EQ(lanes("observer-single"),
            (std::vector<std::string>{"intermediate_fast", "intermediate_ref", "classical_fast", "classical_ref"}));
}

TEST(Presets, CarryTheSpecificationsNumbers) {
  const Json cm = Scenario::preset("consensus").document();
  EXPECT_EQ(cm["nodes"]["6"]["sensor"]["params"]["position"], Json::array({240, 160}));
  EXPECT_EQ(cm["initial"]["truth"], Json::array({150, 70, 0}));
  EXPECT_EQ(cm["time"]["steps"], 30);
  EXPECT_EQ(cm["lanes"]["consensus"]["params"]["tau"], 0.01);
  EXPECT_EQ(cm["adversary"]["links"]["params"]["pdos"], 0.2);
  const Json literal = Scenario::preset("consensus-literal").document();
  EXPECT_EQ(literal["plant"]["params"]["kappa"], 1);
  EXPECT_EQ(literal["nodes"]["6"]["sensor"]["params"]["position"], Json::array({2.4, 1.6}));
  const Json compass = Scenario::preset("consensus-compass").document();
  EXPECT_EQ(compass["lanes"]["consensus"]["params"]["guard"], "strict");
  EXPECT_EQ(compass["nodes"]["1"]["sensor"]["params"]["compass"], true);
  EXPECT_EQ(compass["lanes"]["consensus"]["params"]["U"], 0.005);
  const Json recorded = Scenario::preset("mrclam").document();
  EXPECT_EQ(recorded["nodes"].size(), 15U);
  EXPECT_TRUE(recorded["nodes"]["20"]["sensor"]["params"]["position"].is_null());
  EXPECT_TRUE(recorded["time"]["steps"].is_null());
}

// Seconds of table 1 as ticks of 0.05 s: [start, end) without its end, the last period to the last tick.
TEST(Presets, SparseCarriesTheSpecificationsNumbers) {
  const Json document = Scenario::preset("sparse").document();
  EXPECT_EQ(document["time"].dump(), R"({"dt":0.05,"steps":200})");
  const int places[5][2] = {{-6, 8}, {-10, 0}, {-6, -8}, {6, -8}, {0, -10}};
  const Json periods = Json::parse(R"([["I",180,null],["I",0,119],["II",120,null],["II",0,119],["I",120,null]])");
  for (std::size_t n = 0; n < 5; ++n) {
    const std::string id = std::to_string(n + 1);
    const Json& sensor = document["nodes"][id]["sensor"]["params"];
    EXPECT_EQ(sensor["position"], Json::array({places[n][0], places[n][1], 0}));
    EXPECT_EQ(sensor["R"], Json::array({1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4}));
    const Json& attack = document["adversary"]["node" + id];
    EXPECT_EQ(attack["on"], Json::array({"sensor:" + id}));
    EXPECT_EQ(Json::array({attack["params"]["kind"], attack["from"], attack["to"]}), periods[n]) << id;
    EXPECT_EQ(attack["params"]["range_spread"], 5.0);
    EXPECT_EQ(attack["params"]["range_offset"], 10.0);
    EXPECT_TRUE(attack["params"]["psi"].is_null());
  }
  EXPECT_EQ(document["noise"]["Q"], Json::array({2.5e-5, 2.5e-5, 2.5e-5, 2.5e-5, 2.5e-5, 2.5e-5}));
  EXPECT_EQ(document["noise"]["P0"], Json::array({0.01, 0.01, 0.01, 0.01, 0.01, 0.01}));
  EXPECT_EQ(document["initial"].dump(), R"({"truth":[10,0,10,0,8,0],"estimates":"truth","x0_random":false})");
  const std::vector<std::pair<int, int>> edges{{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 3}, {2, 4}};
  EXPECT_EQ(edge_indices(document), edges);
  EXPECT_EQ(document["lanes"]["pred"]["params"]["at"], "nodes");
  EXPECT_EQ(document["metrics"]["mse"]["mse_px_0_9s"].dump(), R"({"component":"px","from":0,"to":179})");
  EXPECT_EQ(document["view"]["space"]["components"], Json::array({"px", "py", "pz"}));
}

TEST(Presets, UnknownOneNamesTheNearest) {
  try {
    Scenario::preset("consensus-compas");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"consensus-compass\""), std::string::npos) << error.what();
    EXPECT_NE(error.problems().front().allowed.find("mrclam"), std::string::npos);
  }
}

TEST(Document, FillsInEveryDefault) {
  const Json least = Json::parse(R"({"vigil":1,"id":"mine","plant":{"type":"unicycle"},
    "nodes":{"a":{"sensor":{"type":"range_bearing"}}},"lanes":{"l":{"method":"local_ekf"}}})");
  const Json document = Scenario::from_json(least).document();
  const std::vector<std::string> sections{
      "vigil",   "id",    "title",   "source",    "family", "profile", "time", "plant",        "controller", "nodes",
      "network", "noise", "initial", "adversary", "lanes",  "metrics", "log",  "reproducible", "view"};
  EXPECT_EQ(keys(document), sections);
  EXPECT_EQ(document["title"].dump(), R"({"en":"mine","zh":"mine"})");
  EXPECT_EQ(document["time"].dump(), R"({"dt":1,"steps":null})");
  EXPECT_EQ(document["network"].dump(), R"({"graph":"none"})");
  EXPECT_EQ(document["noise"].dump(), R"({"Q":0,"P0":0,"Mw":0,"law":"gauss","bounded":"uniform"})");
  EXPECT_EQ(document["initial"].dump(), R"({"truth":null,"estimates":null,"x0_random":false})");
  EXPECT_EQ(document["log"].dump(), R"({"signals":["*"],"every":1,"keep":null,"policy":null})");
  EXPECT_EQ(document["lanes"]["l"].dump(),
            R"({"method":"local_ekf","path":"loop","adversary":true,"enabled":true,"params":{}})");
  EXPECT_EQ(Scenario::from_json(document).document(), document);
}

TEST(Document, WritesOneThingOneWay) {
  Json document = Scenario::preset("consensus").document();
  document["title"] = "My <b>title</b>";
  document["network"] = {{"graph", "edges"}, {"edges", Json::parse("[[1,\"2\"],[2,3]]")}};
  document["time"]["steps"] = 20.0;
  const Json done = Scenario::from_json(document).document();
  EXPECT_EQ(done["title"]["zh"], "My <b>title</b>");
  EXPECT_EQ(done["network"]["edges"].dump(), R"([["1","2"],["2","3"]])");
  EXPECT_EQ(done["time"]["steps"].dump(), "20");
  EXPECT_EQ(edge_indices(done), (std::vector<std::pair<int, int>>{{0, 1}, {1, 2}}));
  EXPECT_EQ(document_graph(done)->links().size(), 4U);
}

TEST(Patched, FollowsRfc7396) {
  const Scenario preset = Scenario::preset("consensus");
  const Scenario patched =
      preset.patched(Json::parse(R"({"time":{"steps":50},"lanes":{"drop":null,"consensus":{"params":{"tau":0.02}}}})"));
  EXPECT_EQ(patched.document()["time"]["steps"], 50);
  EXPECT_EQ(patched.document()["time"]["dt"], 1);
  EXPECT_FALSE(patched.document()["lanes"].contains("drop"));
  EXPECT_EQ(patched.document()["lanes"]["consensus"]["params"]["tau"], 0.02);
  EXPECT_EQ(preset.document()["time"]["steps"], 30);
  EXPECT_EQ(preset.patched(Json::object()).document().dump(), preset.document().dump());
}

TEST(Patched, NullBringsTheDefaultBack) {
  const Scenario changed = Scenario::preset("consensus").with("lanes.consensus.params.rho", 0.5);
  const Scenario back = changed.patched(Json::parse(R"({"lanes":{"consensus":{"params":{"rho":null}}},"log":null})"));
  EXPECT_EQ(back.document()["lanes"]["consensus"]["params"]["rho"], 0.9);
  EXPECT_EQ(back.document().dump(), Scenario::preset("consensus").document().dump());
}

TEST(Patched, AddsALane) {
  const Scenario more =
      Scenario::preset("consensus")
          .patched(Json::parse(R"({"lanes":{"mine":{"method":"consensus_ekf","params":{"tau":0.05}}}})"));
  EXPECT_EQ(keys(more.document()["lanes"]).back(), "mine");
  EXPECT_EQ(more.document()["lanes"]["mine"]["params"]["guard"], "clip");
}

TEST(Patched, RefusesBadPatches) {
  const Scenario preset = Scenario::preset("consensus");
  for (const char* text :
       {"[]", "3", "null", R"({"lanes":null})", R"({"lanes":{"x":{}}})", R"({"tme":{}})", R"({"nodes":{"1":3}})"}) {
    EXPECT_THROW(preset.patched(Json::parse(text)), InputError) << text;
  }
  Json deep = Json::object();
  for (int n = 0; n < 40; ++n) deep = {{"view", deep}};
  EXPECT_THROW(preset.patched(deep), InputError);
}

TEST(With, SetsOnePath) {
  const Scenario preset = Scenario::preset("consensus");
  const auto set = [&preset](const char* path, const char* value) {
    return preset.with(path, Json::parse(value)).document();
  };
  EXPECT_EQ(set("lanes.consensus.params.tau", "0.02")["lanes"]["consensus"]["params"]["tau"], 0.02);
  EXPECT_EQ(set("time.steps", "null")["time"]["steps"], nullptr);
  EXPECT_EQ(set("lanes.consensus.params.eps", "0.2")["lanes"]["consensus"]["params"]["eps"], 0.2);
  EXPECT_EQ(set("nodes.6.sensor.params.position.1", "60")["nodes"]["6"]["sensor"]["params"]["position"],
            Json::array({240, 60}));
  EXPECT_EQ(set("network.graph", "\"complete\"")["network"]["graph"], "complete");
  EXPECT_EQ(set("network.edges", "[[1,2]]")["network"]["edges"].size(), 1U);
  EXPECT_EQ(set("metrics.window", "{\"from\":10}")["metrics"]["window"].dump(), R"({"from":10,"to":null})");
  EXPECT_EQ(set("initial.estimates.3", "[1,2,3]")["initial"]["estimates"].dump(), R"({"3":[1,2,3]})");
  EXPECT_EQ(set("view.panels.first", "\"plane\"")["view"]["panels"]["first"], "plane");
}

struct Nowhere {
  const char* path;
  const char* value;
  const char* pointer;
  const char* words;
};

class BadPath : public testing::TestWithParam<Nowhere> {};

TEST_P(BadPath, IsRefused) {
  try {
    Scenario::preset("consensus").with(GetParam().path, Json::parse(GetParam().value));
    FAIL() << GetParam().path;
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().pointer, GetParam().pointer) << error.what();
    EXPECT_NE(error.problems().front().detail.find(GetParam().words), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    With, BadPath,
    testing::Values(Nowhere{"", "1", "/", "leads nowhere"}, Nowhere{".", "1", "/", "leads nowhere"},
                    Nowhere{"time.", "1", "/time/", "leads nowhere"},
                    Nowhere{"lane.consensus.params.tau", "1", "/lane", "did you mean \"lanes\""},
                    Nowhere{"lanes.consensus.params.tua", "1", "/lanes/consensus/params/tua", "did you mean \"tau\""},
                    Nowhere{"lanes.extra", "{}", "/lanes/extra", "leads nowhere"},
                    Nowhere{"time.dt.x", "1", "/time/dt/x", "leads nowhere"},
                    Nowhere{"nodes.1.sensor.params.position.2", "1", "/nodes/1/sensor/params/position/2",
                            "expected 0 to 1"},
                    Nowhere{"nodes.1.sensor.params.position.x", "1", "/nodes/1/sensor/params/position/x", "no index"},
                    Nowhere{"initial.estimates.9", "[1,2,3]", "/initial/estimates/9", "not a key"},
                    Nowhere{"view.", "1", "/view/", "leads nowhere"},
                    Nowhere{"lanes.consensus.params.tau", "-1", "/lanes/consensus/params/tau", "tau is -1"}));

TEST(LivePaths, ListsWhatMayChange) {
  const std::vector<std::string> paths = live_paths(Scenario::preset("consensus").document());
  const auto has = [&paths](const char* path) { return std::find(paths.begin(), paths.end(), path) != paths.end(); };
  for (const char* path :
       {"network.graph", "adversary.links.enabled", "adversary.links.params.pdos", "adversary.links.params.xi_scale",
        "lanes.consensus.params.tau", "lanes.clean.params.guard", "lanes.drop.params.bound"}) {
    EXPECT_TRUE(has(path)) << path;
  }
  for (const char* path : {"time.dt", "plant.params.b", "lanes.consensus.method", "lanes.consensus.params.mode"})
    EXPECT_FALSE(has(path)) << path;
}

TEST(Place, IsParsed) {
  EXPECT_EQ(parse_place("link:*")->kind, PlaceKind::every_link);
  EXPECT_EQ(parse_place("link:2-5")->from, "2");
  EXPECT_EQ(parse_place("link:2-5")->to, "5");
  EXPECT_EQ(parse_place("sensor:3")->channel, "");
  EXPECT_EQ(parse_place("sensor:3.range")->channel, "range");
  EXPECT_EQ(parse_place("actuator:1")->kind, PlaceKind::actuator);
  EXPECT_EQ(parse_place("actuator:1.w2")->channel, "w2");
  for (const char* text : {"", "link", "link:", "link:1", "link:1-", "link:-1", "link:1-2-3", "link:**", "sensor:",
                           "sensor:1.", "sensor:1.a.b", "actuator:", "actuator:1.x.y", "links:1-2", "link:1 -2"}) {
    EXPECT_FALSE(parse_place(text).has_value()) << text;
  }
}

TEST(CompleteAttack, ServesAttacksStartedByHand) {
  const Json document = Scenario::preset("consensus").document();
  std::vector<Problem> problems;
  const Json attack =
      complete_attack(Json::parse(R"({"type":"dos","on":["link:1-2"],"from":5})"), document, "/attack", problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(attack.dump(),
            R"({"type":"dos","on":["link:1-2"],"from":5,"to":null,"enabled":true,"params":{"probability":1.0}})");
  complete_attack(Json::parse(R"({"type":"dos","on":["link:1-6"]})"), document, "/attack", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, "/attack/on/0");
  complete_attack(Json(3), document, "/attack", problems);
  EXPECT_EQ(problems.back().pointer, "/attack");
}

TEST(CompleteAttack, LeavesLinksOpenWhereTheGraphIsNotKnownYet) {
  const Json document = Scenario::preset("mrclam").document();
  EXPECT_FALSE(document_graph(document).has_value());
  std::vector<Problem> problems;
  complete_attack(Json::parse(R"({"type":"dos","on":["link:6-7"]})"), document, "", problems);
  EXPECT_TRUE(problems.empty());
  complete_attack(Json::parse(R"({"type":"dos","on":["link:6-77"]})"), document, "", problems);
  EXPECT_EQ(problems.size(), 1U);
}

TEST(Version, IsGiven) { EXPECT_FALSE(version().empty()); }

}  // namespace
}  // namespace vigil::scenario_test
