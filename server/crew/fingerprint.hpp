/// What decides the bits of a trial: two processes with the same fingerprint make the same trial of the same seed.
#pragma once

#include <optional>
#include <string>

#include "engine/core/json.hpp"

namespace vigil {

/// {"version","build","processor","libraries","computation"}, each a text. "computation" is the hash of the bits of a
/// few ticks of several presets; it would catch what the others do not know of.
using Fingerprint = Json;

/// Of this process; computed once, some hundredths of a second. Safe from any thread.
const Fingerprint& own_fingerprint();

/// One sentence that names the first difference with both values; empty where there is none.
std::optional<std::string> difference(const Fingerprint& theirs, const Fingerprint& mine);

}  // namespace vigil
