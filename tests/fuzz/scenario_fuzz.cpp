/// Any bytes as a scenario document that is run, as a patch and, split at the first line break, as a path and its
/// value.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/cases.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  vigil::fuzz::scenario_case(text);
  const vigil::Json patch = vigil::Json::parse(text, nullptr, false);
  if (!patch.is_discarded()) {
    vigil::fuzz::patch_case(patch);
    vigil::fuzz::run_case(patch);
  }
  const std::size_t line = text.find('\n');
  if (line == std::string_view::npos) return 0;
  const vigil::Json value = vigil::Json::parse(text.substr(line + 1), nullptr, false);
  if (!value.is_discarded()) vigil::fuzz::with_case(text.substr(0, line), value);
  return 0;
}
