/// Gains in the log: by the problem they answer, and with the run that was made with them.
#include "tests/db/helpers.hpp"

namespace vigil::design_test {
namespace {

using Designs = test::ClockedLog;

std::string key_of(int number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016d", number);
  return text;
}

TEST_F(Designs, AreFoundByTheirKeyAlsoByTheNextServer) {
  const Json record{{"holds", true}, {"L", {{{0.1, 1e-300}, {-1.0 / 3, 12345678.9}}}}};
  const std::string problem(100'000, '7');
  writer.put_design(key_of(1), "fast", record, problem);
  writer.put_design(key_of(2), "ref", {{"holds", false}}, "");
  for (int life = 0; life < 2; ++life) {
    const LogReader again(path());
    const auto row = again.design(key_of(1));
    ASSERT_TRUE(row);
    EXPECT_EQ(key_of(1), row->key);
    EXPECT_EQ("fast", row->lane);
    EXPECT_EQ(record, row->record);
    EXPECT_EQ(clock, row->created);
    EXPECT_EQ(problem, again.design_problem(key_of(1)));
    EXPECT_EQ("", again.design_problem(key_of(2)));
    EXPECT_FALSE(again.design(key_of(3)));
    EXPECT_FALSE(again.design_problem(key_of(3)));
  }
  writer.put_design(key_of(1), "other", {{"holds", false}}, "new");
  EXPECT_EQ("other", reader.design(key_of(1))->lane);
  EXPECT_EQ("new", reader.design_problem(key_of(1)));
}

TEST_F(Designs, TheOldestGoFirst) {
  for (int number = 0; number < 510; ++number) {
    clock += test::kSecond;
    writer.put_design(key_of(number), "a", {{"number", number}}, "x");
  }
  for (int number = 0; number < 510; ++number) EXPECT_EQ(number >= 10, reader.design(key_of(number)).has_value());
}

TEST_F(Designs, BelongToTheirRun) {
  RunRecord known = test::record();
  known.designs = {{"fast", {{"key", key_of(1)}}}};
  const RunId with = writer.create_run(known).id;
  const RunId without = writer.create_run(test::record()).id;
  EXPECT_EQ(known.designs, reader.run(with)->designs);
  EXPECT_TRUE(reader.run(without)->designs.is_null());
  RunUpdate found;
  found.designs = {{"ref", {{"key", key_of(2)}}}};
  writer.update(without, found);
  EXPECT_EQ(*found.designs, reader.run(without)->designs);
  EXPECT_EQ(known.designs, reader.run(with)->designs);
}

}  // namespace
}  // namespace vigil::design_test
