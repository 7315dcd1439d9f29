/// A run as the API shows it.
#pragma once

#include <cstdint>
#include <limits>

#include "db/records.hpp"
#include "server/api/services.hpp"

namespace vigil {

/// The largest tick a query may name: sums of a few do not overflow.
inline constexpr std::int64_t kLastTick = std::numeric_limits<std::int64_t>::max() / 4;

/// An item of GET /runs: the row of the log, with what is newer in the live run, if it is live.
Json run_item(const RunRow& row, const Services& services);
/// GET /runs/{id}: the item with design, document, world, commands and every metric.
Json run_detail(const RunRow& row, const Services& services);
/// The row. Throws HttpError 404.
RunRow run_row(const HttpRequest& request, const Services& services);
/// The run, if it is live. Throws HttpError 404 where there is none, 409 where it is over.
std::shared_ptr<LiveRun> live_run(const HttpRequest& request, const Services& services);

}  // namespace vigil
