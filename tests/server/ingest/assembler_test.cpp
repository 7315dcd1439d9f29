// Rows into ticks, with a clock that the test turns.
#include "server/ingest/assembler.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/input_error.hpp"

namespace vigil::assembler_test {
namespace {

/// Two nodes with a channel each, and an input.
PushedColumns two_nodes(bool inputs = false) {
  PushedColumns columns;
  columns.nodes = {"1", "2"};
  columns.names = {"sensor.1.y", "sensor.2.y", "truth.x"};
  columns.reporter = {0, 1, -1};
  columns.inputs = inputs;
  return columns;
}

IngestRow of_node(std::int64_t k, int node, double value, std::optional<std::uint64_t> seq = {}) {
  return {k, seq, node, {{node, value}}};
}

IngestRow whole(std::int64_t k, double first, double second) { return {k, {}, -1, {{0, first}, {1, second}}}; }

class AssemblerTest : public ::testing::Test {
 protected:
  void expect_tick(std::vector<double> cells) {
    ASSERT_GT(assembler_.ready(), 0u);
    const std::vector<double> got = assembler_.pop();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (std::isnan(cells[c]))
        EXPECT_TRUE(std::isnan(got[c])) << c;
      else
        EXPECT_EQ(got[c], cells[c]) << c;
    }
  }

  PushedColumns columns_ = two_nodes();
  Assembler assembler_{columns_, {.deadline = 1, .open = 4, .ahead = 10, .advance = 20, .seqs = 3, .last = 40}};
  const double none_ = std::nan("");
};

TEST_F(AssemblerTest, ATickClosesWhenEveryNodeHasReported) {
  Tally tally = assembler_.take({of_node(0, 0, 1)}, 0);
  EXPECT_EQ(tally.accepted, 1);
  EXPECT_EQ(assembler_.closed(), -1);
  EXPECT_EQ(assembler_.open(), std::vector<std::int64_t>{0});
  assembler_.take({of_node(0, 1, 2)}, 0.5);
  EXPECT_EQ(assembler_.closed(), 0);
  expect_tick({1, 2, none_});
  EXPECT_FALSE(assembler_.due());
}

TEST_F(AssemblerTest, ATickClosesAtItsDeadlineWithWhatItHas) {
  assembler_.take({of_node(0, 1, 2)}, 5);
  EXPECT_EQ(assembler_.due(), 6.0);
  assembler_.expire(5.999);
  EXPECT_EQ(assembler_.ready(), 0u);
  assembler_.expire(6);
  expect_tick({none_, 2, none_});
  const Tally tally = assembler_.take({of_node(0, 0, 1)}, 6.1);
  EXPECT_EQ(tally.late, 1);
  EXPECT_EQ(tally.accepted, 0);
  EXPECT_EQ(assembler_.ready(), 0u);
}

TEST_F(AssemblerTest, OutOfOrderRowsWithinTheWindowAreTaken) {
  assembler_.take({whole(2, 21, 22), whole(1, 11, 12)}, 0);
  EXPECT_EQ(assembler_.closed(), -1);
  EXPECT_EQ(assembler_.open(), (std::vector<std::int64_t>{1, 2}));
  assembler_.take({whole(0, 1, 2)}, 0.9);
  EXPECT_EQ(assembler_.closed(), 2);
  expect_tick({1, 2});
  expect_tick({11, 12});
  expect_tick({21, 22});
}

TEST_F(AssemblerTest, AGapClosesTheEarlierTicks) {
  assembler_.take({of_node(0, 0, 1), of_node(6, 0, 7)}, 0);
  EXPECT_EQ(assembler_.closed(), 2);
  EXPECT_EQ(assembler_.ready(), 3u);
  expect_tick({1, none_, none_});
  expect_tick({none_, none_, none_});
  assembler_.expire(1);
  EXPECT_EQ(assembler_.closed(), 6);
}

TEST_F(AssemblerTest, RowsAreTakenOnce) {
  Tally tally = assembler_.take({of_node(0, 0, 1, 7), of_node(0, 0, 9, 8), of_node(1, 0, 9, 7)}, 0);
  EXPECT_EQ(tally.accepted, 1);
  EXPECT_EQ(tally.duplicate, 2) << "the same node's tick, and the same seq";
  tally = assembler_.take({of_node(1, 1, 4, 7)}, 0);
  EXPECT_EQ(tally.accepted, 1) << "another source counts by itself";
  tally = assembler_.take({whole(0, 5, 6), whole(0, 5, 6)}, 0);
  EXPECT_EQ(tally.accepted, 1) << "what was missing of the tick";
  EXPECT_EQ(tally.late, 1);
  expect_tick({1, 6, none_});
}

TEST_F(AssemblerTest, OnlyTheNewestSeqsAreRemembered) {
  assembler_.take({of_node(0, 0, 1, 1), of_node(1, 0, 1, 2), of_node(2, 0, 1, 3), of_node(3, 0, 1, 4)}, 0);
  EXPECT_EQ(assembler_.take({of_node(4, 0, 1, 4)}, 0).duplicate, 1);
  EXPECT_EQ(assembler_.take({of_node(4, 0, 1, 1)}, 0).accepted, 1);
}

TEST_F(AssemblerTest, ARowTooFarAheadIsRefusedWithItsCall) {
  EXPECT_THROW(assembler_.take({whole(0, 1, 2), whole(11, 1, 2)}, 0), InputError);
  EXPECT_EQ(assembler_.closed(), -1);
  std::vector<IngestRow> rows;
  for (std::int64_t k = 0; k <= 21; k += 7) rows.push_back(whole(k, 1, 2));
  EXPECT_THROW(assembler_.take(rows, 0), InputError) << "tick 21 is more than one call may go on";
  rows.pop_back();
  EXPECT_EQ(assembler_.take(rows, 0).accepted, 3);
}

TEST_F(AssemblerTest, RowsAfterTheLastTickAreCounted) {
  const Tally tally = assembler_.take({whole(0, 1, 2), whole(41, 1, 2), whole(1'000'000, 1, 2)}, 0);
  EXPECT_EQ(tally.accepted, 1);
  EXPECT_EQ(tally.beyond, 2);
}

TEST(Assembler, ATickWaitsForTheInputsOfThePlant) {
  const PushedColumns columns = two_nodes(true);
  Assembler assembler(columns, {});
  assembler.take({{0, {}, 0, {{0, 1}}}, {0, {}, 1, {{1, 2}}}}, 0);
  EXPECT_EQ(assembler.closed(), -1);
  assembler.take({{0, {}, -1, {{2, 3}}}}, 0);
  EXPECT_EQ(assembler.closed(), 0);
  EXPECT_EQ(assembler.pop(), (std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace vigil::assembler_test
