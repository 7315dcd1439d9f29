// What lanes do to each other, to commands and to their own faults: specification of seed 000, sections 6, 13 and 15.
#include <cmath>

#include "engine/linalg/chi_square.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::lanes_test {
namespace {

using test::Capture;
using test::run_to_end;

Scenario consensus(const Json& patch = Json::object()) { return Scenario::preset("consensus").patched(patch); }

Json lane_params(const Json& params, const char* lane = "consensus") {
  return {{"lanes", {{lane, {{"params", params}}}}}};
}

double value(const vigil::Run& run, const Capture& capture, std::size_t k, const std::string& name) {
  const int id = run.catalogue().find(name);
  EXPECT_GE(id, 0) << name;
  return capture.frames[k].values[static_cast<std::size_t>(id)];
}

/// Every signal of one lane beside another's, node by node, to a tolerance (0: bit for bit).
void expect_lanes_alike(const vigil::Run& run, const Capture& capture, const std::string& a, const std::string& b,
                        double tolerance) {
  for (std::size_t k = 0; k < capture.frames.size(); ++k) {
    for (int node = 1; node <= 8; ++node) {
      for (const char* what : {"estimate.x", "estimate.y", "estimate.theta", "bound", "bound_heading", "lambda_max"}) {
        const std::string tail = "." + std::to_string(node) + "." + what;
        const double x = value(run, capture, k, "lane." + a + tail), y = value(run, capture, k, "lane." + b + tail);
        if (tolerance == 0) {
          ASSERT_EQ(x, y) << tail << " at " << k;
        } else {
          ASSERT_NEAR(x, y, tolerance * std::max(1.0, std::abs(x))) << tail << " at " << k;
        }
      }
    }
  }
}

TEST(Lanes, WithoutConsensusAttacksHaveNoEffect) {
  Json patch = lane_params({{"tau", 0}});
  patch["lanes"]["clean"]["params"]["tau"] = 0;  // spared every attack
  patch["adversary"]["links"]["params"]["xi_scale"] = 50;
  vigil::Run run(consensus(patch), {6, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  expect_lanes_alike(run, capture, "consensus", "clean", 0);
}

TEST(Lanes, AllJammedIsNoConsensus) {
  Json patch = lane_params({{"tau", 0}}, "clean");
  patch["adversary"]["links"]["params"] = {{"pdos", 1}, {"pfdi", 0}};
  vigil::Run run(consensus(patch), {6, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  expect_lanes_alike(run, capture, "consensus", "clean", 1e-12);
  for (std::size_t k = 1; k < capture.frames.size(); ++k)
    EXPECT_EQ(value(run, capture, k, "lane.consensus.3.lost"), 3) << "node 3 has three links";
}

TEST(Lanes, AStoppedOneIsSilentAndTheOthersGoOn) {
  vigil::Run run(consensus(lane_params({{"guard", "strict"}})), {1, nullptr, {}}), plain(consensus(), {1, nullptr, {}});
  Capture capture, other;
  run_to_end(run, capture);
  run_to_end(plain, other);
  EXPECT_EQ(run.tick(), 30);
  for (const Signal& signal : run.catalogue().all()) {
    if (signal.lane != "consensus") continue;
    for (std::size_t k = 2; k <= 30; ++k)
      EXPECT_TRUE(std::isnan(capture.frames[k].values[static_cast<std::size_t>(signal.id)])) << signal.name << " " << k;
  }
  for (const char* lane : {"lane.clean.", "lane.drop.", "lane.isolated.", "lane.centralized."})
    test::expect_same(run, capture, plain, other, lane);
  int stops = 0;
  for (const FaultCount& fault : run.faults()) {
    if (!fault.stopped) continue;
    ++stops;
    EXPECT_EQ(fault.lane, "consensus");
    EXPECT_EQ(fault.code, "infeasible_28");
    EXPECT_EQ(fault.first, 2);
    for (const char* part : {"node", "step 2", "eigenvalue", "limit 7.69231"})
      EXPECT_NE(fault.detail.find(part), std::string::npos) << fault.detail;
  }
  EXPECT_EQ(stops, 1);
}

TEST(Lanes, ARunWithoutALivingOneEnds) {
  Json patch = lane_params({{"guard", "strict"}});
  for (const char* lane : {"clean", "drop", "naive_hold", "naive_zero", "isolated", "centralized"})
    patch["lanes"][lane] = nullptr;
  vigil::Run run(consensus(patch), {1, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  EXPECT_EQ(run.tick(), 2);
  EXPECT_TRUE(run.done());
  EXPECT_THROW(run.prepare({{"params", {{"lanes.consensus.params.tau", 0.5}}}}), InputError);
}

// A draw depends on its address: a channel that was jammed at pdos 0.2 is jammed at any higher rate, tick by tick.
TEST(Lanes, ARetunedAttackKeepsItsDraws) {
  vigil::Run run(consensus(), {15, nullptr, {}}), plain(consensus(), {15, nullptr, {}});
  Capture a, b;
  for (int i = 0; i <= 10; ++i) run.step(a);
  run.apply(run.prepare({{"params", {{"adversary.links.params.pdos", 0.5}}}}));
  run_to_end(run, a);
  run_to_end(plain, b);
  int more = 0;
  for (const Signal& signal : run.catalogue().all()) {
    if (signal.link.empty() || !signal.name.ends_with(".state")) continue;
    for (std::size_t k = 1; k <= 30; ++k) {
      const double now = value(run, a, k, signal.name), before = value(plain, b, k, signal.name);
      if (k <= 10) {
        EXPECT_EQ(now, before);
      } else if (before > 0) {
        EXPECT_EQ(now, 1) << "u < 0.4 before, so below 0.5 now";
      }
      more += now > before || (now == 1 && before == 2) ? 1 : 0;
    }
  }
  EXPECT_GT(more, 50);
  EXPECT_EQ(run.design()["consensus"]["eps"], 0.3);
}

// Values for one attack or lane belong together: neither order of pdos 0.9 and pfdi 0.05 may stumble over the old
// partner.
TEST(Commands, JudgeValuesTogether) {
  for (
      const char* body :
      {R"({"params":{"adversary.links.params.pdos":0.9,"adversary.links.params.pfdi":0.05}})",
       R"({"params":{"adversary.links.params.pfdi":0.05,"adversary.links.params.pdos":0.9}})",
       R"({"params":{"adversary.links.params.delta":50,"adversary.links.params.xi_scale":20,"adversary.links.enabled":true}})",
       R"({"params":{"lanes.consensus.params.phibar":0.9,"lanes.consensus.params.gammabar":0.1}})"}) {
    vigil::Run run(consensus(), {1, nullptr, {}});
    EXPECT_NO_THROW(run.apply(run.prepare(Json::parse(body)))) << body;
    Capture capture;
    EXPECT_NO_THROW(run_to_end(run, capture)) << body;
  }
  vigil::Run run(consensus(), {1, nullptr, {}});
  const auto pointer = [&](const char* body) {
    try {
      run.prepare(Json::parse(body));
    } catch (const InputError& error) {
      return error.problems().front().pointer;
    }
    return std::string("accepted");
  };
  EXPECT_EQ(pointer(R"({"params":{"adversary.links.params.pdos":0.9,"adversary.links.params.pfdi":0.2}})"),
            "/params/adversary.links.params.pfdi");
  EXPECT_EQ(pointer(R"({"params":{"lanes.consensus.params.tau":0.1,"lanes.consensus.params.eps":0.9}})"),
            "/params/lanes.consensus.params.eps");
  EXPECT_EQ(pointer(R"({"params":{"lanes.consensus.params.tau":0.1,"lanes.consensus.params.mode":"drop"}})"),
            "/params/lanes.consensus.params.mode");
  EXPECT_EQ(pointer(R"({"params":{"adversary.links.enabled":3}})"), "/params/adversary.links.enabled");
  EXPECT_EQ(pointer(R"({"params":{"adversary.nobody.enabled":true}})"), "/params/adversary.nobody.enabled");
  EXPECT_EQ(pointer(R"({"params":{"lanes.consensus.enabled":false}})"), "/params/lanes.consensus.enabled");
  EXPECT_EQ(pointer(R"({"params":{"":1}})"), "/params/");
}

TEST(Commands, ApplyAtTheirTickInWhateverOrderTheyAreGiven) {
  const Command late{9, {{"params", {{"lanes.consensus.params.tau", 0.02}}}}},
      early{3, {{"params", {{"lanes.consensus.params.tau", 0.03}}}}};
  vigil::Run a(consensus(), {1, nullptr, {late, early}}), b(consensus(), {1, nullptr, {early, late}});
  Capture x, y;
  run_to_end(a, x);
  run_to_end(b, y);
  test::expect_same(a, x, b, y, "");
  std::vector<std::int64_t> ticks;
  for (const Mark& mark : x.marks) {
    if (mark.type == MarkType::command) ticks.push_back(mark.k);
  }
  EXPECT_EQ(ticks, (std::vector<std::int64_t>{3, 9}));
}

TEST(Commands, BeforeTheFirstStepWork) {
  vigil::Run run(consensus(), {1, nullptr, {}}), set(consensus(lane_params({{"tau", 0.05}})), {1, nullptr, {}});
  run.apply(run.prepare({{"params", {{"lanes.consensus.params.tau", 0.05}}}}));
  Capture a, b;
  run_to_end(run, a);
  run_to_end(set, b);
  test::expect_same(run, a, set, b, "lane.consensus.");
}

TEST(Commands, TheGraphMayShrinkAndGrowBack) {
  vigil::Run run(consensus(), {1, nullptr, {}});
  Capture capture;
  for (int i = 0; i < 5; ++i) run.step(capture);
  run.apply(run.prepare({{"params", {{"network.graph", "none"}}}}));
  for (int i = 0; i < 5; ++i) run.step(capture);
  EXPECT_EQ(run.world()["links"].size(), 0U);
  EXPECT_EQ(run.design()["consensus"]["max_degree"], 0);
  run.apply(run.prepare({{"params", {{"network.graph", "ladder"}}}}));
  run_to_end(run, capture);
  EXPECT_EQ(run.world()["links"].size(), 20U);
  EXPECT_EQ(run.design()["consensus"]["eps"], 0.3) << "auto, re-evaluated when the graph changes";
  vigil::Run plain(consensus(), {1, nullptr, {}});
  Capture other;
  run_to_end(plain, other);
  test::expect_same(run, capture, plain, other, "link.");
  test::expect_same(run, capture, plain, other, "lane.isolated.");
  EXPECT_NE(value(run, capture, 30, "lane.consensus.5.estimate.x"),
            value(plain, other, 30, "lane.consensus.5.estimate.x"));
}

TEST(Metrics, Theorem2IsJudgedOnTheRawBounds) {
  vigil::Run run(consensus(), {21, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  double largest = 0;
  for (std::size_t k = 1; k <= 30; ++k) {
    for (int node = 1; node <= 8; ++node)
      largest = std::max(largest, value(run, capture, k, "lane.consensus." + std::to_string(node) + ".lambda_max"));
  }
  EXPECT_EQ(test::metric(run.metrics(), "consensus", "theorem2_max_eig"), largest);
  EXPECT_GT(largest, 100) << "clipped copies stay below 7.69";
  EXPECT_LT(test::metric(run.metrics(), "consensus", "theorem2_min_eig"), 0.1);
  const Json design = run.design()["consensus"];
  EXPECT_NEAR(design["theorem2_low"].get<double>(), 7.5, 1e-12);
  EXPECT_NEAR(design["theorem2_high"].get<double>(), 7.6923076923, 1e-9);
  const Json alone = vigil::Run(consensus({{"network", {{"graph", "none"}}}}), {1, nullptr, {}}).design()["consensus"];
  EXPECT_EQ(alone["theorem2_low"], 0);
}

TEST(Metrics, IntervalsBelongToWhatTheyJudge) {
  const Json design = vigil::Run(consensus(), {1, nullptr, {}}).design();
  const auto upper = [&](const char* lane, const char* name) { return design[lane][name][1].get<double>(); };
  EXPECT_DOUBLE_EQ(upper("consensus", "nees_interval_95"), chi_square_quantile(0.975, 3));
  EXPECT_DOUBLE_EQ(upper("isolated", "nis_interval_95"), chi_square_quantile(0.975, 2));
  EXPECT_DOUBLE_EQ(upper("centralized", "nis_interval_95"), chi_square_quantile(0.975, 16))
      << "eight cameras, two channels each";
  // Where an ordinary filter's assumptions nearly hold, its figures are about their degrees of freedom.
  vigil::Run compass(Scenario::preset("consensus-compass"), {1, nullptr, {}});
  Capture capture;
  run_to_end(compass, capture);
  EXPECT_NEAR(test::metric(compass.metrics(), "centralized", "nis_mean"), 24, 24 * 0.2);
  EXPECT_NEAR(test::metric(compass.metrics(), "isolated", "nees_mean"), 3, 0.6);
}

}  // namespace
}  // namespace vigil::lanes_test
