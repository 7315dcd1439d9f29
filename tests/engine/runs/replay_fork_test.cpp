/// Copies of a run that controls plants, in the middle of a playback too, and replays that are started by hand.
#include "engine/run/sensor_channels.hpp"
#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::replay_fork_test {
namespace {

using test::Capture;
using test::replay_scenario;
using test::Told;

const Json kByHand = {{"attack", {{"type", "replay"}, {"on", {"sensor:1"}}}}};

void expect_same_metrics(const vigil::Run& a, const vigil::Run& b) {
  const auto left = a.metrics(), right = b.metrics();
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(to_json(left[i]).dump(), to_json(right[i]).dump());
    EXPECT_TRUE(test::same_bits(left[i].value, right[i].value)) << left[i].lane << " " << left[i].name;
  }
}

/// The first `ticks` frames of `whole` and what a copy made after them goes on with.
void expect_copy_goes_on(const Scenario& scenario, const std::vector<Command>& commands, int ticks) {
  SCOPED_TRACE(scenario.id() + " copied after tick " + std::to_string(ticks));
  const Told whole(scenario, {41, nullptr, commands});
  vigil::Run run(scenario, {41, nullptr, commands});
  Capture copied;
  for (int i = 0; i <= ticks; ++i) run.step(copied);
  vigil::Run copy(run);
  Capture aside;
  test::run_to_end(run, aside);  // the original first: nothing of it may be the copy's
  test::run_to_end(copy, copied);
  test::expect_same(whole.run, whole.capture, copy, copied, "");
  expect_same_metrics(whole.run, copy);
  expect_same_metrics(whole.run, run);
  ASSERT_EQ(copied.marks.size(), whole.capture.marks.size());
  for (std::size_t i = 0; i < copied.marks.size(); ++i)
    EXPECT_EQ(to_json(copied.marks[i]).dump(), to_json(whole.capture.marks[i]).dump());
}

TEST(ReplayFork, GoesOnBitForBit) {
  for (const char* preset : test::kReplayPresets) {
    for (const int ticks : {0, 1, 60, 130, 160}) expect_copy_goes_on(replay_scenario(preset), {}, ticks);
  }
}

TEST(ReplayFork, GoesOnInAHandsReplay) {
  const std::vector<Command> commands{{70, {{"attack", {{"id", "a1"}, {"type", "replay"}, {"on", {"sensor:1"}}}}}},
                                      {240, {{"end_attack", "a1"}}}};
  for (const int ticks : {69, 70, 150})
    expect_copy_goes_on(replay_scenario("replay-ubb", {}, test::no_attack()), commands, ticks);
}

// Beyond the memory of the channels: what is played was kept when it began.
TEST(ReplayFork, GoesOnWhereTheRecordIsForgotten) {
  const Json longer = {{"time", {{"steps", 2500}}}, {"adversary", {{"replay", {{"params", {{"end", 2400}}}}}}}};
  const Scenario scenario = replay_scenario("replay-mixed", {"repaired", "eq29_freeze"}, longer);
  expect_copy_goes_on(scenario, {}, 2000);
  const Told told(scenario, {41, nullptr, {}});
  for (std::int64_t k = 101; k <= 2400; ++k) {
    const std::int64_t source = 50 + (k - 101) % 51;
    ASSERT_EQ(told.of("repaired", k, "sensor.1.y2"), told.of("repaired", source, "sensor.1.y2")) << k;
  }
  static_assert(SensorChannels::kMemory < 2400 - 100);
}

TEST(HandReplay, IsRecordedMarkedAndScored) {
  vigil::Run run(replay_scenario("replay-mixed", {}, test::no_attack()), {42, nullptr, {}});
  Capture capture;
  while (run.tick() < 120) run.step(capture);
  const Command begin = run.prepare(kByHand);
  EXPECT_EQ(begin.k, 121);
  EXPECT_EQ(begin.body["attack"]["id"], "a1");
  run.apply(begin);
  while (run.tick() < 260) run.step(capture);
  const Command end = run.prepare({{"end_attack", "a1"}});
  run.apply(end);
  test::run_to_end(run, capture);
  const int source = run.catalogue().find("lane.repaired.sensor.1.y1.source"),
            state = run.catalogue().find("lane.repaired.sensor.1.state");
  for (std::int64_t k = 1; k <= 300; ++k) {
    const auto& values = capture.frames[static_cast<std::size_t>(k)].values;
    const bool played = k >= 121 && k <= 260;
    EXPECT_EQ(values[static_cast<std::size_t>(state)], played ? 3 : 0) << k;
    const double expected = played ? 70 + static_cast<double>((k - 121) % 51) : std::nan("");  // the 51 ticks before it
    EXPECT_TRUE(test::same_bits(values[static_cast<std::size_t>(source)], expected)) << k;
  }
  std::vector<std::string> story;
  for (const Mark& mark : capture.marks) {
    if (mark.type == MarkType::alarm) continue;
    story.push_back(std::to_string(mark.k) + " " + std::string(to_string(mark.type)) + " " +
                    std::string(to_string(mark.edge)) + " " + mark.id);
  }
  EXPECT_EQ(story, (std::vector<std::string>{"121 command  a1", "121 attack begin a1", "261 command  a1",
                                             "261 attack end a1"}));
  EXPECT_GT(test::metric(run.metrics(), "repaired", "tpr"), 0.9);
  EXPECT_EQ(test::metric(run.metrics(), "as_written", "tpr"), 0);
  EXPECT_EQ(test::metric(run.metrics(), "repaired", "event"), 1);
  // The whole again from the log: the same seed and commands.
  const Told again(run.scenario(), {42, nullptr, {begin, end}});
  test::expect_same(run, capture, again.run, again.capture, "");
  expect_same_metrics(run, again.run);
}

// Before anything happened there is nothing to play; the first ticks play what there is.
TEST(HandReplay, BeginsAsEarlyAsThereIsARecord) {
  vigil::Run run(replay_scenario("replay-ubb", {"eq29"}, test::no_attack()), {43, nullptr, {}});
  Capture capture;
  run.step(capture);
  EXPECT_THROW(run.prepare(kByHand), InputError) << "at tick 1 nothing was sent yet";
  run.step(capture);
  run.apply(run.prepare(kByHand));
  test::run_to_end(run, capture);
  const int y1 = run.catalogue().find("lane.eq29.sensor.1.y1");
  const auto at = [&](std::size_t k) { return capture.frames[k].values[static_cast<std::size_t>(y1)]; };
  for (std::size_t k = 2; k <= 300; ++k) EXPECT_EQ(at(k), at(1)) << k;
}

TEST(HandReplay, TakesAScheduleOfItsOwn) {
  vigil::Run run(replay_scenario("replay-mixed", {"zeta1"}, test::no_attack()), {44, nullptr, {}});
  Capture capture;
  while (run.tick() < 30) run.step(capture);
  const Json params = {{"record_from", 20}, {"record_to", 29}, {"start", 60}, {"end", 75}};
  run.apply(run.prepare({{"attack", {{"type", "replay"}, {"on", {"sensor:1"}}, {"params", params}}}}));
  test::run_to_end(run, capture);
  const int source = run.catalogue().find("lane.zeta1.sensor.1.y1.source");
  for (std::int64_t k = 1; k <= 300; ++k) {
    const double expected = k >= 60 && k <= 75 ? 20 + static_cast<double>((k - 60) % 10) : std::nan("");
    EXPECT_TRUE(
        test::same_bits(capture.frames[static_cast<std::size_t>(k)].values[static_cast<std::size_t>(source)], expected))
        << k;
  }
}

}  // namespace
}  // namespace vigil::replay_fork_test
