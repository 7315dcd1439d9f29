/// The codec of one chunk: the values of one signal in one block.
///
///   byte 0      codec: 0 raw, 1 zstd, 2 constant (one value stands for all)
///   bytes 1..4  CRC-32 (IEEE, little endian) of codec byte, count (4 bytes, little endian) and payload
///   rest        payload: doubles as they lie in memory, little endian
///
/// Bit exact for every double, NaN payloads included.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vigil {

/// The bytes are not a chunk of the size asked for.
class ChunkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

std::string encode_chunk(std::span<const double> values);
/// Fills `values`, whose size is the count that was encoded. Throws ChunkError.
void decode_chunk(std::string_view chunk, std::span<double> values);

/// Text of any size through zstd level 3 and back, for documents stored whole. Throws ChunkError on damage or above 1
/// GiB.
std::string compress_text(std::string_view text);
std::string decompress_text(std::string_view bytes);

std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

}  // namespace vigil
