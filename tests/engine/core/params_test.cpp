#include "engine/core/params.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace vigil::params_test {
namespace {

const ParamTable& table() {
  static const ParamTable params(std::vector<Param>{
      {.name = "tau",
       .fallback = 0.01,
       .unit = "cm",
       .minimum = 0,
       .live = true,
       .symbol = "τ",
       .meaning = {"Strength", "强度"}},
      {.name = "rho",
       .fallback = 0.9,
       .minimum = 0,
       .maximum = 1,
       .exclusive_minimum = true,
       .exclusive_maximum = true},
      {.name = "window", .type = ParamType::integer, .fallback = 3, .minimum = 1},
      {.name = "compass", .type = ParamType::boolean, .fallback = false},
      {.name = "guard", .type = ParamType::text, .fallback = "clip", .choices = {"clip", "strict", "none"}},
      {.name = "position", .type = ParamType::vector, .rows = 2, .required = true},
      {.name = "xi", .type = ParamType::vector, .fallback = Json::array({1, 2, 3}), .nullable = true},
      {.name = "R", .type = ParamType::matrix, .fallback = 1, .minimum = 0},
      {.name = "eps", .minimum = 0, .nullable = true}});
  return params;
}

Json good() { return {{"position", {1, 2}}}; }

struct Bad {
  const char* name;
  Json value;
  const char* words;  ///< must stand in the detail
};

class BadParam : public testing::TestWithParam<Bad> {};

TEST_P(BadParam, IsNamedWithValueAndExpectation) {
  Json given = good();
  given[GetParam().name] = GetParam().value;
  std::vector<Problem> problems;
  table().complete(given, "/lanes/a/params", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, std::string("/lanes/a/params/") + GetParam().name);
  EXPECT_NE(problems[0].detail.find(GetParam().words), std::string::npos) << problems[0].detail;
  EXPECT_NE(problems[0].detail.find("expected"), std::string::npos) << problems[0].detail;
  EXPECT_FALSE(problems[0].allowed.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Params, BadParam,
    testing::Values(Bad{"tau", -1, "tau is -1"}, Bad{"tau", "0.1", "tau is \"0.1\""}, Bad{"tau", nullptr, "null"},
                    Bad{"tau", std::nan(""), "nan"}, Bad{"tau", INFINITY, "inf"}, Bad{"tau", true, "true"},
                    Bad{"tau", Json::array({1}), "[1]"}, Bad{"tau", Json::object(), "{}"}, Bad{"rho", 0, "> 0 and < 1"},
                    Bad{"rho", 1, "> 0 and < 1"}, Bad{"window", 0, ">= 1"}, Bad{"window", 1.5, "an integer"},
                    Bad{"window", 1e300, "an integer"}, Bad{"window", 3'000'000'000LL, "an integer"},
                    Bad{"compass", 1, "true or false"}, Bad{"guard", "strikt", "did you mean \"strict\""},
                    Bad{"guard", 3, "one of clip, strict, none"}, Bad{"position", Json::array({1}), "a vector of 2"},
                    Bad{"position", Json::array({1, "a"}), "a vector of 2"}, Bad{"position", 7, "a vector of 2"},
                    Bad{"xi", Json::array(), "a vector"}, Bad{"xi", Json::array({1, INFINITY}), "a vector"},
                    Bad{"R", -1, "a finite matrix"}, Bad{"R", Json::array({1, -1}), ">= 0"},
                    Bad{"R", Json::array({Json::array({1, 2}), Json::array({3})}), "a finite matrix"},
                    Bad{"R", Json::array({Json::array({1}), 2}), "a finite matrix"},
                    Bad{"R", Json::array({Json::array()}), "a finite matrix"}, Bad{"R", "I", "a finite matrix"}));

TEST(Params, FillsInDefaultsInTheTablesOrder) {
  std::vector<Problem> problems;
  const Json given = {{"position", {1, 2}}, {"tau", 5}, {"window", 4.0}};
  const Json done = table().complete(given, "", problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(
      done.dump(),
      R"({"tau":5,"rho":0.9,"window":4,"compass":false,"guard":"clip","position":[1,2],"xi":[1,2,3],"R":1,"eps":null})");
}

TEST(Params, FindsEveryProblemAtOnce) {
  std::vector<Problem> problems;
  table().complete({{"tua", 1}, {"rho", 2}, {"zzzzzzzzz", 1}}, "/p", problems);
  ASSERT_EQ(problems.size(), 4U);
  EXPECT_EQ(problems[0].pointer, "/p/tua");
  EXPECT_EQ(problems[0].allowed, "tau");
  EXPECT_EQ(problems[1].pointer, "/p/zzzzzzzzz");
  EXPECT_NE(problems[1].allowed.find("guard"), std::string::npos);
  EXPECT_EQ(problems[2].pointer, "/p/rho");
  EXPECT_EQ(problems[3].pointer, "/p/position");
}

TEST(Params, RefusesWhatIsNoObject) {
  std::vector<Problem> problems;
  table().complete(Json::array(), "/p", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, "/p");
}

TEST(Params, ReadsValuesByName) {
  std::vector<Problem> problems;
  const Params params(table().complete(good(), "", problems));
  EXPECT_EQ(params.real("tau"), 0.01);
  EXPECT_EQ(params.integer("window"), 3);
  EXPECT_FALSE(params.boolean("compass"));
  EXPECT_EQ(params.text("guard"), "clip");
  EXPECT_EQ(params.vector("xi"), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(params.given("tau"));
  EXPECT_FALSE(params.given("eps"));
  EXPECT_EQ(params.square("R", 2), Eigen::Matrix2d::Identity());
  EXPECT_THROW(params.real("nobody"), std::logic_error);
}

TEST(SquareMatrix, TakesRowsDiagonalOrNumber) {
  Eigen::Matrix2d full;
  full << 1, 2, 3, 4;
  EXPECT_EQ(square_matrix(Json::parse("[[1,2],[3,4]]"), 2, ""), full);
  EXPECT_EQ(square_matrix(Json::parse("[5,6]"), 2, ""), Eigen::Matrix2d(Eigen::Vector2d(5, 6).asDiagonal()));
  EXPECT_EQ(square_matrix(Json(7), 2, ""), Eigen::Matrix2d(7 * Eigen::Matrix2d::Identity()));
}

TEST(SquareMatrix, RefusesWhatDoesNotFit) {
  for (const char* text :
       {"[1,2,3]", "[[1,2],[3]]", "[[1,2]]", "\"I\"", "null", "[[1,2],3]", "[1,[2,3]]", "[[1,\"a\"],[2,3]]", "{}"}) {
    try {
      square_matrix(Json::parse(text), 2, "/noise/Q");
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, "/noise/Q") << text;
    }
  }
  EXPECT_THROW(square_matrix(Json(INFINITY), 2, ""), InputError);
}

TEST(Nearest, FindsTheIntendedWord) {
  const std::vector<std::string> words{"consensus", "centralized", "clean", "tau", "pdos", "pfdi"};
  EXPECT_EQ(nearest("consenus", words), "consensus");
  EXPECT_EQ(nearest("cetnralized", words), "centralized");
  EXPECT_EQ(nearest("tua", words), "tau");
  EXPECT_EQ(nearest("PDOS", words), "pdos");
  EXPECT_EQ(nearest("central", words), "centralized");
  EXPECT_EQ(nearest("xylophone", words), "");
  EXPECT_EQ(nearest("", words), "");
  EXPECT_EQ(nearest("a", {}), "");
  EXPECT_EQ(nearest(std::string(5000, 'c'), words), "");
}

TEST(ParamSchema, CarriesRangesWordsAndUnits) {
  const Json schema = table().schema();
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["required"], Json::array({"position"}));
  const Json& tau = schema["properties"]["tau"];
  EXPECT_EQ(tau["type"], "number");
  EXPECT_EQ(tau["minimum"], 0);
  EXPECT_EQ(tau["default"], 0.01);
  EXPECT_EQ(tau["title"], "Strength");
  EXPECT_EQ(tau["x-zh"], "强度");
  EXPECT_EQ(tau["x-unit"], "cm");
  EXPECT_EQ(tau["x-symbol"], "τ");
  EXPECT_EQ(tau["x-live"], true);
  EXPECT_EQ(schema["properties"]["rho"]["exclusiveMaximum"], 1);
  EXPECT_EQ(schema["properties"]["guard"]["enum"], Json::array({"clip", "strict", "none"}));
  EXPECT_EQ(schema["properties"]["eps"]["type"], Json::array({"number", "null"}));
  EXPECT_EQ(schema["properties"]["position"]["minItems"], 2);
}

TEST(ParamJson, ListsTheDeclaration) {
  const Json list = table().to_json();
  ASSERT_EQ(list.size(), table().all().size());
  EXPECT_EQ(list[1]["name"], "rho");
  EXPECT_EQ(list[1]["maximum"], 1);
  EXPECT_EQ(list[1]["exclusive_maximum"], true);
  EXPECT_TRUE(list[0]["maximum"].is_null());
  EXPECT_EQ(list[0]["meaning"]["zh"], "强度");
  EXPECT_EQ(list[5]["required"], true);
  EXPECT_EQ(list[8]["nullable"], true);
}

}  // namespace
}  // namespace vigil::params_test
