/// Bad input of the replay family, row by row of section 10 of the specification: one sentence that names the field,
/// its value and what was expected.
#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::replay_input_test {
namespace {

using test::kReplayPresets;
using test::replay_scenario;
using test::Told;

/// The first problem of a document made of a preset's and a patch, wherever it is found.
Problem refused(const Json& patch, const char* preset = "replay-mixed",
                const std::vector<std::string>& lanes = {"as_written"}) {
  try {
    const vigil::Run run(replay_scenario(preset, lanes, patch), {});
  } catch (const InputError& error) {
    return error.problems().front();
  }
  ADD_FAILURE() << "accepted: " << patch;
  return {};
}

void expect_refused(const Problem& problem, const std::string& pointer, const std::vector<std::string>& words) {
  EXPECT_EQ(problem.pointer, pointer) << problem.detail;
  for (const std::string& word : words)
    EXPECT_NE(problem.detail.find(word), std::string::npos) << "\"" << word << "\" in: " << problem.detail;
  EXPECT_EQ(problem.detail.find('\n'), std::string::npos);
}

Json plant(const Json& A, const Json& B = {{0.7}, {0.3}}) { return {{"plant", {{"params", {{"A", A}, {"B", B}}}}}}; }
Json sensor(const Json& params) { return {{"nodes", {{"1", {{"sensor", {{"params", params}}}}}}}}; }
Json lane(const Json& params, const char* id = "as_written") { return {{"lanes", {{id, {{"params", params}}}}}}; }

TEST(ReplayInput, APlantThatNoBatchCanStart) {
  expect_refused(refused(plant({{1, 2}, {0.2, 0.4}})), "/lanes/as_written/params",
                 {"A is [[1.0,2.0],[0.2,0.4]]", "singular", "expected an invertible A"});
  // C sees one mode only; the other decays, so that (A, C) is detectable and yet no two readings tell the state.
  Json blind = plant({{0.9, 0}, {0, 0.5}});
  blind.merge_patch(sensor({{"C", {{1, 0}}}, {"R", 0.2}, {"Mv", 0.5}}));
  expect_refused(refused(blind), "/lanes/as_written/params",
                 {"C is [[1.0,0.0]]", "2 readings do not determine the state", "expected an observable pair"});
  Json growing = plant({{0.9, 0}, {0, 1.1}}, {{0}, {1}});
  growing.merge_patch(sensor({{"C", {{1, 0}}}, {"R", 0.2}, {"Mv", 0.5}}));
  for (const char* id : {"as_written", "ufir"})
    expect_refused(refused(growing, "replay-mixed", {id}), std::string("/lanes/") + id + "/params",
                   {"C is [[1.0,0.0]]", "does not decay", "expected a detectable pair (A, C)"});
}

TEST(ReplayInput, APlantThatNothingStabilises) {
  expect_refused(refused(plant({{1.2, 0}, {0, 0.5}}, {{0}, {1}})), "/controller/params",
                 {"no feedback stabilises it", "expected a stabilisable pair (A, B)"});
  Json weightless = plant({{1, 0}, {0, 0.5}}, {{1}, {1}});
  weightless["controller"]["params"]["Qc"] = 0;
  expect_refused(refused(weightless), "/controller/params/Qc", {"Qc is 0", "Riccati", "expected every such mode"});
  expect_refused(refused({{"controller", {{"params", {{"Rc", -1}}}}}}), "/controller/params/Rc", {"Rc is [[-1.0]]"});
  Json integrating = plant({{1, 0}, {0, 0.5}}, {{1}, {1}});
  integrating["controller"]["params"]["reference"] = "step";
  expect_refused(refused(integrating), "/controller/params/reference", {"eigenvalue at 1", "expected zero"});
}

TEST(ReplayInput, MatricesOfNoise) {
  const Json skew = {{1, 0.5}, {0, 1}}, negative = {{1, 2}, {2, 1}};
  for (const char* name : {"Q", "Mw"}) {
    const std::string pointer = std::string("/noise/") + name;
    expect_refused(refused({{"noise", {{name, skew}}}}), pointer,
                   {name, "is [[1,0.5],[0,1]] and is not symmetric", "expected"});
    expect_refused(refused({{"noise", {{name, negative}}}}), pointer, {name, "negative eigenvalue", "expected"});
    expect_refused(refused({{"noise", {{name, {{1, 1}, {1, 1 - 1e-10}}}}}}), pointer, {"negative eigenvalue"});
    expect_refused(refused({{"noise", {{name, {1, 2, 3}}}}}), pointer, {name});
  }
  for (const char* name : {"R", "Mv"}) {
    const std::string pointer = std::string("/nodes/1/sensor/params/") + name;
    expect_refused(refused(sensor({{name, skew}})), pointer,
                   {name, "[[1.0,0.5],[0.0,1.0]] and is not symmetric", "expected"});
    expect_refused(refused(sensor({{name, negative}})), pointer, {name, "negative eigenvalue", "expected"});
    expect_refused(refused(sensor({{name, {{1, 1}, {1, 1 - 1e-10}}}})), pointer, {"negative eigenvalue"});
  }
  // Rounding of a singular matrix is none.
  EXPECT_NO_THROW(
      vigil::Run(replay_scenario("replay-mixed", {"as_written"}, {{"noise", {{"Q", {{1, 1}, {1, 1 - 1e-14}}}}}}), {}));
}

// Zero matrices are legal, one kind of noise may be absent, a sensor may be exact where the prediction is not.
TEST(ReplayInput, LegalExtremes) {
  const auto runs = [](const Json& patch, const char* preset = "replay-mixed") {
    const Told told(replay_scenario(preset, {"as_written", "zeta1", "innov", "repaired"}, patch), {1, nullptr, {}});
    for (int k = 3; k <= 300; ++k) {
      for (const char* id : {"as_written", "zeta1", "innov", "repaired"})
        ASSERT_TRUE(std::isfinite(told.of(id, k, "estimate.x1"))) << patch << " " << id << " " << k;
    }
    EXPECT_TRUE(told.run.faults().empty());
  };
  Json no_bounded = sensor({{"Mv", 0}}), no_random = sensor({{"R", 0}}), exact = sensor({{"R", 0}, {"Mv", 0}});
  no_bounded["noise"]["Mw"] = 0;
  no_random["noise"]["Q"] = 0;
  runs(no_bounded);
  runs(no_random);
  runs(exact);
  runs(sensor({{"Mv", 0}}));
  runs(sensor({{"R", {0.2, 0}}, {"Mv", {0, 0.5}}}));
  runs({{"noise", {{"Mw", 0}}}});
  runs({{"noise", {{"Q", 0}}}});
}

TEST(ReplayInput, AnExactSensorOfACertainState) {
  Json exact = sensor({{"R", 0}, {"Mv", 0}});
  exact["noise"] = {{"Q", {0.2, 0}}, {"Mw", 0}};
  exact.merge_patch(plant({{0.9, 0}, {0, 0.8}}, {{1}, {1}}));
  expect_refused(refused(exact), "/lanes/as_written/params",
                 {"R is [[0.0,0.0],[0.0,0.0]]", "not invertible", "expected noise in every channel"});
}

TEST(ReplayInput, AWeightThatWeighsNothing) {
  for (const Json& mu : {Json(-0.1), Json(1.1), Json("much")})
    expect_refused(refused(lane({{"mu", mu}})), "/lanes/as_written/params/mu",
                   {"mu is", "expected a number >= 0 and <= 1"});
  Json no_random = sensor({{"R", 0}}), no_bounded = sensor({{"Mv", 0}});
  no_random["noise"]["Q"] = 0;
  no_bounded["noise"]["Mw"] = 0;
  no_random.merge_patch(lane({{"mu", 1}}));
  no_bounded.merge_patch(lane({{"mu", 0}}));
  expect_refused(refused(no_random), "/lanes/as_written/params/mu", {"mu is 1", "identically zero", "expected mu < 1"});
  expect_refused(refused(no_bounded), "/lanes/as_written/params/mu",
                 {"mu is 0", "identically zero", "expected mu > 0"});
}

TEST(ReplayInput, ParametersOfTheDetector) {
  struct Row {
    const char* name;
    Json value;
    const char* expected;
  };
  for (const Row& row :
       {Row{"window", 0, ">= 1"}, Row{"window", 1.5, "an integer"}, Row{"tau", 1, ">= 2"}, Row{"eta", -0.1, ">= 0"},
        Row{"iota", -1, ">= 0"}, Row{"zeta_max", 0, "> 0"}, Row{"zeta_max", -1, "> 0"},
        Row{"threshold", "frosen", "frozen"}, Row{"dead_band", "hold", "held"}, Row{"residual", "prior", "innovation"},
        Row{"watermark", "sensors", "sensor"}, Row{"amplitude", -1, ">= 0"}}) {
    const Problem problem = refused(lane({{row.name, row.value}}));
    expect_refused(problem, std::string("/lanes/as_written/params/") + row.name,
                   {std::string(row.name) + " is", row.expected});
  }
  EXPECT_NE(refused(lane({{"thau", 3}})).detail.find("did you mean \"tau\""), std::string::npos);
}

// eta^2 >= (tau - 1)^2 / tau: accepted, and said.
TEST(ReplayInput, AThresholdThatCannotRiseIsSaid) {
  const auto warned = [](int tau, double eta, const char* threshold) {
    const Json params = {{"tau", tau}, {"eta", eta}, {"threshold", threshold}};
    const vigil::Run run(replay_scenario("replay-nongaussian", {"as_written"}, lane(params)), {});
    for (const std::string& warning : run.warnings()) {
      if (warning.find("can never flag a step") != std::string::npos) return true;
    }
    return false;
  };
  EXPECT_TRUE(warned(10, 3, "printed")) << "9 >= 8.1";
  EXPECT_TRUE(warned(2, 0.8, "printed"));
  EXPECT_FALSE(warned(11, 3, "printed")) << "9 < 100/11";
  EXPECT_FALSE(warned(10, 3, "frozen"));
}

TEST(ReplayInput, MethodsThatDoNotFit) {
  expect_refused(refused({{"noise", {{"Q", {0.2, 0}}}}}, "replay-nongaussian", {"gmeekf"}), "/lanes/gmeekf/params",
                 {"noise.Q is [[0.2,0.0],[0.0,0.0]] and is singular", "expects both random noises positive definite"});
  expect_refused(refused(sensor({{"R", {0.2, 0}}}), "replay-nongaussian", {"gmeekf"}), "/lanes/gmeekf/params",
                 {"R is [[0.2,0.0],[0.0,0.0]] and is singular"});
  for (const char* name : {"alpha", "beta"})
    expect_refused(refused(lane({{name, 0}}, "gmeekf"), "replay-nongaussian", {"gmeekf"}),
                   std::string("/lanes/gmeekf/params/") + name, {std::string(name) + " is 0", "> 0"});
  expect_refused(refused(lane({{"N", 1}}, "ufir"), "replay-mixed", {"ufir"}), "/lanes/ufir/params/N",
                 {"N is 1", "expected at least 2"});
  expect_refused(refused(lane({{"order", 1}}, "zonotope"), "replay-ubb", {"zonotope"}), "/lanes/zonotope/params/order",
                 {"order is 1", "at least as many generators"});
  expect_refused(refused(lane({{"rho", -1}}, "zonotope"), "replay-ubb", {"zonotope"}), "/lanes/zonotope/params/rho",
                 {"rho is -1", ">= 0"});
  Json unbounded = sensor({{"Mv", 0}});
  unbounded["noise"]["Mw"] = 0;
  expect_refused(refused(unbounded, "replay-ubb", {"zonotope"}), "/lanes/zonotope/params",
                 {"Mw and Mv are zero", "expects bounded noise"});
  Json monitor;
  monitor["lanes"]["zonotope"]["path"] = "monitor";
  expect_refused(refused(monitor, "replay-ubb", {"zonotope"}), "/lanes/zonotope/params", {"path is monitor", "loop"});
  Json marked = lane({{"watermark", "sensor"}}, "eq29");
  expect_refused(refused(marked, "replay-mixed", {"eq29"}), "/lanes/eq29/params/watermark",
                 {"watermark is \"sensor\"", "expected none, or the path loop"});
  Json two;
  two["nodes"]["2"] = Scenario::preset("replay-mixed").document()["nodes"]["1"];
  expect_refused(refused(two), "/lanes/as_written/params", {"one sensor", "2 nodes"});
}

TEST(ReplayInput, AlienMatrices) {
  expect_refused(refused(plant({{1, 0, 0}, {0, 1, 0}})), "/plant/params/A", {"A has 2 rows and 3 columns", "square"});
  expect_refused(refused(plant({{1, 0}, {0, 1}}, {{1}, {1}, {1}})), "/plant/params/B", {"B has 3 rows", "expected 2"});
  expect_refused(refused(sensor({{"C", {{1, 0, 0}}}})), "/nodes/1/sensor/params/C", {"C has 3 columns", "2 states"});
  expect_refused(refused({{"initial", {{"truth", {1, 2, 3}}}}}), "/initial/truth", {"truth is [1,2,3]", "2 numbers"});
  expect_refused(refused({{"noise", {{"law", "cauchy"}}}}), "/noise/law", {"law is \"cauchy\"", "student"});
  expect_refused(refused({{"noise", {{"bounded", "box"}}}}), "/noise/bounded", {"bounded is \"box\"", "surface"});
  expect_refused(refused({{"controller", {{"type", "pid"}}}}), "/controller/type", {"pid", "lqg"});
}

Json own_plant() {
  Json document = Scenario::preset("replay-mixed").document();
  document["plant"]["params"] = {{"A", {{1.1, 0.2, 0}, {0, 0.8, 0.3}, {0.1, 0, 0.9}}},
                                 {"B", {{1, 0}, {0, 1}, {0.5, 0.2}}}};
  document["nodes"]["1"]["sensor"]["params"] = {{"C", {{1, 0, 0}, {0, 0, 1}}}, {"R", {0.2, 0.1}}, {"Mv", {0.5, 0.4}}};
  document["noise"]["Q"] = {0.2, 0.1, 0.1};
  document["noise"]["Mw"] = {0.5, 0.2, 0.1};
  document["controller"]["params"] = {{"Qc", {1, 2, 3}}, {"Rc", {1, 0.5}}, {"reference", "sine"}};
  document["initial"]["truth"] = {1, 2, 3};
  document["lanes"]["gmeekf"] = {{"method", "gmeekf"}};
  return document;
}

void expect_tracks(const Told& told, double limit) {
  for (const auto& [id, ignored] : told.run.scenario().document()["lanes"].items()) {
    for (int k = 4; k <= 300; ++k) {
      for (const char* what : {"estimate.x1", "estimate.x3", "input.u2"})
        ASSERT_TRUE(std::isfinite(told.of(id, k, what))) << id << " " << k;
    }
    EXPECT_LT(told.metric(id, "rmse_state"), limit) << id;
  }
  for (const FaultCount& fault : told.run.faults()) ADD_FAILURE() << fault.lane << ": " << fault.detail;
}

// A plant of the user's own, unstable and of other sizes: every lane runs.
TEST(ReplayInput, TakesAUsersOwnPlant) { expect_tracks(Told(Scenario::from_json(own_plant()), {7, nullptr, {}}), 3); }

// The zonotope method where its guarantee holds: two channels, and three, where membership takes a linear program.
TEST(ReplayInput, TakesAUsersOwnPlantWithBoundedNoise) {
  for (const Json& C : {Json{{1, 0, 0}, {0, 0, 1}}, Json{{1, 0, 0}, {0, 1, 0.2}, {0, 0, 1}}}) {
    Json document = own_plant();
    document["plant"]["params"]["A"][0][0] = 0.6;
    document["nodes"]["1"]["sensor"]["params"] = {{"C", C}, {"R", 0}, {"Mv", 0.3}};
    document["noise"]["Q"] = 0;
    document["lanes"] = {{"zonotope", {{"method", "zonotope_watermark"}}}};
    const Told told(Scenario::from_json(document), {8, nullptr, {}});
    expect_tracks(told, 2);
    EXPECT_EQ(told.metric("zonotope", "event_without_attack"), 0);
    EXPECT_GT(told.metric("zonotope", "tpr"), 0.5);
    for (int k = 1; k <= 100; ++k) EXPECT_EQ(told.of("zonotope", k, "alarm"), 0) << k;
    EXPECT_TRUE(told.run.warnings().empty());
  }
  Json unstable = own_plant();
  unstable["lanes"] = {{"zonotope", {{"method", "zonotope_watermark"}}}};
  expect_refused(test::refusal(Scenario::from_json(unstable)).problems().front(), "/lanes/zonotope/params",
                 {"spectral radius 1.16", "expected a plant that is stable by itself"});
  const Told random(replay_scenario("replay-ubb", {"zonotope"}, {{"noise", {{"Q", 0.1}}}}), {8, nullptr, {}});
  ASSERT_EQ(random.run.warnings().size(), 1U);
  EXPECT_NE(random.run.warnings().front().find("lane zonotope: the noise has a random part"), std::string::npos);
}

}  // namespace
}  // namespace vigil::replay_input_test
