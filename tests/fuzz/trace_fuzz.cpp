/// Any bytes as a trace.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/cases.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vigil::fuzz::trace_case({reinterpret_cast<const char*>(data), size});
  return 0;
}
