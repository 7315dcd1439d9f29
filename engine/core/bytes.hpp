/// Numbers as bytes and back, little endian, every bit kept: what an accumulator is stored as.
#pragma once

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace vigil {

class ByteWriter {
 public:
  void word(std::uint64_t value) {
    char bytes[8];
    for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(value >> (8 * i) & 0xff);
    text_.append(bytes, 8);
  }
  void number(double value) { word(std::bit_cast<std::uint64_t>(value)); }
  void integer(std::int64_t value) { word(std::bit_cast<std::uint64_t>(value)); }
  void text(std::string_view value) {
    word(value.size());
    text_ += value;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Throws std::runtime_error where the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}
  std::uint64_t word() {
    const std::string_view part = next(8);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 8; ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(part[i])) << (8 * i);
    return value;
  }
  double number() { return std::bit_cast<double>(word()); }
  std::int64_t integer() { return std::bit_cast<std::int64_t>(word()); }
  std::string text() { return std::string(next(word())); }
  /// How many items follow, each of at least `size` bytes: no more than there is room for.
  std::size_t count(std::size_t size) {
    const std::uint64_t items = word();
    if (items > left_.size() / size) fail();
    return items;
  }
  bool done() const { return left_.empty(); }

 private:
  [[noreturn]] static void fail() { throw std::runtime_error("Saved numbers are cut off."); }
  std::string_view next(std::uint64_t size) {
    if (size > left_.size()) fail();
    const std::string_view part = left_.substr(0, size);
    left_.remove_prefix(size);
    return part;
  }
  std::string_view left_;
};

}  // namespace vigil
