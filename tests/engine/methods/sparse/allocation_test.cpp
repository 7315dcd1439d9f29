// No heap allocation in a tick of the sparse family after the first ones.
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

/// Allocations of the ticks after the first ten of a run with one lane.
long of_lane(const std::string& lane, const Json& params = Json::object(), const Json& patch = Json::object()) {
  Json document = Scenario::preset("sparse").patched(patch).document();
  const Json kept = document["lanes"][lane];
  document["lanes"] = {{lane, kept}};
  document["lanes"][lane]["params"].update(params);
  document["time"]["steps"] = nullptr;
  vigil::Run run(Scenario::from_json(document), {3, nullptr, {}});
  Nothing sink;
  for (int i = 0; i <= 10; ++i) run.step(sink);
  long sum = 0;
  int quiet = 0;
  for (int i = 0; i < 240; ++i) {
    sink.told = false;
    const long made = allocations_in([&] { run.step(sink); });
    if (sink.told) continue;
    ++quiet;
    sum += made;
  }
  EXPECT_GT(quiet, 200);
  return sum;
}

TEST(SparseAllocations, AreNoneInATick) {
  for (const char* lane : {"omp_game", "l1", "dkf", "etpg", "sdlms", "omp", "ekf", "pred", "omp_game_channels"})
    EXPECT_EQ(of_lane(lane), 0) << lane;
}

TEST(SparseAllocations, AreNoneWithOtherOptions) {
  EXPECT_EQ(of_lane("omp_game", {{"window", "current"}, {"stop", "fixed"}, {"greedy", true}}), 0);
  EXPECT_EQ(of_lane("omp_game", {{"window", "frozen"}, {"form", "inside"}, {"T", 12}}), 0);
  EXPECT_EQ(of_lane("etpg", {{"projection", "element"}}), 0);
  EXPECT_EQ(of_lane("omp_game_channels", {{"q", 3}, {"block_floor", 0}}), 0);
  Json uneven = Json::object();
  for (const char* node : {"1", "2", "3", "4", "5"})
    uneven["nodes"][node]["sensor"]["params"]["R"] = {1e-4, 4e-4, 1e-4, 1e-4, 1e-4, 9e-4};
  for (const char* lane : {"omp_game", "omp_game_channels", "l1"})
    EXPECT_EQ(of_lane(lane, Json::object(), uneven), 0) << lane;
}

#endif

}  // namespace
}  // namespace vigil::allocation_test
