/// Compression of what is sent. Nothing that is received is ever unpacked.
#pragma once

#include <string>
#include <string_view>

namespace vigil {

/// A gzip member holding `body`; empty if it would not be smaller. level: zlib's, 1 to 9.
std::string gzip(std::string_view body, int level);
/// Whether an Accept-Encoding header takes gzip.
bool accepts_gzip(std::string_view accept_encoding);

}  // namespace vigil
