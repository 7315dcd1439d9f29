/// Samples of the log as a frame file.
#pragma once

#include <cstdint>
#include <vector>

#include "db/reader.hpp"
#include "server/front/message.hpp"

namespace vigil {

/// Writes the header and every logged row of the range, in parts; false when the client has gone.
bool write_csv(const LogReader& reader, RunId run, const std::vector<Signal>& catalogue, const std::vector<int>& picked,
               std::int64_t from, std::int64_t to, const BodyWriter& write);

}  // namespace vigil
