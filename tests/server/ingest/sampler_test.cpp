// Values without ticks, with a clock that the test turns; values that bring one column of a node each.
#include "server/ingest/sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace vigil::sampler_test {
namespace {

PushedColumns two_channels() {
  PushedColumns columns;
  columns.nodes = {"1", "2"};
  columns.names = {"sensor.1.y", "sensor.1.z", "sensor.2.y", "truth.x"};
  columns.reporter = {0, 0, 1, -1};
  return columns;
}

IngestRow part(std::int64_t k, int column, double value, std::optional<std::uint64_t> seq = {}) {
  return {k, seq, column < 2 ? 0 : 1, {{column, value}}, true};
}

void expect_cells(const std::vector<double>& got, const std::vector<double>& cells) {
  ASSERT_EQ(got.size(), cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (std::isnan(cells[c]))
      EXPECT_TRUE(std::isnan(got[c])) << c;
    else
      EXPECT_EQ(got[c], cells[c]) << c;
  }
}

const double kNone = std::nan("");

TEST(Sampler, ATickHasTheNewestOfWhatCameInIt) {
  const PushedColumns columns = two_channels();
  Sampler sampler(columns, {.dt = 0.5});
  EXPECT_FALSE(sampler.due());
  ASSERT_TRUE(sampler.advance(10));
  sampler.take({part(0, 0, 1)}, 10);
  EXPECT_EQ(sampler.due(), 10.5);
  ASSERT_TRUE(sampler.advance(10.25));
  sampler.take({part(0, 0, 2)}, 10.25);
  sampler.take({part(0, 2, 7)}, 10.3);
  EXPECT_EQ(sampler.closed(), -1);
  ASSERT_TRUE(sampler.advance(11.75));
  EXPECT_EQ(sampler.closed(), 2);
  expect_cells(sampler.pop(), {2, kNone, 7, kNone});
  expect_cells(sampler.pop(), {kNone, kNone, kNone, kNone});
  expect_cells(sampler.pop(), {kNone, kNone, kNone, kNone});
}

TEST(Sampler, AHeldValueStandsForLaterTicksUntilItIsOld) {
  const PushedColumns columns = two_channels();
  Sampler sampler(columns, {.dt = 1, .hold = 1.5});
  sampler.take({part(0, 0, 5)}, 0);
  ASSERT_TRUE(sampler.advance(3));
  expect_cells(sampler.pop(), {5, kNone, kNone, kNone});
  expect_cells(sampler.pop(), {5, kNone, kNone, kNone});
  expect_cells(sampler.pop(), {kNone, kNone, kNone, kNone});
}

TEST(Sampler, ARedeliveredSeqIsADuplicateAndAFullRoomWaits) {
  const PushedColumns columns = two_channels();
  Sampler sampler(columns, {.dt = 1, .room = 2, .last = 3});
  EXPECT_EQ(sampler.take({part(0, 0, 5, 1)}, 0).accepted, 1);
  EXPECT_EQ(sampler.take({part(0, 1, 6, 1)}, 0.1).accepted, 1) << "each column has a count of its own";
  EXPECT_EQ(sampler.take({part(0, 0, 9, 1)}, 0.2).duplicate, 1);
  EXPECT_FALSE(sampler.advance(5));
  EXPECT_EQ(sampler.ready(), 2u);
  expect_cells(sampler.pop(), {5, 6, kNone, kNone});
  sampler.pop();
  EXPECT_TRUE(sampler.advance(5));
  EXPECT_EQ(sampler.closed(), 3) << "the last tick of the run";
  EXPECT_EQ(sampler.take({part(0, 0, 5)}, 5).beyond, 1);
  EXPECT_FALSE(sampler.due());
}

TEST(PartialRows, ATickWaitsForEveryColumnOfANode) {
  const PushedColumns columns = two_channels();
  Assembler assembler(columns, {});
  EXPECT_EQ(assembler.take({part(0, 0, 1), part(0, 2, 3)}, 0).accepted, 2);
  EXPECT_EQ(assembler.closed(), -1);
  EXPECT_EQ(assembler.take({part(0, 0, 99)}, 0).duplicate, 1) << "what it said first, it said";
  EXPECT_EQ(assembler.take({part(0, 1, kNone)}, 0).accepted, 1);
  EXPECT_EQ(assembler.closed(), 0);
  expect_cells(assembler.pop(), {1, kNone, 3, kNone});
  EXPECT_EQ(assembler.take({part(0, 1, 5)}, 0).late, 1);
}

TEST(PartialRows, ADeadlineClosesATickWithTheColumnsThatCame) {
  const PushedColumns columns = two_channels();
  Assembler assembler(columns, {.deadline = 1});
  assembler.take({part(0, 1, 4), part(1, 0, 5)}, 0);
  assembler.expire(1);
  EXPECT_EQ(assembler.closed(), 1);
  expect_cells(assembler.pop(), {kNone, 4, kNone, kNone});
  expect_cells(assembler.pop(), {5, kNone, kNone, kNone});
}

TEST(PartialRows, AWholeRowOfANodeThatHasBegunIsTakenOnce) {
  const PushedColumns columns = two_channels();
  Assembler assembler(columns, {});
  assembler.take({part(0, 0, 1)}, 0);
  EXPECT_EQ(assembler.take({{0, {}, 0, {{0, 2}, {1, 3}}}}, 0).accepted, 1);
  EXPECT_EQ(assembler.take({part(0, 1, 8)}, 0).duplicate, 1);
  assembler.take({part(0, 2, 4)}, 0);
  ASSERT_EQ(assembler.closed(), 0);
  expect_cells(assembler.pop(), {2, 3, 4, kNone});
}

}  // namespace
}  // namespace vigil::sampler_test
