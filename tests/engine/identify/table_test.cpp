#include "engine/identify/table.hpp"

#include <cmath>

#include "engine/core/input_error.hpp"

namespace vigil::identify::table_test {
namespace {

void expect_refused(std::string_view text, const std::vector<std::string>& columns, const std::string& words) {
  try {
    read_table(text, columns);
    ADD_FAILURE() << "expected: " << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Table, ReadsWhatIsAskedForHoweverItIsWritten) {
  const Table table =
      read_table("\xEF\xBB\xBFWHEN, L_T1 ,\"a, b\",FLAG\r\n04/07/16 00, 2.5,+1,-999\r\n\"x, y\",,\" -3e2 \",1\r\n",
                 {"FLAG", "a, b", "L_T1"});
  ASSERT_EQ(table.values.rows(), 2);
  EXPECT_EQ(table.values(0, 0), -999);
  EXPECT_EQ(table.values(0, 1), 1);
  EXPECT_EQ(table.values(0, 2), 2.5);
  EXPECT_EQ(table.values(1, 1), -300);
  EXPECT_TRUE(std::isnan(table.values(1, 2))) << "an empty cell is missing";
}

TEST(Table, NamesLineAndColumn) {
  expect_refused("", {"a"}, "empty");
  expect_refused("a,b\n", {"a"}, "no row");
  expect_refused("a,b\n1,2\n3,four\n", {"b"}, "line 3: column 2 (b) is \"four\"");
  expect_refused("a,b\n1,inf\n", {"b"}, "line 2: column 2 (b)");
  expect_refused("a,b\n1,nan\n", {"b"}, "line 2: column 2 (b)");
  expect_refused("a,b\n1,-1e101\n", {"b"}, "line 2: column 2 (b)");
  expect_refused("a,b\n1,1e999\n", {"b"}, "line 2: column 2 (b)");
  expect_refused("a,b\n1,2\n1\n", {"b"}, "line 3: the row has 1 cells");
  expect_refused("a,b\n1,2\n\n1,2\n", {"b"}, "line 3");
  expect_refused("level1,level2\n1,2\n", {"levl1"}, "the nearest is \"level1\"");
  expect_refused("a,b,a\n1,2,3\n", {"a"}, "repeats");
  EXPECT_NO_THROW(read_table("a,b,a\n1,2,3\n", {"b"})) << "what is not asked for may be there twice";
  EXPECT_THROW(read_table("a\n1\n2\n3\n", {"a"}, 2), InputError);
}

TEST(Table, ChoosesByPattern) {
  const std::vector<std::string> header{"T", "L_1", "F_1", "L_2", "S_1"};
  EXPECT_EQ(chosen_columns(header, {"L_*"}), (std::vector<std::string>{"L_1", "L_2"}));
  EXPECT_EQ(chosen_columns(header, {"*_1", "L_*"}), (std::vector<std::string>{"L_1", "F_1", "S_1", "L_2"}));
  EXPECT_EQ(chosen_columns(header, {"T"}), (std::vector<std::string>{"T"}));
  EXPECT_THROW(chosen_columns(header, {"P_*"}), InputError);
}

}  // namespace
}  // namespace vigil::identify::table_test
