/// A run in one file: all that repeating it needs, and what came out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "db/reader.hpp"
#include "server/runs/order.hpp"

namespace vigil {

/// {"vigil_bundle":1,"version","cpu","scenario","seed","state","k","document","commands":[{"k","body"}],"trace":csv or
/// null,
///  "designs":{"<lane>":record},"metrics","faults","design","warnings","tags","note","signals","frames":csv or absent}.
///  `trace` is the text of its trace.
Json bundle_head(const RunRow& run, const std::vector<Signal>& signals, const std::optional<std::string>& trace);
/// True for a JSON object that claims to be one.
bool is_bundle(const Json& json);

struct Bundle {
  RunOrder order;            ///< with the commands, the trace and the last tick; tags and note as they were
  std::string trace_csv;     ///< empty: none
  std::string version, cpu;  ///< of whoever made it
};

/// Throws InputError with pointers into the bundle. Frames and metrics are not read: they come out again.
Bundle read_bundle(const Json& json);

}  // namespace vigil
