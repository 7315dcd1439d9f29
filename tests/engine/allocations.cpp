#include "tests/engine/allocations.hpp"

#include <cstdlib>

#ifdef VIGIL_COUNTS_MALLOC

namespace vigil {
std::atomic<bool> counting{false};
std::atomic<long> allocations{0};
}  // namespace vigil

namespace {
void count() {
  if (vigil::counting) ++vigil::allocations;
}
}  // namespace

extern "C" {
// The C library's own entrances, by which an executable may put its own in front.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size) {
  count();
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
}
#endif
