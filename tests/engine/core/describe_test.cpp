#include "engine/core/describe.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/core/input_error.hpp"

namespace vigil::describe_test {
namespace {

TEST(InputError, SaysFieldAndHowManyMore) {
  EXPECT_STREQ(InputError("/time/dt", "dt is 0; expected a number > 0").what(),
               "/time/dt: dt is 0; expected a number > 0");
  EXPECT_STREQ(InputError("", "the document is 3; expected an object").what(), "the document is 3; expected an object");
  const std::vector<Problem> three{{"/a", "one", ""}, {"/b", "two", ""}, {"/c", "three", ""}};
  EXPECT_STREQ(InputError(three).what(), "/a: one (and 2 more problems)");
  EXPECT_STREQ(InputError(std::vector<Problem>{}).what(), "the input is not valid");
}

TEST(Describe, NeverWritesMuchOrBrokenText) {
  EXPECT_EQ(shown(Json(0.1)), "0.1");
  EXPECT_EQ(shown(Json(std::numeric_limits<double>::infinity())), "inf");
  EXPECT_EQ(shown(Json::array({1, 2})), "[1,2]");
  EXPECT_EQ(shown(Json::parse("[[1,0],[0,1]]")), "[[1,0],[0,1]]");
  EXPECT_EQ(shown(Json::parse("[[[[1]]]]")), "an array of 1");
  EXPECT_EQ(shown(Json(std::vector<int>(100, 1))), "an array of 100");
  EXPECT_EQ(shown(Json::parse("{\"a\":1}")), "an object");
  EXPECT_LT(shown(Json(std::string(5000, 'x'))).size(), 80U);
  EXPECT_TRUE(is_utf8(shown(Json("\xff\xfe"))));
  EXPECT_TRUE(is_utf8(in_quotes("\xc3\x28")));
  std::string chinese;
  for (int n = 0; n < 100; ++n) chinese += "中";
  EXPECT_TRUE(is_utf8(shown(Json(chinese))));
  EXPECT_TRUE(is_utf8(in_quotes(chinese)));
  EXPECT_TRUE(is_utf8(child("", chinese)));
  EXPECT_TRUE(is_utf8(child("", "\xff")));
}

TEST(Describe, EscapesPointers) {
  EXPECT_EQ(child("/lanes", "a/b~c"), "/lanes/a~1b~0c");
  EXPECT_EQ(child("/edges", std::size_t{3}), "/edges/3");
}

TEST(Describe, KnowsUtf8) {
  for (const char* good : {"", "abc", "ü", "中文", "😀"}) EXPECT_TRUE(is_utf8(good)) << good;
  for (const char* bad : {"\x80", "\xc0\xaf", "\xe4\xb8", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff", "\xe0\x80\x80"}) {
    EXPECT_FALSE(is_utf8(bad));
  }
}

}  // namespace
}  // namespace vigil::describe_test
