/// Bytes of the stream: events in SSE's text form, framed as one HTTP chunk each, so that they can be sent as they are.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

/// One event, chunk framing included; shared by all who read it.
using Packet = std::shared_ptr<const std::string>;

/// The chunk that ends a chunked body.
inline constexpr std::string_view kLastChunk = "0\r\n\r\n";

/// 6 significant digits; integers without decimals; "null" for what is not finite.
void append_number(std::string& out, double value);

/// "<size>\r\n<payload>\r\n"
std::string as_chunk(std::string_view payload);

/// `id: <id>` (left out if empty), `event: <event>`, `data: <data>`. `data` holds no line break (JSON does not).
Packet encode_event(std::string_view event, std::string_view data, std::string_view id = {});

/// A tick of a run, restricted to `signals`; ids beyond `values` are null. n: ticks it stands for.
Packet encode_frame(std::string_view epoch, std::int64_t k, double t, std::int64_t n, const std::vector<double>& values,
                    const std::vector<int>& signals);

/// JSON text in which invalid UTF-8 is replaced, never a throw.
inline std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace vigil
