// No heap allocation in a tick after the first: counted by replacing the global operator new of this executable.
#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/engine/runs/capture.hpp"

namespace {
std::atomic<bool> counting{false};
std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  if (counting) ++allocations;
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace vigil {
namespace {

class Nothing final : public Sink {
 public:
  void frame(const Frame& /*frame*/) override {}
  void mark(const Mark& /*mark*/) override { ++marks; }
  int marks = 0;
};

class TickAllocations : public testing::TestWithParam<const char*> {};

TEST_P(TickAllocations, AreNone) {
  // A recorded run of bounds grows with the run, which is a campaign's business: an endless run records none.
  vigil::Run run(Scenario::preset(GetParam()).patched({{"time", {{"steps", nullptr}}}}), {3, nullptr, {}});
  Nothing sink;
  for (int i = 0; i < 4; ++i) run.step(sink);
  allocations = 0;
  counting = true;
  for (int i = 0; i < 100; ++i) run.step(sink);
  counting = false;
  EXPECT_EQ(allocations, 0) << sink.marks << " marks";
}

INSTANTIATE_TEST_SUITE_P(Run, TickAllocations, testing::Values("consensus", "consensus-compass", "consensus-literal"));

TEST(TickAllocations, CounterCounts) {
  counting = true;
  allocations = 0;
  const auto held = std::make_unique<int>(3);
  counting = false;
  EXPECT_EQ(allocations, 1) << *held;
}

}  // namespace
}  // namespace vigil
