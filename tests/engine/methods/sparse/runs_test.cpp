/// Whole runs of the sparse family: lanes beside each other, forks, traces, missing readings, refusals. The contract,
/// section 3; specification of seed 001, section 15.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "engine/linalg/covariance.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::runs_test {
namespace {

using test::Capture;
using test::expect_same;
using test::run_to_end;

const char* const kLanes[] = {"omp_game", "l1", "dkf", "etpg", "sdlms", "omp", "ekf", "pred", "omp_game_channels"};

Scenario sparse(const Json& patch = Json::object()) {
  return Scenario::preset("sparse").patched({{"time", {{"steps", 150}}}}).patched(patch);
}

Json without(const std::vector<std::string>& lanes) {
  Json patch = Json::object();
  for (const std::string& lane : lanes) patch["lanes"][lane] = nullptr;
  return patch;
}

Json only(const std::string& lane) {
  Json patch = Json::object();
  for (const char* other : kLanes) {
    if (lane != other) patch["lanes"][other] = nullptr;
  }
  return patch;
}

double value(const vigil::Run& run, const Frame& frame, const std::string& name) {
  const int id = run.catalogue().find(name);
  EXPECT_GE(id, 0) << name;
  return frame.values[static_cast<std::size_t>(id)];
}

TEST(SparseLanes, KeepTheirBitsWhoeverIsBesideThem) {
  vigil::Run all(sparse(), {4, nullptr, {}});
  Capture together;
  run_to_end(all, together);
  for (const char* lane : kLanes) {
    vigil::Run alone(sparse(only(lane)), {4, nullptr, {}});
    Capture capture;
    run_to_end(alone, capture);
    expect_same(alone, capture, all, together, std::string("lane.") + lane + ".");
  }
}

// Draws of the game are the same for every lane: two of one method and one set of params are one.
TEST(SparseLanes, OfOneMethodAreTwins) {
  Json patch = without({"l1", "dkf", "etpg", "sdlms", "ekf", "pred", "omp_game_channels", "omp"});
  patch["lanes"]["twin"] = {{"method", "omp_game"}};
  vigil::Run run(sparse(patch), {4, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  for (const Frame& frame : capture.frames) {
    for (const char* node : {"1", "2", "3", "4", "5"}) {
      for (const char* what : {".estimate.px", ".estimate.vz", ".choice", ".statistic"}) {
        const std::string tail = std::string(node) + what;
        EXPECT_TRUE(
            test::same_bits(value(run, frame, "lane.omp_game." + tail), value(run, frame, "lane.twin." + tail)));
      }
    }
  }
}

TEST(SparseLanes, GoOnInAForkBitForBit) {
  for (const int at : {3, 6, 95}) {
    vigil::Run run(sparse(), {5, nullptr, {}});
    Capture first;
    while (run.tick() < at) run.step(first);
    vigil::Run fork(run);
    Capture second = first;
    run_to_end(run, first);
    run_to_end(fork, second);
    expect_same(run, first, fork, second, "");
  }
}

TEST(SparseLanes, ObeyTheTraceLaw) {
  const Json patches[] = {Json::object(), {{"initial", {{"x0_random", true}}}}};
  for (const Json& patch : patches) {
    vigil::Run simulated(sparse(patch), {11, nullptr, {}});
    Capture first;
    run_to_end(simulated, first);
    const auto trace = std::make_shared<Trace>(Trace::from_csv(test::csv_of(simulated.catalogue(), first.frames)));
    vigil::Run replayed(sparse(patch), {11, trace, {}});
    Capture second;
    run_to_end(replayed, second);
    for (const char* lane : kLanes) expect_same(simulated, first, replayed, second, std::string("lane.") + lane + ".");
    expect_same(simulated, first, replayed, second, "sensor.");
    const auto mine = simulated.metrics(), theirs = replayed.metrics();
    ASSERT_EQ(mine.size(), theirs.size());
    for (std::size_t m = 0; m < mine.size(); ++m)
      EXPECT_TRUE(test::same_bits(mine[m].value, theirs[m].value)) << mine[m].lane << " " << mine[m].name;
  }
}

/// The frames with some cells of the sensors emptied.
std::string with_gaps(const vigil::Run& run, const Capture& capture) {
  std::vector<Frame> frames = capture.frames;
  const auto empty = [&](std::size_t k, const char* name) {
    frames[k].values[static_cast<std::size_t>(run.catalogue().find(name))] = std::nan("");
  };
  empty(50, "sensor.2.azimuth");
  for (const char* channel : {"range", "azimuth", "elevation", "vx", "vy", "vz"})
    empty(53, (std::string("sensor.2.") + channel).c_str());
  empty(100, "sensor.5.vz");
  return test::csv_of(run.catalogue(), frames);
}

// Six readings after the gap at 53, the last of them at 59.
TEST(SparseLanes, PredictThroughAGapAndFillTheirWindowAnew) {
  vigil::Run simulated(sparse(), {12, nullptr, {}});
  Capture whole;
  run_to_end(simulated, whole);
  const auto trace = std::make_shared<Trace>(Trace::from_csv(with_gaps(simulated, whole)));
  vigil::Run run(sparse(), {12, trace, {}});
  Capture capture;
  run_to_end(run, capture);
  EXPECT_EQ(run.tick(), 150);
  const auto empty = [&](std::size_t k, const std::string& name) {
    return std::isnan(value(run, capture.frames[k], name));
  };
  for (const char* lane : {"omp_game", "omp", "l1", "etpg", "omp_game_channels"}) {
    for (std::size_t k = 6; k <= 150; ++k) {
      const std::string head = std::string("lane.") + lane + ".";
      const bool gap = k >= 50 && k < 59;
      EXPECT_EQ(empty(k, head + "2.attack.range"), gap) << lane << k;
      EXPECT_EQ(empty(k, head + "2.alarm"), gap) << lane << k;
      EXPECT_EQ(empty(k, head + "2.nis"), gap) << lane << k;
      EXPECT_EQ(empty(k, head + "5.statistic"), k >= 100 && k < 106) << lane << k;
      EXPECT_FALSE(empty(k, head + "3.statistic"));
    }
  }
  for (const char* lane : kLanes) {
    for (const Frame& frame : capture.frames)
      EXPECT_TRUE(std::isfinite(value(run, frame, std::string("lane.") + lane + ".2.error"))) << lane << frame.k;
  }
  for (std::size_t k = 50; k < 59; ++k) {
    EXPECT_TRUE(empty(k, "lane.omp_game.2.choice") && empty(k, "lane.omp_game.1.utility.2")) << k;
    EXPECT_FALSE(empty(k, "lane.omp_game.1.choice"));
  }
  for (const FaultCount& fault : run.faults()) EXPECT_FALSE(fault.stopped) << fault.lane << fault.code;
}

TEST(SparseLanes, WithEveryLinkJammedPlayAlone) {
  const Json jam = {{"adversary", {{"jam", {{"type", "dos"}, {"on", {"link:*"}}, {"params", {{"probability", 1}}}}}}}};
  vigil::Run run(sparse(jam), {6, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  for (const Frame& frame : capture.frames) {
    for (const char* node : {"1", "2", "3", "4", "5"}) {
      for (const char* what : {".estimate.px", ".estimate.vy", ".bound", ".attack.range"}) {
        const std::string tail = std::string(node) + what;
        ASSERT_TRUE(test::same_bits(value(run, frame, "lane.omp_game." + tail), value(run, frame, "lane.omp." + tail)));
      }
      if (frame.k < 6) continue;
      EXPECT_EQ(value(run, frame, std::string("lane.omp_game.") + node + ".probability." + node), 1);
    }
  }
}

// What a node's game says: categories by document order, empty for who is no candidate.
TEST(SparseLanes, PublishTheGame) {
  vigil::Run run(sparse(), {7, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  EXPECT_LT(run.catalogue().find("lane.omp_game.2.utility.3"), 0) << "node 3 is no neighbour of node 2";
  const int choice = run.catalogue().find("lane.omp_game.2.choice");
  const Signal& signal = run.catalogue().all()[static_cast<std::size_t>(choice)];
  EXPECT_EQ(signal.labels.at(0).second, "1");
  EXPECT_EQ(signal.labels.at(4).second, "5");
  for (const Frame& frame : capture.frames) {
    double sum = 0;
    for (const char* j : {"1", "2", "5"}) sum += value(run, frame, std::string("lane.omp_game.2.probability.") + j);
    EXPECT_EQ(std::isnan(sum), frame.k < 6);
    if (frame.k < 6) continue;
    EXPECT_NEAR(sum, 1, 1e-14);
    const auto chosen = static_cast<int>(value(run, frame, "lane.omp_game.2.choice"));
    EXPECT_TRUE(chosen == 0 || chosen == 1 || chosen == 4) << chosen;
    const bool alarm = value(run, frame, "lane.omp_game.3.alarm") != 0;
    EXPECT_EQ(alarm, value(run, frame, "lane.omp_game.3.statistic") > value(run, frame, "lane.omp_game.3.threshold"));
  }
  EXPECT_EQ(run.design()["omp_game"]["identifiability"]["dimension"], Json({24, 30}));
}

TEST(SparseLanes, FollowALiveChangeOfTheGraphAndOfTheirParams) {
  vigil::Run run(sparse({{"network", {{"graph", "complete"}}}}), {8, nullptr, {}});
  Capture capture;
  while (run.tick() < 40) run.step(capture);
  run.apply(run.prepare({{"params", {{"network.graph", "ring"}}}}));
  run.apply(run.prepare({{"params", {{"lanes.omp_game.params.greedy", true}, {"lanes.omp_game.params.kappa", 3}}}}));
  run_to_end(run, capture);
  const auto at = [&](std::size_t k, const char* name) { return value(run, capture.frames[k], name); };
  EXPECT_FALSE(std::isnan(at(40, "lane.omp_game.1.utility.3")));
  EXPECT_TRUE(std::isnan(at(41, "lane.omp_game.1.utility.3"))) << "no neighbour in the ring";
  EXPECT_FALSE(std::isnan(at(41, "lane.omp_game.1.utility.2")));
  EXPECT_NEAR(at(41, "lane.omp_game.1.threshold"), 2 * at(40, "lane.omp_game.1.threshold"), 1e-12);
  EXPECT_EQ(at(100, "lane.omp_game.5.choice"), 0) << "clean nodes tie and the lowest is taken";
  for (const Frame& frame : capture.frames)
    EXPECT_TRUE(std::isfinite(value(run, frame, "lane.omp_game.rmse")) &&
                std::isfinite(value(run, frame, "lane.sdlms.rmse")));
}

/// The problem of a document that cannot be run.
Problem refused(const Json& patch) {
  try {
    const vigil::Run run(sparse(patch), {1, nullptr, {}});
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1U) << error.what();
    return error.problems().front();
  }
  ADD_FAILURE() << "accepted: " << patch;
  return {};
}

// What the document's own checks leave to the run; the rest of section 15 is refused with the document.
TEST(SparseInput, IsRefusedByTheFieldThatIsWrong) {
  const auto lane = [](const char* id, const Json& params) { return Json{{"lanes", {{id, {{"params", params}}}}}}; };
  const auto station = [](const Json& R) { return Json{{"nodes", {{"3", {{"sensor", {{"params", {{"R", R}}}}}}}}}}; };
  const std::vector<std::pair<Json, std::string>> bad{
      {lane("omp_game", {{"q", 7}}), "/lanes/omp_game/params/q"},
      {lane("l1", {{"q", -1}}), "/lanes/l1/params/q"},
      {lane("etpg", {{"T", 0}}), "/lanes/etpg/params/T"},
      {lane("omp_game", {{"T", 2.5}}), "/lanes/omp_game/params/T"},
      {lane("omp_game", {{"u_floor", 0}}), "/lanes/omp_game/params/u_floor"},
      {lane("omp_game", {{"form", "outside"}}), "/lanes/omp_game/params/form"},
      {lane("dkf", {{"gain", -1}}), "/lanes/dkf/params/gain"},
      {lane("sdlms", {{"trust", -1}}), "/lanes/sdlms/params/trust"},
      {station({1e-4, 1e-4, 1e-4, 0, 1e-4, 1e-4}), "/nodes/3/sensor/params/R"},
      {station(-1e-4), "/nodes/3/sensor/params/R"},
      {station({1, 2}), "/nodes/3/sensor/params/R"},
      {{{"time", {{"dt", -0.05}}}}, "/time/dt"},
      {{{"noise", {{"Q", -1}}}}, "/noise/Q"},
      {{{"noise", {{"P0", 0}}}}, "/noise/P0"},
      {{{"plant", {{"params", {{"poles_z", {0, 0}}}}}}}, "/plant/params/poles_z"},
      {{{"network", {{"edges", Json::array({{1, 2}, {3, 4}})}}}}, "/network/edges"},
      {{{"network", {{"edges", Json::array({{1, 1}})}}}}, "/network/edges/0"},
      {{{"adversary", {{"node1", {{"on", {"sensor:1.range"}}}}}}}, "/adversary/node1/params"}};
  for (const auto& [patch, pointer] : bad) {
    const Problem problem = refused(patch);
    EXPECT_EQ(problem.pointer, pointer) << patch;
    EXPECT_GT(problem.detail.size(), 10U) << patch;
    EXPECT_EQ(problem.detail.find('\n'), std::string::npos) << "one sentence";
  }
}

// More than the theory allows is accepted and marked: 2 q T > p T - n.
TEST(SparseInput, TooManyAttackedChannelsAreAMarkNotARefusal) {
  Json patch = only("omp_game");
  patch["lanes"]["omp_game"] = {{"params", {{"q", 6}, {"stop", "fixed"}, {"T", 3}}}};
  vigil::Run run(sparse(patch), {1, nullptr, {}});
  EXPECT_EQ(run.design()["omp_game"]["identifiability"]["dimension_ok"], false);
  EXPECT_EQ(run.design()["omp_game"]["identifiability"]["dimension"], Json({36, 12}));
  Capture capture;
  run_to_end(run, capture);
  for (const Frame& frame : capture.frames) EXPECT_TRUE(std::isfinite(value(run, frame, "lane.omp_game.rmse")));
  EXPECT_TRUE(run.faults().empty());
}

}  // namespace
}  // namespace vigil::runs_test
