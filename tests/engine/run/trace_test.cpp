#include "engine/run/trace.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace vigil::trace_test {
namespace {

TEST(Trace, ReadsAFrameFile) {
  const Trace trace = Trace::from_csv("k,t,truth.x,sensor.1.p\n3,1.5,10,\n4,2,-1e-3,7\n5,2.5,,8.25\n");
  EXPECT_EQ(trace.first_tick(), 3);
  EXPECT_EQ(trace.rows(), 3);
  EXPECT_EQ(trace.dt(), 0.5);
  EXPECT_EQ(trace.columns(), (std::vector<std::string>{"truth.x", "sensor.1.p"}));
  EXPECT_EQ(trace.find("sensor.1.p"), 1);
  EXPECT_EQ(trace.find("k"), -1);
  EXPECT_EQ(trace.at(3, 0), 10);
  EXPECT_TRUE(std::isnan(trace.at(3, 1)));
  EXPECT_EQ(trace.at(4, 0), -1e-3);
  EXPECT_EQ(trace.at(5, 1), 8.25);
}

TEST(Trace, IsMissingOutside) {
  const Trace trace = Trace::from_csv("k,t,a\n3,0,1\n");
  EXPECT_EQ(trace.dt(), 0);
  for (const auto& [k, column] : {std::pair<std::int64_t, int>{2, 0}, {4, 0}, {3, 1}, {3, -1}})
    EXPECT_TRUE(std::isnan(trace.at(k, column)));
}

TEST(Trace, ToleratesHowProgramsWrite) {
  for (const char* text : {"\xEF\xBB\xBFk,t,a\r\n0,0,1\r\n1,1,2\r\n", "\"k\",\"t\",\"a\"\n0,0,1\n1,1,2",
                           "k, t, a\n0 , 0 , 1\n 1,\t1, +2\n\n\r\n", "k,t,a\n0,0,1e0\n1,1,2.000"}) {
    const Trace trace = Trace::from_csv(text);
    EXPECT_EQ(trace.rows(), 2) << text;
    EXPECT_EQ(trace.at(1, trace.find("a")), 2) << text;
  }
  EXPECT_EQ(Trace::from_csv("k,t\n0,0\n1,1\n").columns().size(), 0U);
  EXPECT_EQ(Trace::from_csv("k,t,a\n0,0,1e-400\n").at(0, 0), 0);
}

struct Bad {
  const char* text;
  const char* words;
};

class BadTrace : public testing::TestWithParam<Bad> {};

TEST_P(BadTrace, IsRefusedWithItsPlace) {
  try {
    Trace::from_csv(GetParam().text);
    FAIL() << GetParam().text;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().words), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Trace, BadTrace,
    testing::Values(
        Bad{"", "the trace is empty"}, Bad{"\n\n", "the trace is empty"}, Bad{"k,t,a\n", "no rows"},
        Bad{"k\n0\n", "one column"}, Bad{"t,k,a\n0,0,1\n", "column 1 is \"t\"; expected \"k\""},
        Bad{"k,time,a\n", "column 2 is \"time\"; expected \"t\""},
        Bad{"k,t,a,a\n0,0,1,2\n", "column 4 repeats \"a\" of column 3"}, Bad{"k,t,,b\n0,0,1,2\n", "column 3 is \"\""},
        Bad{"k,t,a b\n0,0,1\n", "column 3 is \"a b\""}, Bad{"k,t,\xff\n0,0,1\n", "column 3"},
        Bad{"k,t,a,b\n0,0,1,2\n1,1,3\n", "line 3: the row has 3 cells; expected the header's 4"},
        Bad{"k,t,a\n0,0,1,2\n", "line 2: the row has more"},
        Bad{"k,t,a\n0,0,1\n\n1,1,2\n", "line 3: the line is empty"},
        Bad{"k,t,a\n0,0,x\n", "line 2: column 3 (a) is \"x\"; expected a number"}, Bad{"k,t,a\n0,0,1x\n", "\"1x\""},
        Bad{"k,t,a\n0,0,nan\n", "expected a finite number"}, Bad{"k,t,a\n0,0,-inf\n", "expected a finite number"},
        Bad{"k,t,a\n0,0,1e999\n", "expected a finite number"}, Bad{"k,t,a\n0,0,0x10\n", "\"0x10\""},
        Bad{"k,t,a\n0,0,+-1\n", "\"+-1\""}, Bad{"k,t,a\n0.5,0,1\n", "column 1 (k) is \"0.5\""},
        Bad{"k,t,a\n-1,0,1\n", "expected a tick"}, Bad{"k,t,a\n,0,1\n", "expected a tick"},
        Bad{"k,t,a\n0,0,1\n2,1,1\n", "line 3: column 1 (k) is 2; expected 1"},
        Bad{"k,t,a\n0,0,1\n0,1,1\n", "is 0; expected 1"}, Bad{"k,t,a\n99999999999999999999,0,1\n", "expected a tick"},
        Bad{"k,t,a\n0,,1\n", "column 2 (t) is empty"}, Bad{"k,t,a\n0,0,1\n1,0,1\n", "expected more than the row above"},
        Bad{"k,t,a\n0,0,1\n1,1,1\n2,5,1\n3,6,1\n", "evenly spaced"}));

TEST(Trace, LimitsItsSize) {
  EXPECT_NO_THROW(Trace::from_csv("k,t,a,b\n0,0,1,2\n1,1,3,4\n", 4));
  EXPECT_THROW(Trace::from_csv("k,t,a,b\n0,0,1,2\n1,1,3,4\n", 3), InputError);
  std::string wide = "k,t";
  for (int n = 0; n < 100'001; ++n) wide += ",c" + std::to_string(n);
  EXPECT_THROW(Trace::from_csv(wide + "\n"), InputError);
  EXPECT_THROW(Trace::from_csv("k,t," + std::string(257, 'a') + "\n0,0,1\n"), InputError);
}

TEST(Trace, ReadsALongFile) {
  std::string text = "k,t";
  for (int column = 0; column < 60; ++column) text += ",c" + std::to_string(column);
  for (int row = 0; row < 13'000; ++row) {
    text += "\n" + std::to_string(row) + "," + std::to_string(row * 0.5);
    for (int column = 0; column < 60; ++column)
      text += column % 3 == 0 ? "," : "," + std::to_string(row + column) + ".125";
  }
  const Trace trace = Trace::from_csv(text);
  EXPECT_EQ(trace.rows(), 13'000);
  EXPECT_EQ(trace.at(12'999, 59), 13'058.125);
  EXPECT_TRUE(std::isnan(trace.at(500, 0)));
}

}  // namespace
}  // namespace vigil::trace_test
