/// Answers that the front writes itself, byte by byte: refusals and the head of a stream.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/front/message.hpp"

namespace vigil {

using HeaderList = std::vector<std::pair<std::string, std::string>>;

/// On every answer: what a browser may do with it (nothing that the page does not need).
const HeaderList& security_headers();

/// A whole answer with a body as it is.
std::string raw_reply(int status, const HeaderList& headers, std::string_view content_type, std::string_view body,
                      bool keep_alive);
/// A whole application/problem+json answer. head_only: to a HEAD request, the body is left out.
std::string raw_problem(int status, const std::string& detail, const HeaderList& headers, bool keep_alive,
                        bool head_only = false);
/// The head of an event stream (chunked).
std::string stream_head();

}  // namespace vigil
