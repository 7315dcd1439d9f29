/// What must hold for any bytes at all as rows pushed into a run; shared by the fuzzer and the seeded mutation test.
#pragma once

#include <string>

#include "server/front/message.hpp"
#include "server/ingest/assembler.hpp"
#include "tests/fuzz/cases.hpp"

namespace vigil::fuzz {

/// Every row is accounted for, the window is bounded, and after the deadline nothing is open.
inline void assembled_case(const PushedColumns& columns, const std::vector<IngestRow>& rows) {
  Assembler assembler(columns, {.open = 8, .ahead = 50, .advance = 200});
  const Tally tally = assembler.take(rows, 0);
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

/// Refused with words, or rows that are put together into ticks. `form`: 0 NDJSON, 1 JSON, 2 CSV. True where read.
inline bool ingest_case(unsigned form, const std::string& body) {
  static const PushedColumns columns =
      pushed_columns(Scenario::preset("consensus"), {"link.1-2.state", "sensor.1.state"});
  static const RowReader reader(columns);
  static const char* const kTypes[] = {"application/x-ndjson", "application/json", "text/csv"};
  try {
    const auto rows = reader.read(kTypes[form % 3], body);
    require(!rows.empty(), "no rows");
    assembled_case(columns, rows);
    return true;
  } catch (const InputError& error) {
    check_refusal(error);
  } catch (const HttpError& error) {
    require(error.status() == 400 && is_utf8(error.what()), "a refusal that is none");
  }
  return false;
}

}  // namespace vigil::fuzz
