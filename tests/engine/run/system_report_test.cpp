// What the report on a system says of systems whose answer is known by hand.
#include "engine/run/system_report.hpp"

#include <cmath>
#include <map>

#include "engine/core/registry.hpp"
#include "engine/methods/method.hpp"
#include "tests/engine/runs/capture.hpp"
#include "tests/engine/scenario/mutate.hpp"

namespace vigil::system_report_test {
namespace {

Json node(const Json& C, const Json& R = 0.1) {
  return {{"sensor", {{"type", "linear"}, {"params", {{"C", C}, {"R", R}}}}}};
}

/// Two nodes, each blind to a mode of the plant that grows; one that decays is nobody's.
Json blind_alone() {
  return {{"vigil", 1},
          {"id", "blind"},
          {"time", {{"dt", 0.5}, {"steps", 20}}},
          {"plant",
           {{"type", "linear"}, {"params", {{"A", {{1.2, 0, 0}, {0, 1.05, 0}, {0, 0, 0.5}}}, {"B", {{1}, {1}, {0}}}}}}},
          {"nodes", {{"1", node({{1, 0, 0}})}, {"2", node({{0, 1, 0}})}}},
          {"network", {{"graph", "path"}}},
          {"noise", {{"Q", {0.1, 0.2, 0.3}}, {"P0", 0}}},
          {"lanes", {{"all", {{"method", "centralized_ekf"}}}}}};
}

Json report_of(const Json& document) { return system_report(Scenario::from_json(document)); }

std::vector<std::string> texts(const Json& modes) {
  std::vector<std::string> result;
  for (const Json& mode : modes) result.push_back(mode.at("text"));
  return result;
}

bool says(const Json& report, const std::string& level, const std::string& words) {
  for (const Json& verdict : report.at("verdicts")) {
    if (verdict.at("level") == level && verdict.at("text").get<std::string>().find(words) != std::string::npos)
      return true;
  }
  return false;
}

using Texts = std::vector<std::string>;

TEST(SystemReport, EachNodeIsBlindAndTogetherTheySee) {
  const Json report = report_of(blind_alone());
  EXPECT_EQ(report.at("plant").at("kind"), "discrete");
  EXPECT_EQ(texts(report.at("plant").at("poles")), (Texts{"1.2", "1.05", "0.5"}));
  EXPECT_EQ(report.at("plant").at("stable"), false);
  const Json &one = report.at("nodes").at(0), &two = report.at("nodes").at(1), &joint = report.at("joint");
  EXPECT_EQ(texts(one.at("hidden")), (Texts{"1.05", "0.5"}));
  EXPECT_EQ(texts(two.at("hidden")), (Texts{"1.2", "0.5"}));
  EXPECT_EQ(one.at("rank"), 1);
  EXPECT_EQ(one.at("detectable"), false);
  EXPECT_NE(two.at("verdict").get<std::string>().find("node 2 does not see the modes 1.2 (which grows)"),
            std::string::npos)
      << two.at("verdict");
  EXPECT_EQ(texts(joint.at("hidden")), (Texts{"0.5"}));
  EXPECT_EQ(joint.at("observable"), false);
  EXPECT_EQ(joint.at("detectable"), true);
  EXPECT_EQ(joint.at("rank"), 2);
  EXPECT_EQ(report.at("control").at("controllable"), false);
  EXPECT_EQ(report.at("control").at("stabilisable"), true);
  ASSERT_EQ(report.at("run").at("warnings").size(), 1u) << report.at("run");
  EXPECT_TRUE(says(report, "warning", "nobody drives it"));
}

TEST(SystemReport, WhatNobodySeesIsSaidByNameAndWarnsARun) {
  Json document = blind_alone();
  document["plant"]["params"] = {{"A", {{1.05, 0.3, 0}, {-0.3, 1.05, 0}, {0, 0, 0.5}}}};
  for (const char* id : {"1", "2"}) document["nodes"][id] = node({{0, 0, 1}});
  const Json report = report_of(document);
  EXPECT_EQ(texts(report.at("joint").at("hidden")), (Texts{"1.05 ± 0.3i"}));
  EXPECT_EQ(report.at("joint").at("hidden").at(0).at("count"), 2);
  EXPECT_EQ(report.at("joint").at("hidden").at(0).at("behaviour"), "grows");
  EXPECT_NEAR(report.at("joint").at("hidden").at(0).at("size").get<double>(), std::hypot(1.05, 0.3), 1e-12);
  EXPECT_TRUE(says(report, "bad", "all nodes together do not see the mode 1.05 ± 0.3i (which grows)"));
  EXPECT_EQ(report.at("run").at("starts"), true);
  vigil::Run run(Scenario::from_json(document), {1, nullptr, {}});
  ASSERT_EQ(run.warnings().size(), 1u);
  EXPECT_EQ(run.warnings()[0], "no node sees the mode 1.05 ± 0.3i (which grows): no lane can follow the plant there");
  test::Capture capture;
  test::run_to_end(run, capture);
  EXPECT_EQ(run.tick(), 20);
}

TEST(SystemReport, OfContinuousTimeHasBothKindsOfPoles) {
  Json document = blind_alone();
  document["plant"]["params"] = {{"A", {{0, 1}, {-9, -0.2}}}, {"B", {{0}, {1}}}, {"time", "continuous"}};
  document["noise"] = {{"Q", {{2, 1}, {1, 2}}}, {"P0", 0}};
  document["nodes"] = {{"1", node({{1, 0}})}, {"2", node({{0, 1}}, {{0}})}};
  const Json report = report_of(document), &plant = report.at("plant");
  EXPECT_EQ(plant.at("kind"), "sampled");
  const double w = std::sqrt(9 - 0.01), dt = 0.5;
  EXPECT_NEAR(plant.at("continuous_poles").at(0).at("re").get<double>(), -0.1, 1e-12);
  EXPECT_NEAR(plant.at("continuous_poles").at(0).at("im").get<double>(), w, 1e-12);
  EXPECT_NEAR(plant.at("poles").at(0).at("re").get<double>(), std::exp(-0.1 * dt) * std::cos(w * dt), 1e-12);
  EXPECT_NEAR(plant.at("poles").at(0).at("im").get<double>(), std::exp(-0.1 * dt) * std::sin(w * dt), 1e-12);
  EXPECT_EQ(plant.at("stable"), true);
  EXPECT_NEAR(report.at("noise").at("Q").at("smallest").get<double>(), 1, 1e-12);
  EXPECT_NEAR(report.at("noise").at("Q").at("largest").get<double>(), 3, 1e-12);
  EXPECT_EQ(report.at("noise").at("P0").at("kind"), "zero");
  EXPECT_EQ(report.at("noise").at("R").at("2").at("kind"), "zero");
}

TEST(SystemReport, ANetworkInPartsSaysWhatEachPartMisses) {
  Json document = blind_alone();
  document["nodes"]["3"] = node({{0, 1, 0}});
  document["network"] = {{"graph", "edges"}, {"edges", Json::array({Json::array({"1", "2"})})}};
  const Json report = report_of(document), &graph = report.at("graph");
  EXPECT_EQ(graph.at("connected"), false);
  EXPECT_EQ(graph.at("degrees"), (Json{{"1", 1}, {"2", 1}, {"3", 0}}));
  ASSERT_EQ(graph.at("components").size(), 2u);
  EXPECT_EQ(graph.at("components").at(0).at("nodes"), Json::array({"1", "2"}));
  EXPECT_EQ(graph.at("components").at(0).at("detectable"), true);
  EXPECT_EQ(graph.at("components").at(1).at("detectable"), false);
  EXPECT_TRUE(says(report, "warning", "the network falls into 2 parts; node 3 does not see the modes 1.2"));
}

TEST(SystemReport, TheFeedbackAndWhoDrivesIt) {
  Json document = blind_alone();
  document["controller"] = {{"type", "feedback"}, {"params", {{"K", {{0, 0, 0}}}}}};
  const Json report = report_of(document);
  EXPECT_TRUE(says(report, "warning", "the closed loop A - B K is not stable: its spectral radius is 1.2"));
  EXPECT_TRUE(says(report, "warning", "node 1 drives the plant by its estimate"));
  EXPECT_EQ(report.at("controller").at("design").at("stable"), false);
  document["controller"] = {{"type", "lqg"}};
  EXPECT_TRUE(says(report_of(document), "good", "the closed loop is stable"));
}

// Every method, on a small linear system of two nodes: fits, or one sentence.
TEST(SystemReport, EveryMethodFitsOrSaysWhyNot) {
  Json document = blind_alone();
  document["plant"]["params"] = {{"A", {{0.9, 0.2}, {-0.1, 0.8}}}};
  document["noise"] = {{"Q", 0.1}, {"P0", 1}};
  document["nodes"] = {{"1", node({{1, 0}})}, {"2", node({{0, 1}})}};
  document["lanes"] = {{"no", {{"method", "fusion"}}}};
  const std::string one = "this method watches one sensor; the scenario has 2 nodes",
                    q = "q is 2; a sensor has 1 channels",
                    flow = "this method observes interconnected subsystems in continuous time";
  const std::map<std::string, std::string> refused{{"etpg_ekf", q},
                                                   {"fusion", "this method sends to a fusion centre"},
                                                   {"gmeekf", one},
                                                   {"intermediate_observer", flow},
                                                   {"l1_ekf", q},
                                                   {"matched_observer", flow},
                                                   {"mixed_filter", one},
                                                   {"omp_ekf", q},
                                                   {"omp_game", q},
                                                   {"omp_game_channels", q},
                                                   {"ufir_filter", one},
                                                   {"window_ekf", q},
                                                   {"zonotope_watermark", one}};
  const Json report = report_of(document);
  EXPECT_EQ(report.at("methods").size(), Registry<MethodMake>::all().size());
  for (const Json& method : report.at("methods")) {
    const std::string id = method.at("id");
    SCOPED_TRACE(id);
    const auto known = refused.find(id);
    ASSERT_EQ(method.at("fits").get<bool>(), known == refused.end()) << method;
    if (known == refused.end()) {
      EXPECT_TRUE(method.at("reason").is_null());
      document["lanes"] = {{"it", {{"method", id}}}};
      EXPECT_NO_THROW(vigil::Run(Scenario::from_json(document), {1, nullptr, {}}));
    } else {
      EXPECT_TRUE(method.at("reason").get<std::string>().starts_with(known->second)) << method;
      EXPECT_EQ(method.at("pointer"), known->second == q ? "/lanes/check/params/q" : "/lanes/check/params");
    }
  }
  EXPECT_EQ(report.at("run").at("starts"), false);
  EXPECT_EQ(report.at("run").at("pointer"), "/lanes/no/params");
  EXPECT_TRUE(says(report, "bad", "a run is refused: "));
  document["network"] = {{"graph", "centre"}};
  document["lanes"] = {{"yes", {{"method", "fusion"}}}};
  EXPECT_EQ(report_of(document).at("run").at("starts"), true);
}

// Every preset that needs no trace has one; no NaN in it, since it survives the way through text.
TEST(SystemReport, OfEveryPreset) {
  for (const std::string& id : Scenario::preset_ids()) {
    SCOPED_TRACE(id);
    if (id == "mrclam") {
      EXPECT_THROW(system_report(Scenario::preset(id)), InputError);
      continue;
    }
    const Json report = system_report(Scenario::preset(id));
    EXPECT_EQ(Json::parse(report.dump()), report);
    EXPECT_EQ(report.at("run").at("starts"), true) << report.at("run");
    EXPECT_TRUE(report.at("run").at("warnings").empty()) << report.at("run");
    EXPECT_EQ(report.at("joint").at("observable"), true);
    const bool flows = id.starts_with("observer");
    EXPECT_EQ(report.at("plant").at("kind") == "continuous", flows);
  }
}

TEST(SystemReport, WhatCannotBeMadeIsRefusedWithItsPlace) {
  Json document = blind_alone();
  document["nodes"]["2"] = node({{1, 0}});
  const auto pointer = [](const Json& of) {
    try {
      report_of(of);
    } catch (const InputError& error) {
      return error.problems().front().pointer;
    }
    return std::string("accepted");
  };
  EXPECT_EQ(pointer(document), "/nodes/2/sensor/params/C");
  document = blind_alone();
  document["nodes"]["1"] = node({{1, 0, 0}}, -1);
  EXPECT_EQ(pointer(document), "/nodes/1/sensor/params/R");
  document = blind_alone();
  document["controller"] = {{"type", "feedback"}, {"params", {{"K", {{1}}}}}};
  EXPECT_EQ(pointer(document), "/controller/params/K");
}

// Whatever numbers a document that is accepted holds: a report without NaN, or words.
TEST(SystemReport, OfAnyNumbersIsFiniteOrRefused) {
  Json flow = blind_alone();
  flow["plant"]["params"]["time"] = "continuous";
  flow["controller"] = {{"type", "feedback"}, {"params", {{"K", {{1, 2, 3}}}}}};
  const Json documents[] = {blind_alone(), flow, Scenario::preset("observer-pair").document(),
                            Scenario::preset("consensus").document()};
  const double numbers[] = {0, 1e-300, 1e-12, 0.5, 1, 7, 1e6, 1e150, 1e308, -1, -1e308};
  Random random(14);
  int reported = 0;
  for (int n = 0; n < 300; ++n) {
    Json document = documents[n % 4];
    for (int changes = 0; changes < 3; ++changes) {
      std::vector<std::string> places;
      const Json flat = document.flatten();
      for (const auto& [pointer, value] : flat.items()) {
        const bool is_world = pointer.starts_with("/plant") || pointer.starts_with("/nodes") ||
                              pointer.starts_with("/noise") || pointer.starts_with("/controller") ||
                              pointer.starts_with("/time/dt") || pointer.starts_with("/initial");
        if (value.is_number() && is_world) places.push_back(pointer);
      }
      document[Json::json_pointer(places[below(random, places.size())])] = numbers[below(random, std::size(numbers))];
    }
    try {
      const Json report = report_of(document);
      ++reported;
      EXPECT_EQ(Json::parse(report.dump()), report) << document;
    } catch (const InputError& error) {
      EXPECT_FALSE(error.problems().front().detail.empty());
    }
  }
  EXPECT_GT(reported, 50);
  EXPECT_LT(reported, 300);
}

TEST(SystemReport, OfSixtyFourStates) {
  Json subsystems = Json::object(), nodes = Json::object();
  for (int i = 1; i <= 32; ++i) {
    subsystems[std::to_string(i)] = {{"A", {{-1, i}, {-i, -2}}}, {"C", {{1, 0}}}};
    nodes[std::to_string(i)] = {{"sensor", {{"type", "subsystem"}, {"params", {{"number", i}}}}}};
  }
  Json document = blind_alone();
  document["plant"] = {{"type", "interconnected"}, {"params", {{"subsystems", subsystems}}}};
  document["nodes"] = nodes;
  document["noise"] = {{"Q", 0}, {"P0", 0}};
  document["lanes"] = {{"it", {{"method", "intermediate_observer"}}}};
  const Json report = report_of(document);
  EXPECT_EQ(report.at("joint").at("rank"), 64);
  for (const Json& node : report.at("nodes")) EXPECT_EQ(node.at("rank"), 2);
}

}  // namespace
}  // namespace vigil::system_report_test
