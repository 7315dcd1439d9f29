#include "db/chunk.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>

namespace vigil {

static_assert(std::endian::native == std::endian::little, "chunks hold doubles as they lie in memory");

namespace {

constexpr std::size_t kHead = 5;
constexpr char kRaw = 0, kZstd = 1, kConstant = 2;

using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr CrcTables make_tables() {
  CrcTables tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1u) ? 0xedb88320u : 0u);
    tables[0][i] = value;
  }
  for (std::size_t t = 1; t < 8; ++t) {
    for (std::size_t i = 0; i < 256; ++i) {
      tables[t][i] = (tables[t - 1][i] >> 8) ^ tables[0][tables[t - 1][i] & 0xffu];
    }
  }
  return tables;
}
constexpr CrcTables kTables = make_tables();

struct FreeEncoder {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};
struct FreeDecoder {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

ZSTD_CCtx* encoder() {
  thread_local const std::unique_ptr<ZSTD_CCtx, FreeEncoder> context(ZSTD_createCCtx());
  return context.get();
}

ZSTD_DCtx* decoder() {
  thread_local const std::unique_ptr<ZSTD_DCtx, FreeDecoder> context(ZSTD_createDCtx());
  return context.get();
}

std::uint32_t checksum(char codec, std::size_t count, std::string_view payload) {
  char head[5] = {codec};
  const auto count32 = static_cast<std::uint32_t>(count);
  std::memcpy(head + 1, &count32, 4);
  return crc32(payload, crc32(std::string_view(head, 5)));
}

bool constant(std::span<const double> values) {
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  return values.size() > 1 && std::memcmp(bytes, bytes + sizeof(double), (values.size() - 1) * sizeof(double)) == 0;
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  std::uint32_t crc = ~before;
  const char* p = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= 8; left -= 8, p += 8) {
    std::uint32_t low = 0, high = 0;
    std::memcpy(&low, p, 4);
    std::memcpy(&high, p + 4, 4);
    low ^= crc;
    crc = kTables[7][low & 0xff] ^ kTables[6][(low >> 8) & 0xff] ^ kTables[5][(low >> 16) & 0xff] ^
          kTables[4][low >> 24] ^ kTables[3][high & 0xff] ^ kTables[2][(high >> 8) & 0xff] ^
          kTables[1][(high >> 16) & 0xff] ^ kTables[0][high >> 24];
  }
  for (; left > 0; --left, ++p) crc = (crc >> 8) ^ kTables[0][(crc ^ static_cast<unsigned char>(*p)) & 0xff];
  return ~crc;
}

std::string encode_chunk(std::span<const double> values) {
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  const std::size_t size = values.size_bytes();
  thread_local std::string out;
  out.resize(kHead + std::max(size, ZSTD_compressBound(size)));
  char codec = kRaw;
  std::size_t payload = size;
  if (constant(values)) {
    codec = kConstant;
    payload = sizeof(double);
    std::memcpy(out.data() + kHead, bytes, payload);
  } else {
    const std::size_t packed = ZSTD_compressCCtx(encoder(), out.data() + kHead, out.size() - kHead, bytes, size, 1);
    if (!ZSTD_isError(packed) && packed < size) {
      codec = kZstd;
      payload = packed;
    } else if (size > 0) {
      std::memcpy(out.data() + kHead, bytes, size);
    }
  }
  out[0] = codec;
  const std::uint32_t crc = checksum(codec, values.size(), std::string_view(out).substr(kHead, payload));
  std::memcpy(out.data() + 1, &crc, 4);
  return std::string(out.data(), kHead + payload);
}

void decode_chunk(std::string_view chunk, std::span<double> values) {
  if (chunk.size() < kHead) throw ChunkError("a chunk of " + std::to_string(chunk.size()) + " bytes is too short");
  const char codec = chunk[0];
  const std::string_view payload = chunk.substr(kHead);
  std::uint32_t stored = 0;
  std::memcpy(&stored, chunk.data() + 1, 4);
  if (stored != checksum(codec, values.size(), payload)) throw ChunkError("a chunk's CRC does not match its bytes");
  const std::size_t size = values.size_bytes();
  if (codec == kRaw && payload.size() == size) {
    if (size > 0) std::memcpy(values.data(), payload.data(), size);
  } else if (codec == kConstant && payload.size() == sizeof(double)) {
    for (auto& value : values) std::memcpy(&value, payload.data(), sizeof(double));
  } else if (codec == kZstd) {
    const std::size_t got = ZSTD_decompressDCtx(decoder(), values.data(), size, payload.data(), payload.size());
    if (ZSTD_isError(got) || got != size) throw ChunkError("a chunk does not decompress to its size");
  } else {
    throw ChunkError("a chunk has the unknown codec " + std::to_string(static_cast<int>(codec)));
  }
}

std::string compress_text(std::string_view text) {
  std::string out(ZSTD_compressBound(text.size()), '\0');
  const std::size_t size = ZSTD_compressCCtx(encoder(), out.data(), out.size(), text.data(), text.size(), 3);
  if (ZSTD_isError(size)) throw ChunkError("a text does not compress");
  out.resize(size);
  return out;
}

std::string decompress_text(std::string_view bytes) {
  const auto size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > (1ull << 30)) {
    throw ChunkError("a compressed text is damaged");
  }
  std::string out(size, '\0');
  const std::size_t got = ZSTD_decompressDCtx(decoder(), out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(got) || got != size) throw ChunkError("a compressed text is damaged");
  return out;
}

}  // namespace vigil
