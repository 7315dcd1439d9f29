#include "engine/run/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "engine/core/input_error.hpp"
#include "engine/run/frame_csv.hpp"
#include "engine/run/trace.hpp"

namespace vigil::frame_test {
namespace {

TEST(Catalogue, NumbersSignalsInOrder) {
  Catalogue catalogue;
  EXPECT_EQ(catalogue.add({.name = "truth.x", .unit = "cm"}), 0);
  EXPECT_EQ(catalogue.add({.name = "truth.y", .unit = "cm"}), 1);
  EXPECT_EQ(catalogue.find("truth.y"), 1);
  EXPECT_EQ(catalogue.find("truth.z"), -1);
  EXPECT_EQ(catalogue[1].name, "truth.y");
  EXPECT_EQ(catalogue.size(), 2);
  EXPECT_THROW(catalogue.add({.name = "truth.x"}), std::logic_error);
  EXPECT_EQ(catalogue.size(), 2);
}

TEST(Signal, IsWrittenForTheContract) {
  Signal signal{.id = 3,
                .name = "link.1-2.state",
                .kind = SignalKind::category,
                .link = "1-2",
                .labels = {{0, "clean"}, {1, "DoS"}}};
  EXPECT_EQ(
      to_json(signal).dump(),
      R"({"id":3,"name":"link.1-2.state","unit":"","kind":"category","lane":null,"node":null,"link":"1-2","labels":{"0":"clean","1":"DoS"}})");
  EXPECT_EQ(to_json(Signal{.name = "b", .kind = SignalKind::boolean})["kind"], "bool");
}

TEST(Mark, ComesBackFromJson) {
  const Mark mark{.k = 12,
                  .type = MarkType::attack,
                  .edge = MarkEdge::end,
                  .id = "a1",
                  .lane = "l",
                  .node = "2",
                  .link = "1-2",
                  .code = "dos",
                  .detail = "d"};
  const Mark back = mark_from_json(to_json(mark));
  EXPECT_EQ(to_json(back), to_json(mark));
  EXPECT_EQ(to_json(Mark{.k = 1}).dump(), R"({"k":1,"type":"note","edge":null})");
  for (const auto type :
       {MarkType::attack, MarkType::alarm, MarkType::fault, MarkType::command, MarkType::state, MarkType::note}) {
    EXPECT_EQ(mark_from_json(to_json(Mark{.type = type})).type, type);
  }
}

TEST(Mark, RefusesWhatIsNone) {
  const std::pair<const char*, const char*> bad[] = {{"[]", ""},
                                                     {"null", ""},
                                                     {R"({"type":"note"})", "/k"},
                                                     {R"({"k":1.5,"type":"note"})", "/k"},
                                                     {R"({"k":1})", "/type"},
                                                     {R"({"k":1,"type":"party"})", "/type"},
                                                     {R"({"k":1,"type":"note","edge":"middle"})", "/edge"},
                                                     {R"({"k":1,"type":"note","edge":0})", "/edge"},
                                                     {R"({"k":1,"type":"note","lane":7})", "/lane"}};
  for (const auto& [text, pointer] : bad) {
    try {
      mark_from_json(Json::parse(text));
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, pointer) << text;
    }
  }
}

TEST(FrameCsv, ReadsBackToTheSameBits) {
  Catalogue catalogue;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g"}) catalogue.add({.name = name});
  const std::vector<double> values{0.1 + 0.2,
                                   -0.0,
                                   std::numeric_limits<double>::denorm_min(),
                                   std::numeric_limits<double>::max(),
                                   -1.0 / 3.0,
                                   std::nan(""),
                                   123456789012345680.0};
  std::string text = csv_header(catalogue);
  append_csv_row(text, {.k = 0, .t = 0, .values = values});
  append_csv_row(text, {.k = 1, .t = 0.1, .values = {1, 2, 3, 4, 5, INFINITY, -INFINITY}});
  EXPECT_EQ(text.substr(0, 18), "k,t,a,b,c,d,e,f,g\n");
  EXPECT_NE(text.find("\n1,0.1,1,2,3,4,5,,\n"), std::string::npos) << text;
  const Trace trace = Trace::from_csv(text);
  for (int column = 0; column < 7; ++column) {
    const double read = trace.at(0, column), wrote = values[static_cast<std::size_t>(column)];
    if (std::isnan(wrote)) {
      EXPECT_TRUE(std::isnan(read));
    } else {
      EXPECT_EQ(std::memcmp(&read, &wrote, sizeof read), 0) << column;
    }
  }
}

}  // namespace
}  // namespace vigil::frame_test
