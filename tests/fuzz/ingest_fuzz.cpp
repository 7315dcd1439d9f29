/// Any bytes as rows pushed into a run; the first says in which of the three forms.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/ingest_case.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) vigil::fuzz::ingest_case(data[0], {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
