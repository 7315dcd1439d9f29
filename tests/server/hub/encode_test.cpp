#include "server/hub/encode.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace vigil::encode_test {
namespace {

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

TEST(Encode, NumbersHaveSixDigits) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(1), "1");
  EXPECT_EQ(number(-3), "-3");
  EXPECT_EQ(number(999999), "999999");
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(1.0 / 3), "0.333333");
  EXPECT_EQ(number(123456.7), "123457");
  EXPECT_EQ(number(std::nan("")), "null");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(number(-std::numeric_limits<double>::infinity()), "null");
}

TEST(Encode, EveryNumberIsJsonAndNear) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int i = 0; i < 20'000; ++i) {
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    const double back = Json::parse(number(value)).get<double>();
    EXPECT_LE(std::abs(back - value), 5.1e-6 * std::abs(value)) << value;
  }
}

TEST(Encode, ChunksSayTheirSize) {
  EXPECT_EQ(as_chunk("0123456789abcdefg"), "11\r\n0123456789abcdefg\r\n");
  EXPECT_EQ(*encode_event("ping", "{}"), "16\r\nevent: ping\ndata: {}\n\n\r\n");
}

}  // namespace
}  // namespace vigil::encode_test
