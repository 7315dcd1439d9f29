// One run: frames, forks, commands, independence of its parts.
#include <cmath>

#include "tests/engine/runs/capture.hpp"

namespace vigil::run_test {
namespace {

using test::Capture;
using test::expect_same;
using test::metric;
using test::run_to_end;

Scenario consensus(const Json& patch = Json::object()) { return Scenario::preset("consensus").patched(patch); }

TEST(RunFrames, CountFromTheInitialState) {
  vigil::Run run(consensus(), {7, nullptr, {}});
  EXPECT_EQ(run.tick(), -1);
  Capture capture;
  run_to_end(run, capture);
  ASSERT_EQ(capture.frames.size(), 31U);
  for (std::size_t k = 0; k < capture.frames.size(); ++k) {
    EXPECT_EQ(capture.frames[k].k, static_cast<std::int64_t>(k));
    EXPECT_EQ(capture.frames[k].t, static_cast<double>(k));
    EXPECT_EQ(static_cast<int>(capture.frames[k].values.size()), run.catalogue().size());
  }
  const auto value = [&](std::size_t k, const char* name) {
    return capture.frames[k].values[static_cast<std::size_t>(run.catalogue().find(name))];
  };
  EXPECT_EQ(value(0, "truth.x"), 150);
  EXPECT_EQ(value(0, "truth.y"), 70);
  EXPECT_TRUE(std::isnan(value(0, "sensor.1.p"))) << "nothing is measured at the initial state";
  EXPECT_TRUE(std::isfinite(value(0, "lane.consensus.1.estimate.x")));
  EXPECT_TRUE(std::isnan(value(0, "lane.consensus.1.feasible28")));
  EXPECT_EQ(value(1, "lane.consensus.1.feasible28"), 1);
  EXPECT_EQ(value(2, "lane.consensus.1.feasible28"), 0) << "specification, section 6: it fails at step 2";
  run.step(capture);
  EXPECT_EQ(capture.frames.size(), 31U) << "a run that is done does nothing";
}

TEST(RunFrames, HaveTheContractsNames) {
  const vigil::Run run(consensus(), {1, nullptr, {}});
  for (const char* name :
       {"truth.theta", "sensor.8.q", "sensor.8.q.sent", "sensor.8.q.injected", "link.1-2.state", "link.2-1.injected.x",
        "lane.consensus.3.estimate.theta", "lane.consensus.3.error", "lane.consensus.3.bound",
        "lane.consensus.3.bound_heading", "lane.consensus.3.nees", "lane.consensus.3.nis",
        "lane.consensus.3.feasible29", "lane.consensus.3.lambda_max", "lane.consensus.3.lost", "lane.consensus.spread",
        "lane.consensus.rmse", "lane.centralized.fused.estimate.x"}) {
    EXPECT_GE(run.catalogue().find(name), 0) << name;
  }
  EXPECT_LT(run.catalogue().find("link.1-3.state"), 0) << "the ladder has no such channel";
}

TEST(RunReplay, SameSeedSameBytesAndAnotherSeedDiffers) {
  vigil::Run a(consensus(), {5, nullptr, {}}), b(consensus(), {5, nullptr, {}}), c(consensus(), {6, nullptr, {}});
  Capture x, y, z;
  run_to_end(a, x);
  run_to_end(b, y);
  run_to_end(c, z);
  EXPECT_EQ(test::csv_of(a.catalogue(), x.frames), test::csv_of(b.catalogue(), y.frames));
  EXPECT_NE(test::csv_of(a.catalogue(), x.frames), test::csv_of(c.catalogue(), z.frames));
}

TEST(RunFork, ACopyGoesOnAlone) {
  vigil::Run run(consensus(), {2, nullptr, {}});
  Capture before;
  for (int i = 0; i < 12; ++i) run.step(before);
  vigil::Run copy(run);
  Capture left, right;
  run_to_end(run, left);
  run_to_end(copy, right);
  expect_same(run, left, copy, right, "");
  EXPECT_EQ(run.metrics().size(), copy.metrics().size());
  EXPECT_EQ(metric(run.metrics(), "consensus", "rmse_position"), metric(copy.metrics(), "consensus", "rmse_position"));
}

TEST(RunCommands, ReplayToTheSameBytes) {
  vigil::Run live(consensus(), {4, nullptr, {}});
  Capture first;
  std::vector<Command> given;
  const auto command = [&](const Json& body) {
    given.push_back(live.prepare(body));
    live.apply(given.back());
  };
  for (int i = 0; i < 5; ++i) live.step(first);
  command({{"params", {{"lanes.consensus.params.tau", 0.03}, {"adversary.links.params.pdos", 0.6}}}});
  for (int i = 0; i < 4; ++i) live.step(first);
  command({{"attack", {{"type", "bias"}, {"on", {"link:1-2", "link:8-1"}}, {"params", {{"vector", {9, 9, 0}}}}}}});
  command({{"attack", {{"type", "bias"}, {"on", {"sensor:3"}}, {"params", {{"vector", {20, -5}}}}}}});
  for (int i = 0; i < 6; ++i) live.step(first);
  command({{"end_attack", "a1"}});
  command({{"params", {{"network.graph", "ring"}}}});
  run_to_end(live, first);
  EXPECT_EQ(given[0].k, 5);
  EXPECT_EQ(given[1].body["attack"]["id"], "a1");
  EXPECT_EQ(given[2].body["attack"]["id"], "a2");

  vigil::Run again(consensus(), {4, nullptr, given});
  Capture second;
  run_to_end(again, second);
  EXPECT_EQ(test::csv_of(live.catalogue(), first.frames), test::csv_of(again.catalogue(), second.frames));
  ASSERT_EQ(first.marks.size(), second.marks.size());
  for (std::size_t i = 0; i < first.marks.size(); ++i) EXPECT_EQ(to_json(first.marks[i]), to_json(second.marks[i]));

  vigil::Run plain(consensus(), {4, nullptr, {}});
  Capture third;
  run_to_end(plain, third);
  EXPECT_NE(test::csv_of(live.catalogue(), first.frames), test::csv_of(plain.catalogue(), third.frames))
      << "the commands did something";
  expect_same(live, first, plain, third, "truth.");
}

struct Refused {
  const char* body;
  const char* pointer;
};
class RefusedCommand : public testing::TestWithParam<Refused> {};

TEST_P(RefusedCommand, NamesTheFieldAndChangesNothing) {
  vigil::Run run(consensus(), {4, nullptr, {}}), untouched(consensus(), {4, nullptr, {}});
  Capture a, b;
  for (int i = 0; i < 3; ++i) run.step(a);
  try {
    run.prepare(Json::parse(GetParam().body));
    FAIL() << GetParam().body;
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().pointer, GetParam().pointer) << error.what();
    EXPECT_FALSE(error.problems().front().detail.empty());
  }
  run_to_end(run, a);
  run_to_end(untouched, b);
  expect_same(run, a, untouched, b, "");
}

INSTANTIATE_TEST_SUITE_P(
    Run, RefusedCommand,
    testing::Values(
        Refused{R"({})", ""}, Refused{R"({"params":{}})", "/params"},
        Refused{R"({"params":{"plant.params.b":1}})", "/params/plant.params.b"},
        Refused{R"({"params":{"lanes.nobody.params.tau":1}})", "/params/lanes.nobody.params.tau"},
        Refused{R"({"params":{"lanes.consensus.params.tau":-1}})", "/params/lanes.consensus.params.tau"},
        Refused{R"({"params":{"lanes.consensus.params.U":1}})", "/params/lanes.consensus.params.U"},
        Refused{R"({"params":{"lanes.consensus.params.eps":0.5}})", "/params/lanes.consensus.params.eps"},
        Refused{R"({"params":{"adversary.links.params.pdos":0.9}})", "/params/adversary.links.params.pdos"},
        Refused{R"({"params":{"network.graph":"complete"}})", "/params/network.graph"},
        Refused{R"({"params":{"network.graph":3}})", "/params/network.graph"},
        Refused{R"({"attack":{"type":"dos_fdi","on":["sensor:1"]}})", "/attack/on"},
        Refused{R"({"attack":{"type":"bias","on":["sensor:1.z"],"params":{"vector":[1]}}})", "/attack/on/0"},
        Refused{R"({"attack":{"type":"bias","on":["sensor:1"],"params":{"vector":[1,2,3]}}})", "/attack/params/vector"},
        Refused{R"({"end_attack":"nobody"})", "/end_attack"}, Refused{R"({"params":1,"attack":2})", ""}));

TEST(RunIndependence, OtherLanesAndAttacksMoveNoDraw) {
  vigil::Run whole(consensus(), {9, nullptr, {}});
  const Json alone = {{"lanes",
                       {{"clean", nullptr},
                        {"drop", nullptr},
                        {"naive_hold", nullptr},
                        {"naive_zero", nullptr},
                        {"isolated", nullptr}}}};
  vigil::Run few(consensus(alone), {9, nullptr, {}});
  const Json more = {{"adversary", {{"late", {{"type", "dos"}, {"on", {"link:1-2"}}, {"from", 20}}}}}};
  vigil::Run attacked(consensus(more), {9, nullptr, {}});
  Capture a, b, c;
  run_to_end(whole, a);
  run_to_end(few, b);
  run_to_end(attacked, c);
  expect_same(few, b, whole, a, "");
  expect_same(whole, a, attacked, c, "sensor.");
  expect_same(whole, a, attacked, c, "lane.isolated.");
  expect_same(whole, a, attacked, c, "link.3-2.");
  const int jammed = whole.catalogue().find("link.1-2.state");
  for (std::size_t k = 1; k < a.frames.size(); ++k) {
    const double state = c.frames[k].values[static_cast<std::size_t>(jammed)];
    EXPECT_EQ(state, k >= 20 ? 1 : a.frames[k].values[static_cast<std::size_t>(jammed)]) << k;
  }
}

TEST(SensorAttacks, ReachTheReceiversAndSpareTheSpared) {
  const Json glare = {
      {"adversary",
       {{"glare",
         {{"type", "bias"}, {"on", {"sensor:4"}}, {"from", 3}, {"to", 9}, {"params", {{"vector", {30, 12}}}}}}}}};
  vigil::Run plain(consensus(), {3, nullptr, {}}), attacked(consensus(glare), {3, nullptr, {}});
  Capture a, b;
  run_to_end(plain, a);
  run_to_end(attacked, b);
  const auto at = [&](const Capture& capture, std::size_t k, const char* name) {
    return capture.frames[k].values[static_cast<std::size_t>(plain.catalogue().find(name))];
  };
  for (std::size_t k = 1; k <= 30; ++k) {
    const bool acts = k >= 3 && k <= 9;
    EXPECT_DOUBLE_EQ(at(b, k, "sensor.4.p"), at(a, k, "sensor.4.p") + (acts ? 30 : 0)) << k;
    EXPECT_EQ(at(b, k, "sensor.4.q.injected"), acts ? 12 : 0) << k;
    EXPECT_EQ(std::isnan(at(b, k, "sensor.4.p.sent")), !acts) << "the honest value stands where it differs: " << k;
  }
  expect_same(plain, a, attacked, b, "lane.clean.");
  EXPECT_NE(at(a, 5, "lane.isolated.4.estimate.x"), at(b, 5, "lane.isolated.4.estimate.x"));
}

TEST(Marks, AttacksBeginAndEndOnceAndFaultsBySpell) {
  const Json window = {{"adversary", {{"links", {{"from", 4}, {"to", 6}}}}}};
  vigil::Run run(consensus(window), {3, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  std::vector<std::int64_t> begins, ends;
  int faults = 0;
  for (const Mark& mark : capture.marks) {
    if (mark.type == MarkType::attack) (mark.edge == MarkEdge::begin ? begins : ends).push_back(mark.k);
    faults += mark.type == MarkType::fault && mark.edge == MarkEdge::begin && mark.lane == "consensus" &&
                      mark.code == "infeasible_28"
                  ? 1
                  : 0;
  }
  EXPECT_EQ(begins, std::vector<std::int64_t>{4});
  EXPECT_EQ(ends, std::vector<std::int64_t>{7});
  EXPECT_EQ(faults, 8) << "one spell a node, from step 2 to the end";
  for (const FaultCount& fault : run.faults()) {
    if (fault.lane != "consensus" || fault.code != "infeasible_28") continue;
    EXPECT_EQ(fault.first, 2);
    EXPECT_EQ(fault.last, 30);
    EXPECT_EQ(fault.count, 29);
    EXPECT_NE(fault.detail.find("(28)"), std::string::npos);
  }
}

TEST(RunMetrics, AreThoseOfTheFrames) {
  vigil::Run run(consensus(), {21, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  double square = 0, last = 0, nees = 0;
  for (std::size_t k = 1; k <= 30; ++k) {
    for (int node = 1; node <= 8; ++node) {
      const auto at = [&](const char* what) {
        return capture.frames[k].values[static_cast<std::size_t>(
            run.catalogue().find("lane.consensus." + std::to_string(node) + "." + what))];
      };
      square += at("error") * at("error") / 240;
      if (k > 20) last += at("error") * at("error") / 80;
      nees += at("nees") / 240;
    }
  }
  EXPECT_NEAR(metric(run.metrics(), "consensus", "rmse_position"), std::sqrt(square), 1e-12);
  EXPECT_NEAR(metric(run.metrics(), "consensus", "rmse_position_last10"), std::sqrt(last), 1e-12);
  EXPECT_NEAR(metric(run.metrics(), "consensus", "nees_mean"), nees, 1e-12);
  EXPECT_EQ(metric(run.metrics(), "consensus", "first_infeasible_step"), 2);
  EXPECT_EQ(metric(run.metrics(), "consensus", "bound_guaranteed"), 0);
  EXPECT_EQ(metric(run.metrics(), "consensus", "theorem2_holds"), 0);
  EXPECT_TRUE(std::isnan(metric(run.metrics(), "naive_hold", "bound_guaranteed")));
}

}  // namespace
}  // namespace vigil::run_test
