// Heads of HTTP requests: whatever the bytes, the parser refuses with a sentence or accepts what cannot be read in two
// ways.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "server/front/door.hpp"
#include "server/front/head.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check_accepted(const vigil::Head& head, const vigil::HeadLimits& limits) {
  require(!head.host.empty() && !head.path.empty() && head.path.front() == '/');
  require(head.fields.size() <= limits.fields);
  for (const char c : head.target) require(c > 0x20 && c < 0x7f);
  for (const auto& [name, value] : head.fields) {
    for (const char c : value) require(c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f));
  }
  vigil::host_name(head.host);
  vigil::percent_decode(head.path, false);
  vigil::percent_decode(head.query, true);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const vigil::HeadLimits limits;
  vigil::HeadScan scan;
  vigil::Refusal refusal;
  std::size_t length = 0;
  // The first byte says in what pieces the rest arrives.
  const std::size_t step = size == 0 ? 1 : 1 + data[0];
  for (std::size_t come = 0; length == 0 && !refusal && come < size;) {
    come = come + step < size ? come + step : size;
    length = scan.scan(bytes.substr(0, come), limits, refusal);
  }
  vigil::Head head;
  const vigil::Refusal parsed = vigil::parse_head(bytes.substr(0, length > 0 ? length : size), limits, head);
  require(!parsed.detail.empty() || parsed.status == 0);
  if (!parsed) check_accepted(head, limits);
  return 0;
}
