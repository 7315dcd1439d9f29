/// Bytes made smaller for the way through a broker, with a checksum.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vigil {

/// zstd, one of its fastest levels, with its checksum.
std::string pack(std::string_view bytes);
/// Throws std::runtime_error where the bytes are damaged, or hold more than `most`.
std::string unpack(std::string_view packed, std::size_t most);

}  // namespace vigil
