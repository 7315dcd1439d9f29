// No heap allocation in a tick of the replay family, but in the one that begins a playback.
#include "tests/engine/allocations.hpp"
#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::replay_allocation_test {
namespace {

#ifdef VIGIL_COUNTS_MALLOC

class Nothing final : public Sink {
 public:
  void frame(const Frame& /*frame*/) override {}
  void mark(const Mark& mark) override { told = told || !mark.detail.empty(); }
  bool told = false;  ///< a mark of this tick has a sentence
};

/// Allocations of the ticks after the first twenty in which nothing is told.
long of_lane(const char* preset, const std::string& lane, const Json& patch = Json::object()) {
  vigil::Run run(test::replay_scenario(preset, {lane}, patch), {3, nullptr, {}});
  Nothing sink;
  for (int i = 0; i <= 20; ++i) run.step(sink);
  long sum = 0;
  int quiet = 0;
  while (!run.done()) {
    sink.told = false;
    const long made = allocations_in([&] { run.step(sink); });
    if (sink.told) continue;
    ++quiet;
    sum += made;
  }
  EXPECT_GT(quiet, 270);
  return sum;
}

TEST(ReplayAllocations, AreNoneInATick) {
  for (const char* preset : test::kReplayPresets) {
    const Json lanes = Scenario::preset(preset).document()["lanes"];
    for (const auto& [lane, ignored] : lanes.items()) EXPECT_EQ(of_lane(preset, lane), 0) << preset << " " << lane;
  }
}

TEST(ReplayAllocations, AreNoneUnderOtherNoiseAndReferences) {
  for (const char* law : {"gauss", "skewmix", "laplace", "gamma", "student"}) {
    const Json patch = {{"noise", {{"law", law}}}, {"controller", {{"params", {{"reference", "sine"}}}}}};
    EXPECT_EQ(of_lane("replay-mixed", "repaired", patch), 0) << law;
  }
  for (const char* bounded : {"surface", "sine"})
    EXPECT_EQ(of_lane("replay-mixed", "repaired", {{"noise", {{"bounded", bounded}}}}), 0) << bounded;
}

#else

TEST(ReplayAllocations, AreCountedWithoutSanitizersOnly) { GTEST_SKIP() << "a sanitizer owns malloc here"; }

#endif

}  // namespace
}  // namespace vigil::replay_allocation_test
