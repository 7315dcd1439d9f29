#include "db/chunk.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "tests/db/helpers.hpp"

namespace vigil::chunk_test {
namespace {

std::vector<double> round_trip(const std::vector<double>& values) {
  std::vector<double> back(values.size(), 42.0);
  decode_chunk(encode_chunk(values), back);
  return back;
}

void expect_bits(const std::vector<double>& values) {
  const auto back = round_trip(values);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(test::bits(values[i]), test::bits(back[i])) << i;
}

TEST(Chunk, KnownChecksum) {
  EXPECT_EQ(0xcbf43926u, crc32("123456789"));
  EXPECT_EQ(crc32("123456789"), crc32("6789", crc32("12345")));
  EXPECT_EQ("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad", sha256_hex("abc"));
  EXPECT_EQ("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855", sha256_hex(""));
  EXPECT_EQ("248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1",
            sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"));
}

TEST(Chunk, EverySpecialDoubleComesBackBitForBit) {
  double odd_nan = 0;
  const std::uint64_t payload = 0xfff8dead0000beefull;
  std::memcpy(&odd_nan, &payload, sizeof odd_nan);
  const double inf = std::numeric_limits<double>::infinity();
  expect_bits({0.0, -0.0, std::nan(""), odd_nan, inf, -inf, std::numeric_limits<double>::denorm_min(),
               std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), 1.0 / 3.0});
  expect_bits({});
  expect_bits({odd_nan});
  expect_bits(std::vector<double>(512, odd_nan));
}

TEST(Chunk, ChoosesTheSmallestCodec) {
  std::mt19937_64 random(3);
  std::vector<double> noise(512), steps(512);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const std::uint64_t word = random();
    std::memcpy(&noise[i], &word, sizeof word);
    steps[i] = static_cast<double>(i / 100);
  }
  EXPECT_EQ(0, encode_chunk(noise)[0]);
  EXPECT_EQ(5u + 8u * 512u, encode_chunk(noise).size());
  EXPECT_EQ(1, encode_chunk(steps)[0]);
  EXPECT_LT(encode_chunk(steps).size(), 400u);
  EXPECT_EQ(2, encode_chunk(std::vector<double>(512, 7.5))[0]);
  EXPECT_EQ(13u, encode_chunk(std::vector<double>(512, 7.5)).size());
  expect_bits(noise);
  expect_bits(steps);
}

TEST(Chunk, EveryFlippedBitIsRefused) {
  std::vector<double> values(64), back(64);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
  for (const auto& column : {values, std::vector<double>(64, 1.0), std::vector<double>{0, 1}}) {
    const std::string chunk = encode_chunk(column);
    back.resize(column.size());
    for (std::size_t bit = 0; bit < chunk.size() * 8; ++bit) {
      std::string broken = chunk;
      broken[bit / 8] = static_cast<char>(broken[bit / 8] ^ (1 << (bit % 8)));
      EXPECT_THROW(decode_chunk(broken, back), ChunkError) << "bit " << bit;
    }
    for (std::size_t size = 0; size < chunk.size(); ++size) {
      EXPECT_THROW(decode_chunk(std::string_view(chunk).substr(0, size), back), ChunkError);
    }
    std::vector<double> other(column.size() + 1);
    EXPECT_THROW(decode_chunk(chunk, other), ChunkError);
  }
}

TEST(Chunk, TextsComeBackAndDamageIsRefused) {
  std::string csv = "k,t,a\n";
  for (int i = 0; i < 5000; ++i) csv += std::to_string(i) + "," + std::to_string(i * 0.1) + ",1\n";
  std::string packed = compress_text(csv);
  EXPECT_LT(packed.size(), csv.size() / 3);
  EXPECT_EQ(csv, decompress_text(packed));
  EXPECT_EQ("", decompress_text(compress_text("")));
  EXPECT_THROW(decompress_text(packed.substr(0, packed.size() / 2)), ChunkError);
  EXPECT_THROW(decompress_text("nonsense"), ChunkError);
}

}  // namespace
}  // namespace vigil::chunk_test
