/// Networks, windows and noises of other shapes than the specification's: nothing that is not finite, nothing stops.
/// Specification of seed 001, section 15; issue: 4, 6 and 12 nodes, T 3 to 12, coloured R.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/engine/methods/sparse/windows.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::shapes_test {
namespace {

using test::Capture;
using test::run_to_end;

struct Shape {
  int nodes = 5;
  const char* graph = "ring";
  int T = 6, q = 2;
  Json R = 1e-4;
  double Q = 2.5e-5;
  bool x0_random = false;
  int steps = 60;
};

std::string described(const Shape& s) {
  return std::to_string(s.nodes) + " nodes, " + s.graph + ", T " + std::to_string(s.T) + ", q " + std::to_string(s.q) +
         ", R " + s.R.dump() + ", Q " + std::to_string(s.Q) + (s.x0_random ? ", random start" : "");
}

/// Stations on a circle about the end of the track; every third is attacked from the start, another third later.
Json document_of(const Shape& s) {
  Json document = Scenario::preset("sparse").document();
  document["time"]["steps"] = s.steps;
  document["nodes"] = Json::object();
  document["adversary"] = Json::object();
  for (int i = 1; i <= s.nodes; ++i) {
    const std::string id = std::to_string(i);
    const double angle = 2 + 2 * std::numbers::pi * i / (s.nodes + 2);
    const Json place{10 * std::cos(angle), 10 * std::sin(angle), 0.3 * i};
    document["nodes"][id] = {{"sensor", {{"type", "station"}, {"params", {{"position", place}, {"R", s.R}}}}}};
    if (i % 3 == 0) continue;
    const bool early = i % 3 == 1;
    document["adversary"]["node" + id] = {{"type", "radar_fdi"},
                                          {"on", {"sensor:" + id}},
                                          {"from", early ? 1 : 25},
                                          {"to", early ? Json(20) : Json(nullptr)},
                                          {"params", {{"kind", early ? "I" : "II"}}}};
  }
  document["network"] = {{"graph", s.graph}};
  document["noise"]["Q"] = s.Q;
  document["initial"]["x0_random"] = s.x0_random;
  for (const char* lane : {"omp_game", "omp", "l1", "etpg", "ekf", "omp_game_channels"}) {
    document["lanes"][lane]["params"]["T"] = s.T;
    document["lanes"][lane]["params"]["q"] = s.q;
  }
  return document;
}

/// All nine lanes to the end: estimates at every node and tick, nothing infinite, no lane stopped.
void expect_sound(const Json& document, const std::string& what) {
  SCOPED_TRACE(what);
  vigil::Run run(Scenario::from_json(document), {2, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  EXPECT_EQ(run.tick(), document["time"]["steps"].get<int>());
  for (const FaultCount& fault : run.faults()) EXPECT_FALSE(fault.stopped) << fault.lane << ": " << fault.detail;
  int estimates = 0;
  for (const Signal& signal : run.catalogue().all()) {
    const bool must = signal.name.find(".estimate.") != std::string::npos || signal.name.ends_with(".error");
    estimates += must ? 1 : 0;
    for (const Frame& frame : capture.frames) {
      const double value = frame.values[static_cast<std::size_t>(signal.id)];
      ASSERT_FALSE(std::isinf(value)) << signal.name << " at " << frame.k;
      ASSERT_TRUE(!must || std::isfinite(value)) << signal.name << " at " << frame.k;
    }
  }
  EXPECT_EQ(estimates, 9 * static_cast<int>(document["nodes"].size()) * 7) << "nine lanes, six states and an error";
  const Json design = run.design();
  for (const auto& [lane, constants] : design.items()) {
    if (!constants.contains("identifiability")) continue;
    EXPECT_EQ(constants["identifiability"].dump().find("null"), std::string::npos) << lane;
  }
}

TEST(SparseShapes, NetworksOfOtherSizes) {
  for (const Shape& shape :
       {Shape{.nodes = 4, .graph = "ring"}, Shape{.nodes = 4, .graph = "complete", .T = 3},
        Shape{.nodes = 6, .graph = "complete"}, Shape{.nodes = 6, .graph = "path", .q = 1},
        Shape{.nodes = 12, .graph = "ring", .T = 4, .q = 1}, Shape{.nodes = 12, .graph = "complete", .T = 5}})
    expect_sound(document_of(shape), described(shape));
}

TEST(SparseShapes, WindowsOfOtherLengths) {
  for (const Shape& shape : {Shape{.T = 1}, Shape{.T = 2, .q = 6}, Shape{.T = 3, .q = 3}, Shape{.T = 8, .q = 1},
                             Shape{.nodes = 4, .T = 12}, Shape{.q = 0}, Shape{.nodes = 3, .T = 32, .steps = 40}})
    expect_sound(document_of(shape), described(shape));
}

TEST(SparseShapes, OtherNoises) {
  const Json uneven{1e-4, 4e-4, 1e-6, 1e-2, 1e-4, 9e-4};
  for (const Shape& shape :
       {Shape{.R = windows::coloured()}, Shape{.nodes = 6, .graph = "complete", .R = uneven},
        Shape{.Q = 4e-4, .x0_random = true}, Shape{.R = 1e-10, .Q = 1e-10}, Shape{.R = 1e4}, Shape{.Q = 1}})
    expect_sound(document_of(shape), described(shape));
}

TEST(SparseShapes, OneNodeAlone) {
  expect_sound(document_of({.nodes = 1, .graph = "none"}), "one node");
  vigil::Run run(Scenario::from_json(document_of({.nodes = 1, .graph = "none"})), {2, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  for (const Frame& frame : capture.frames) {
    const auto at = [&](const char* name) {
      return frame.values[static_cast<std::size_t>(run.catalogue().find(name))];
    };
    EXPECT_TRUE(test::same_bits(at("lane.omp_game.1.estimate.px"), at("lane.omp.1.estimate.px"))) << "the game is idle";
    EXPECT_TRUE(frame.k < 6 || at("lane.omp_game.1.choice") == 0);
  }
}

TEST(SparseShapes, EveryOption) {
  const std::vector<std::pair<const char*, Json>> options{
      {"omp_game", {{"form", "inside"}, {"window", "current"}, {"stop", "fixed"}}},
      {"omp_game", {{"greedy", true}, {"window", "frozen"}, {"startup", "update"}}},
      {"omp_game", {{"beta", 0}, {"printed_azimuth_row", true}, {"kappa", 0}}},
      {"omp_game", {{"beta", 1e9}, {"r", 1e6}, {"u_floor", 1e-300}, {"kappa", 1e6}}},
      {"omp_game_channels", {{"block_floor", 0}, {"q", 4}, {"window", "frozen"}}},
      {"l1", {{"window", "current"}, {"startup", "update"}}},
      {"etpg", {{"projection", "element"}, {"shrink", 1}, {"max_steps", 5}}},
      {"ekf", {{"startup", "predict"}, {"printed_azimuth_row", true}}},
      {"sdlms", {{"mu", 0}, {"trust", 0}, {"printed_azimuth_row", true}}},
      {"dkf", {{"gain", 0}, {"printed_azimuth_row", true}}}};
  for (const auto& [lane, params] : options) {
    Json document = document_of({.nodes = 4});
    document["lanes"][lane]["params"].update(params);
    expect_sound(document, std::string(lane) + " " + params.dump());
  }
}

// The target passes over a station, where azimuth has no direction: a named fault at most.
TEST(SparseShapes, AStationUnderTheTrack) {
  Json document = document_of({.nodes = 5, .steps = 60});
  document["nodes"]["3"]["sensor"]["params"]["position"] = {10, 10, 0};
  expect_sound(document, "straight below the start");
  document["plant"]["params"] = {{"poles_x", {1, 0}}, {"poles_y", {1, 0}}, {"poles_z", {1, 0}}};
  document["noise"]["Q"] = 1e-20;
  expect_sound(document, "straight below a target that stays");
}

}  // namespace
}  // namespace vigil::shapes_test
