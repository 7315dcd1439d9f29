/// What was pushed into a run, taken back out of its log.
#pragma once

#include <string>

#include "db/reader.hpp"

namespace vigil {

/// True for a run whose rows were pushed.
bool was_pushed(const RunRow& run);

/// The rows of such a run from tick 0 to its newest logged one, as the text of a trace: on it the run repeats bit for
/// bit. Throws RunRefusal (state), with the reason, where the log has not kept all of them.
std::string recorded_rows(const LogReader& reader, const RunRow& run);

}  // namespace vigil
