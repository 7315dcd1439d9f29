// No heap allocation in a tick after the first ones.
#include <Eigen/Core>

#include "tests/engine/allocations.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::allocation_test {
namespace {

#ifdef VIGIL_COUNTS_MALLOC

class Nothing final : public Sink {
 public:
  void frame(const Frame& /*frame*/) override {}
  void mark(const Mark& mark) override { told = told || !mark.detail.empty(); }
  bool told = false;  ///< a mark of this tick has a sentence
};

/// Allocations of all ticks after the third in which no fault is new: what it says is written to the heap, once.
long in_quiet_ticks(const Scenario& scenario, int ticks) {
  vigil::Run run(scenario, {3, nullptr, {}});
  Nothing sink;
  for (int i = 0; i < 3; ++i) run.step(sink);
  long sum = 0;
  int quiet = 0;
  for (int i = 3; i < ticks; ++i) {
    sink.told = false;
    const long made = allocations_in([&] { run.step(sink); });
    if (sink.told) continue;
    ++quiet;
    sum += made;
  }
  EXPECT_EQ(run.tick(), ticks - 1);
  EXPECT_GT(quiet, ticks / 2);
  return sum;
}

Scenario endless(const Json& patch = Json::object()) {
  return Scenario::preset("consensus").patched({{"time", {{"steps", nullptr}}}}).patched(patch);
}

TEST(TickAllocations, AreNoneInEveryPreset) {
  for (const char* preset : {"consensus", "consensus-compass", "consensus-literal"}) {
    EXPECT_EQ(in_quiet_ticks(Scenario::preset(preset).patched({{"time", {{"steps", nullptr}}}}), 100), 0) << preset;
    EXPECT_EQ(in_quiet_ticks(Scenario::preset(preset), 31), 0) << preset << ", which records its bounds for a campaign";
  }
}

// Sensors of different sizes take the bounded kernel.
TEST(TickAllocations, AreNoneOnTheBoundedKernel) {
  const Json mixed = {{"nodes", {{"4", {{"sensor", {{"params", {{"compass", true}, {"R", {1, 1, 1}}}}}}}}}}};
  EXPECT_EQ(in_quiet_ticks(endless(mixed), 200), 0);
}

TEST(TickAllocations, AreNoneUnderEveryAttack) {
  const Json attacks = {
      {"adversary",
       {{"jam", {{"type", "dos"}, {"on", {"link:*"}}, {"params", {{"probability", 0.5}}}}},
        {"push", {{"type", "bias"}, {"on", {"link:1-2"}}, {"params", {{"probability", 0.5}}}}},
        {"glare", {{"type", "bias"}, {"on", {"sensor:4"}}, {"params", {{"vector", {3, 1}}, {"probability", 0.5}}}}}}}};
  EXPECT_EQ(in_quiet_ticks(endless(attacks), 100), 0);
}

TEST(TickAllocations, AreNoneInACopy) {
  vigil::Run run(Scenario::preset("consensus"), {3, nullptr, {}});
  Nothing sink;
  for (int i = 0; i < 5; ++i) run.step(sink);
  vigil::Run copy(run);
  allocations = 0;
  counting = true;
  for (int i = 0; i < 20; ++i) copy.step(sink);
  counting = false;
  EXPECT_EQ(allocations, 0);
}

TEST(TickAllocations, CounterSeesBothEntrances) {
  allocations = 0;
  counting = true;
  const auto held = std::make_unique<int>(3);
  const Eigen::VectorXd vector = Eigen::VectorXd::Constant(*held + 20, 1);
  counting = false;
  EXPECT_EQ(allocations, 2) << vector.sum();
}

#else

TEST(TickAllocations, AreCountedWithoutSanitizersOnly) { GTEST_SKIP() << "a sanitizer owns malloc here"; }

#endif

}  // namespace
}  // namespace vigil::allocation_test
