/// Any bytes as rows pushed into a run; the first says in which of the three forms. What is read is put together into
/// ticks.
#include <cstddef>
#include <cstdint>

#include "server/front/message.hpp"
#include "server/ingest/assembler.hpp"
#include "tests/fuzz/cases.hpp"

namespace {

using vigil::fuzz::require;

void put_together(const vigil::PushedColumns& columns, const std::vector<vigil::IngestRow>& rows) {
  vigil::Assembler assembler(columns, {.open = 8, .ahead = 50, .advance = 200});
  const vigil::Tally tally = assembler.take(rows, 0);
  require(tally.accepted + tally.duplicate + tally.late + tally.beyond == static_cast<std::int64_t>(rows.size()),
          "a row that is not accounted for");
  require(assembler.open().size() <= 8, "too many open ticks");
  assembler.expire(2);
  require(!assembler.due() && static_cast<std::int64_t>(assembler.ready()) == assembler.closed() + 1,
          "a tick that was not closed");
  while (assembler.ready() > 0) {
    for (const double cell : assembler.pop()) require(!std::isinf(cell), "an infinite cell");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const vigil::PushedColumns columns =
      vigil::pushed_columns(vigil::Scenario::preset("consensus"), {"link.1-2.state", "sensor.1.state"});
  static const vigil::RowReader reader(columns);
  static const char* const kTypes[] = {"application/x-ndjson", "application/json", "text/csv"};
  if (size == 0) return 0;
  const std::string body(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const auto rows = reader.read(kTypes[data[0] % 3], body);
    require(!rows.empty(), "no rows");
    put_together(columns, rows);
  } catch (const vigil::InputError& error) {
    vigil::fuzz::check_refusal(error);
  } catch (const vigil::HttpError& error) {
    require(error.status() == 400, "a refusal that is none");
  }
  return 0;
}
