/// A run that shares another's past: the same document, seed and commands up to a tick, then its own way.
#pragma once

#include <cstdint>

#include "db/records.hpp"
#include "server/runs/order.hpp"

namespace vigil {

/// The order of a run that repeats `parent` up to tick k and goes on with `patch` (a JSON Merge Patch of the document).
/// The patch may hold what can change while a run goes on (it acts from tick k+1), new members of "adversary" that
/// begin after k, null for a member of "adversary" (it is switched off), and what does not touch the samples at all:
/// time.steps (not before k), log, title, source, view. Throws InputError, with pointers below /patch, for all else: it
/// would alter the past. `trace` is the content of the parent's trace, if it had one.
RunOrder fork_order(const RunRow& parent, std::int64_t k, const Json& patch, std::shared_ptr<const Trace> trace);

}  // namespace vigil
