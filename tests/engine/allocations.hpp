/// Counts heap allocations under malloc itself, since Eigen calls it past operator new.
#pragma once

#include <atomic>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VIGIL_COUNTS_MALLOC 1

namespace vigil {

extern std::atomic<bool> counting;
extern std::atomic<long> allocations;  ///< while counting is set, by every thread

/// How many a call makes.
template <class Call>
long allocations_in(Call&& call) {
  allocations = 0;
  counting = true;
  call();
  counting = false;
  return allocations;
}

}  // namespace vigil
#endif
