/// Every bad document is refused at the exact place, with what was expected.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/scenario/scenario.hpp"

namespace vigil::problems_test {
namespace {

struct Bad {
  const char* pointer;             ///< of the problem
  const char* change;              ///< JSON pointer of what is replaced
  const char* value;               ///< JSON text; "" removes
  const char* words = "expected";  ///< must stand in the detail
};

Json changed(const Bad& bad) {
  Json document = Scenario::preset("consensus").document();
  const Json::json_pointer place(bad.change);
  if (std::string(bad.value).empty()) {
    document[place.parent_pointer()].erase(place.back());
  } else {
    document[place] = Json::parse(bad.value);
  }
  return document;
}

class BadDocument : public testing::TestWithParam<Bad> {};

TEST_P(BadDocument, NamesTheField) {
  try {
    Scenario::from_json(changed(GetParam()));
    FAIL() << GetParam().change << " = " << GetParam().value;
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U) << error.what();
    EXPECT_EQ(error.problems().front().pointer, GetParam().pointer) << error.what();
    EXPECT_NE(error.problems().front().detail.find(GetParam().words), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Head, BadDocument,
    testing::Values(Bad{"/vigil", "/vigil", "2"}, Bad{"/vigil", "/vigil", ""}, Bad{"/id", "/id", ""},
                    Bad{"/id", "/id", "\"Big\""}, Bad{"/id", "/id", "\"-a\""}, Bad{"/id", "/id", "7"},
                    Bad{"/id", "/id", "\"\""}, Bad{"/title", "/title", "7"}, Bad{"/title/en", "/title/en", "7"},
                    Bad{"/title/fr", "/title/fr", "\"t\"", "not a key"}, Bad{"/source", "/source", "[]"},
                    Bad{"/family", "/family", "\"consenus\"", "did you mean \"consensus\""},
                    Bad{"/lames", "/lames", "{}", "did you mean \"lanes\""}, Bad{"/time", "/time", "3"},
                    Bad{"/time/dt", "/time/dt", "0"}, Bad{"/time/dt", "/time/dt", "-1"},
                    Bad{"/time/dt", "/time/dt", "null"}, Bad{"/time/dt", "/time/dt", "\"1\""},
                    Bad{"/time/steps", "/time/steps", "0"}, Bad{"/time/steps", "/time/steps", "1.5"},
                    Bad{"/time/stepz", "/time/stepz", "1", "did you mean \"steps\""},
                    Bad{"/reproducible", "/reproducible", "1"}, Bad{"/view", "/view", "[]"},
                    Bad{"/controller/type", "/controller/type", "\"pid\""}, Bad{"/profile", "/profile", "1"}));

INSTANTIATE_TEST_SUITE_P(
    World, BadDocument,
    testing::Values(
        Bad{"/plant", "/plant", ""}, Bad{"/plant", "/plant", "[]"},
        Bad{"/plant/type", "/plant/type", "\"unicycle_weels\"", "did you mean \"unicycle_wheels\""},
        Bad{"/plant/type", "/plant/type", ""}, Bad{"/plant/params/b", "/plant/params/b", "0"},
        Bad{"/plant/params/sX", "/plant/params/sX", "1", "did you mean"}, Bad{"/plant/params", "/plant/params", "[]"},
        Bad{"/nodes", "/nodes", "[]"}, Bad{"/nodes/a-b", "/nodes/a-b", "{}", "no node id"},
        Bad{"/nodes/fused", "/nodes/fused", "{}", "meaning of its own"}, Bad{"/nodes/3/sensor", "/nodes/3/sensor", ""},
        Bad{"/nodes/3/sensor/type", "/nodes/3/sensor/type", "\"lidar\""},
        Bad{"/nodes/3/sensor/params/position", "/nodes/3/sensor/params/position", "", "position is missing"},
        Bad{"/nodes/3/sensor/params/position", "/nodes/3/sensor/params/position", "[1,2,3]"},
        Bad{"/nodes/3/sensor/params/z", "/nodes/3/sensor/params/z", "0"},
        Bad{"/nodes/3/name", "/nodes/3/name", "1", "not a key"}, Bad{"/network", "/network", "\"ring\""},
        Bad{"/network/graph", "/network/graph", "\"rink\"", "did you mean \"ring\""},
        Bad{"/network/graph", "/network/graph", "\"knn8\""}, Bad{"/network/graph", "/network/graph", "\"radius-1\""},
        Bad{"/network/graph", "/network/graph", "3"}, Bad{"/network/edges", "/network/graph", "\"edges\"", "missing"},
        Bad{"/network/edges", "/network/edges", "3"}, Bad{"/network/edges/1", "/network/edges", "[[1,2],[1]]"},
        Bad{"/network/edges/1/1", "/network/edges", "[[1,2],[1,9]]", "node 9"},
        Bad{"/network/edges/0", "/network/edges", "[[2,2]]", "itself"},
        Bad{"/network/edges/0/0", "/network/edges", "[[1.5,2]]"}));

INSTANTIATE_TEST_SUITE_P(
    Noise, BadDocument,
    testing::Values(Bad{"/noise/Q", "/noise/Q", "[1,1]"}, Bad{"/noise/Q", "/noise/Q", "[1,1,-1]"},
                    Bad{"/noise/Q", "/noise/Q", "-1"}, Bad{"/noise/Q", "/noise/Q", "\"I\""},
                    Bad{"/noise/Q", "/noise/Q", "[[1,0,0],[0,1,0],[0,0.5,1]]", "symmetric"},
                    Bad{"/noise/P0", "/noise/P0", "[[1,0,0],[0,1,2],[0,2,1]]", "negative eigenvalue"},
                    Bad{"/noise/P0", "/noise/P0", "[[1,0],[0,1]]"}, Bad{"/noise/R", "/noise/R", "1", "not a key"},
                    Bad{"/noise", "/noise", "1"}, Bad{"/initial/truth", "/initial/truth", "[1,2]"},
                    Bad{"/initial/truth", "/initial/truth", "\"origin\""},
                    Bad{"/initial/estimates", "/initial/estimates", "\"true\""},
                    Bad{"/initial/estimates/9", "/initial/estimates", "{\"9\":[1,2,3]}", "not a key"},
                    Bad{"/initial/estimates/1", "/initial/estimates", "{\"1\":[1,2]}"},
                    Bad{"/initial/x", "/initial/x", "1", "not a key"}));

INSTANTIATE_TEST_SUITE_P(
    Adversary, BadDocument,
    testing::Values(Bad{"/adversary", "/adversary", "[]"}, Bad{"/adversary/A", "/adversary/A", "{}", "no attack id"},
                    Bad{"/adversary/links", "/adversary/links", "1"},
                    Bad{"/adversary/links/type", "/adversary/links/type", "\"dos_fdl\"", "did you mean \"dos_fdi\""},
                    Bad{"/adversary/links/on", "/adversary/links/on", ""},
                    Bad{"/adversary/links/on", "/adversary/links/on", "[]"},
                    Bad{"/adversary/links/on", "/adversary/links/on", "\"link:*\""},
                    Bad{"/adversary/links/on/1", "/adversary/links/on", "[\"link:*\",\"everywhere\"]", "no place"},
                    Bad{"/adversary/links/on/0", "/adversary/links/on", "[\"link:1-9\"]", "node \"9\""},
                    Bad{"/adversary/links/on/0", "/adversary/links/on", "[\"link:1-5\"]", "no link"},
                    Bad{"/adversary/links/on/0", "/adversary/links/on", "[\"sensor:9\"]", "names node"},
                    Bad{"/adversary/links/on/0", "/adversary/links/on", "[\"actuator:9\"]", "not there"},
                    Bad{"/adversary/links/from", "/adversary/links/from", "-1"},
                    Bad{"/adversary/links/to", "/adversary/links/to", "0", "not before from"},
                    Bad{"/adversary/links/enabled", "/adversary/links/enabled", "\"no\""},
                    Bad{"/adversary/links/params/pdos", "/adversary/links/params/pdos", "1.5"},
                    Bad{"/adversary/links/params/pdoss", "/adversary/links/params/pdoss", "1", "did you mean \"pdos\""},
                    Bad{"/adversary/links/probability", "/adversary/links/probability", "1", "not a key"}));

INSTANTIATE_TEST_SUITE_P(
    Lanes, BadDocument,
    testing::Values(Bad{"/lanes", "/lanes", "{}"}, Bad{"/lanes", "/lanes", ""},
                    Bad{"/lanes/My lane", "/lanes/My lane", "{}", "no lane id"},
                    Bad{"/lanes/drop/method", "/lanes/drop/method", "\"consensus_ekff\"",
                        "did you mean \"consensus_ekf\""},
                    Bad{"/lanes/drop/method", "/lanes/drop/method", ""},
                    Bad{"/lanes/drop/path", "/lanes/drop/path", "\"side\""},
                    Bad{"/lanes/drop/adversary", "/lanes/drop/adversary", "0"},
                    Bad{"/lanes/drop/enabled", "/lanes/drop/enabled", "null"},
                    Bad{"/lanes/drop/params/tau", "/lanes/drop/params/tau", "-1", "tau is -1"},
                    Bad{"/lanes/drop/params/tua", "/lanes/drop/params/tua", "1", "did you mean \"tau\""},
                    Bad{"/lanes/drop/params/rho", "/lanes/drop/params/rho", "1"},
                    Bad{"/lanes/drop/params/sigma", "/lanes/drop/params/sigma", "0"},
                    Bad{"/lanes/drop/params/guard", "/lanes/drop/params/guard", "\"stric\"", "did you mean \"strict\""},
                    Bad{"/lanes/drop/parms", "/lanes/drop/parms", "{}", "did you mean \"params\""},
                    Bad{"/lanes/drop", "/lanes/drop", "[]"}));

INSTANTIATE_TEST_SUITE_P(
    Rest, BadDocument,
    testing::Values(Bad{"/metrics/windows", "/metrics/windows", "{}", "did you mean \"window\""},
                    Bad{"/metrics/window", "/metrics/window", "3"},
                    Bad{"/metrics/window/to", "/metrics/window", "{\"from\":5,\"to\":4}", "not before from"},
                    Bad{"/metrics/window/from", "/metrics/window", "{\"from\":-1}"},
                    Bad{"/log/signals", "/log/signals", "[]"}, Bad{"/log/signals", "/log/signals", "[1]"},
                    Bad{"/log/every", "/log/every", "0"}, Bad{"/log/keep", "/log/keep", "0"},
                    Bad{"/log/policy", "/log/policy", "\"lossles\"", "did you mean \"lossless\""},
                    Bad{"/log/polcy", "/log/polcy", "1", "did you mean \"policy\""}));

TEST(Document, FindsEveryProblemAtOnce) {
  Json document = Scenario::preset("consensus").document();
  document["time"]["dt"] = 0;
  document["lanes"]["drop"]["params"]["tau"] = -1;
  document["lanes"]["drop"]["params"]["rhho"] = 1;
  document["adversary"]["links"]["on"] = {"link:1-77"};
  document["extra"] = 1;
  try {
    Scenario::from_json(document);
    FAIL();
  } catch (const InputError& error) {
    std::vector<std::string> pointers;
    for (const auto& problem : error.problems()) pointers.push_back(problem.pointer);
    const std::vector<std::string> expected{"/extra", "/time/dt", "/adversary/links/on/0", "/lanes/drop/params/rhho",
                                            "/lanes/drop/params/tau"};
    EXPECT_EQ(pointers, expected);
  }
}

TEST(Document, RefusesWhatIsNoDocument) {
  for (const char* text : {"[]", "null", "3", "\"consensus\"", "true"})
    EXPECT_THROW(Scenario::from_json(Json::parse(text)), InputError) << text;
  EXPECT_THROW(Scenario::from_json(Json::object()), InputError);
}

/// The one problem of a document whose view holds this value.
std::string pointer_of_view(const Json& value) {
  Json document = Scenario::preset("consensus").document();
  document["view"]["x"] = value;
  try {
    Scenario::from_json(document);
  } catch (const InputError& error) {
    return error.problems().front().pointer;
  }
  return "accepted";
}

TEST(Document, BoundsWhateverItHolds) {
  Json deep = 1;
  for (int n = 0; n < 29; ++n) deep = Json::array({deep});
  EXPECT_EQ(pointer_of_view(deep), "accepted");
  for (int n = 0; n < 9; ++n) deep = Json::array({deep});
  EXPECT_NE(pointer_of_view(deep), "accepted");
  EXPECT_EQ(pointer_of_view(std::string(4096, 'x')), "accepted");
  EXPECT_EQ(pointer_of_view(std::string(4097, 'x')), "/view/x");
  EXPECT_EQ(pointer_of_view(std::nan("")), "/view/x");
  EXPECT_EQ(pointer_of_view(-INFINITY), "/view/x");
  EXPECT_EQ(pointer_of_view("\xff"), "/view/x");
  EXPECT_EQ(pointer_of_view(Json::binary({1, 2})), "/view/x");
  EXPECT_NE(pointer_of_view({{std::string(5000, 'k'), 1}}), "accepted");
  EXPECT_NE(pointer_of_view(Json(std::vector<int>(200'001, 0))), "accepted");
}

TEST(Document, BoundsItsCollections) {
  Json document = Scenario::preset("consensus").document();
  const Json node = document["nodes"]["1"], lane = document["lanes"]["drop"], attack = document["adversary"]["links"];
  document["network"]["graph"] = "ring";
  for (int n = 9; n <= 64; ++n) document["nodes"][std::to_string(n)] = node;
  for (int n = 7; n < 32; ++n) document["lanes"]["l" + std::to_string(n)] = lane;
  EXPECT_NO_THROW(Scenario::from_json(document));
  document["nodes"]["65"] = node;
  document["lanes"]["l32"] = lane;
  for (int n = 1; n <= 32; ++n) document["adversary"]["a" + std::to_string(n)] = attack;
  try {
    Scenario::from_json(document);
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 3U) << error.what();
    EXPECT_EQ(error.problems()[0].pointer, "/nodes");
    EXPECT_EQ(error.problems()[1].pointer, "/adversary");
    EXPECT_EQ(error.problems()[2].pointer, "/lanes");
  }
}

}  // namespace
}  // namespace vigil::problems_test
