/// Reading the bodies of requests: every member known, typed and within its range, or a problem that names it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/json.hpp"
#include "server/api/services.hpp"
#include "server/front/message.hpp"
#include "server/runs/order.hpp"

namespace vigil {

/// Throws InputError with a problem for each member that is not among `known`, or a value that is not within the
/// structure any document must have (depth, length, UTF-8, finite numbers).
void check_members(const Json& body, const std::vector<std::string>& known);
/// Up to 32 texts of 1 to 64 bytes. Throws InputError at /tags.
std::vector<std::string> read_tags(const Json& value);
/// A text of at most 4000 bytes. Throws InputError at /note.
std::string read_note(const Json& value);
/// An integer within [lo, hi]. Throws InputError at /`key`.
std::int64_t read_integer(const Json& value, const std::string& key, std::int64_t lo, std::int64_t hi);
/// An id of the log, written as a text or an integer. Throws InputError at `pointer`.
std::int64_t read_id(const Json& value, const std::string& pointer);
/// The same problems, each pointer moved below `head`.
[[noreturn]] void rethrow_below(const InputError& error, const std::string& head);

/// The preset or the user's own scenario of that name. Throws HttpError 404.
Scenario named_scenario(const Services& services, const std::string& id);
/// Members scenario (an id or a document) and patch of a body. Throws InputError below /scenario or /patch.
Scenario read_scenario(const Json& body, const Services& services);
/// The body of POST /runs. Throws InputError, HttpError.
RunOrder read_order(const HttpRequest& request, Services& services);
/// Takes over the Idempotency-Key, if there is one, with the hash of what was asked. Throws HttpError 400.
void read_idempotency(const HttpRequest& request, RunOrder& order);

}  // namespace vigil
