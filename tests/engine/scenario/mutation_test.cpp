/// Thousands of seeded mutations of good documents, patches, paths and traces: each is accepted or refused with words,
/// never anything else.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/fuzz/cases.hpp"

namespace vigil {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t count) { return random() % count; }

/// Values that programs and people get wrong.
Json nasty(Random& random) {
  Json deep = 1;
  for (int n = 0; n < 40; ++n) deep = Json::array({deep});
  const std::vector<Json> values{nullptr,
                                 true,
                                 false,
                                 0,
                                 -1,
                                 1,
                                 0.5,
                                 -0.0,
                                 1e308,
                                 -1e308,
                                 5e-324,
                                 1e19,
                                 std::numeric_limits<std::int64_t>::min(),
                                 std::numeric_limits<std::uint64_t>::max(),
                                 std::nan(""),
                                 INFINITY,
                                 "",
                                 "1",
                                 "link:*",
                                 "link:1-1",
                                 "edges",
                                 "knn7",
                                 "radius1e308",
                                 "truth",
                                 "\xff\xfe",
                                 std::string(5000, 'a'),
                                 std::string("a\0b", 3),
                                 Json::array(),
                                 Json::object(),
                                 Json::array({1, 2, 3}),
                                 Json::array({1e308, 1e308, 1e308}),
                                 Json::parse("[[1,0,0],[0,1,0],[0,0,1]]"),
                                 Json::parse("[[1e308,1e308,0],[1e308,1e308,0],[0,0,1]]"),
                                 Json::parse("[[1,2],[3]]"),
                                 Json::parse("[null]"),
                                 Json::parse(R"({"type":"camera"})"),
                                 Json::parse(R"({"a":{"b":{}}})"),
                                 std::move(deep)};
  return values[below(random, values.size())];
}

/// A value somewhere in the document, reached by random steps.
Json& somewhere(Json& document, Random& random) {
  Json* here = &document;
  while (here->is_structured() && !here->empty() && below(random, 5) != 0) {
    auto next = here->begin();
    std::advance(next, static_cast<std::ptrdiff_t>(below(random, here->size())));
    here = &*next;
  }
  return *here;
}

void mutate(Json& document, Random& random) {
  Json& place = somewhere(document, random);
  switch (below(random, 5)) {
    case 0:
      if (place.is_object() && !place.empty()) {
        auto member = place.begin();
        std::advance(member, static_cast<std::ptrdiff_t>(below(random, place.size())));
        place.erase(member);
      }
      break;
    case 1:
      if (place.is_object())
        place[std::string(1 + below(random, 20), static_cast<char>('!' + below(random, 90)))] = nasty(random);
      break;
    case 2:
      if (place.is_array()) place.push_back(nasty(random));
      break;
    default:
      place = nasty(random);
  }
}

std::string mutated_text(std::string text, Random& random) {
  const std::size_t changes = 1 + below(random, 4);
  static const std::string interesting = ",\n\r\".-+eE0 19[]{}:xk\t\xff";
  for (std::size_t n = 0; n < changes && !text.empty(); ++n) {
    const std::size_t place = below(random, text.size());
    switch (below(random, 4)) {
      case 0:
        text.erase(place, 1 + below(random, 8));
        break;
      case 1:
        text.insert(place, 1, interesting[below(random, interesting.size())]);
        break;
      case 2:
        text[place] = interesting[below(random, interesting.size())];
        break;
      default:
        text.insert(place, text.substr(below(random, text.size()), below(random, 20)));
    }
  }
  return text;
}

TEST(Mutations, OfDocumentsAreAcceptedOrRefused) {
  Random random(1);
  int accepted = 0;
  for (int n = 0; n < 2000; ++n) {
    Json document = Scenario::preset(Scenario::preset_ids()[static_cast<std::size_t>(n) % 4]).document();
    for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) mutate(document, random);
    accepted += fuzz::scenario_case(document) ? 1 : 0;
  }
  EXPECT_GT(accepted, 20);
  EXPECT_LT(accepted, 1980);
}

TEST(Mutations, OfDocumentTextsAreAcceptedOrRefused) {
  Random random(2);
  const std::string text = Scenario::preset("consensus").document().dump();
  int accepted = 0;
  for (int n = 0; n < 3000; ++n) accepted += fuzz::scenario_case(std::string_view(mutated_text(text, random))) ? 1 : 0;
  EXPECT_GT(accepted, 20);
  EXPECT_LT(accepted, 2980);
}

TEST(Mutations, OfPatchesAreAcceptedOrRefused) {
  Random random(3);
  const Json good = Json::parse(R"({"time":{"steps":50},"lanes":{"drop":null,"consensus":{"params":{"tau":0.02}}},
    "network":{"graph":"edges","edges":[[1,2],[2,3]]},"noise":{"Q":[1,1,1]},"metrics":{"window":{"from":1,"to":9}}})");
  int accepted = 0;
  for (int n = 0; n < 1000; ++n) {
    Json patch = good;
    mutate(patch, random);
    accepted += fuzz::patch_case(patch) ? 1 : 0;
  }
  EXPECT_GT(accepted, 20);
  EXPECT_LT(accepted, 980);
}

TEST(Mutations, OfPathsAreAcceptedOrRefused) {
  Random random(4);
  const std::string paths[] = {"lanes.consensus.params.tau", "nodes.1.sensor.params.position.0", "initial.estimates.1",
                               "view.lane", "network.graph"};
  int accepted = 0;
  for (int n = 0; n < 1000; ++n) {
    const std::string& path = paths[below(random, std::size(paths))];
    const bool keep = below(random, 2) == 0;
    accepted += fuzz::with_case(keep ? path : mutated_text(path, random), nasty(random)) ? 1 : 0;
  }
  EXPECT_GT(accepted, 5);
  EXPECT_LT(accepted, 900);
}

TEST(Mutations, OfTracesAreAcceptedOrRefused) {
  Random random(5);
  const std::string text =
      "k,t,truth.x,sensor.1.p,link.1-2.state\n0,0,150,,0\n1,0.5,157.9,-3.25e-1,1\n2,1,165,12,\n3,1.5,,,2\n";
  int accepted = 0;
  for (int n = 0; n < 20'000; ++n) accepted += fuzz::trace_case(mutated_text(text, random)) ? 1 : 0;
  EXPECT_GT(accepted, 1000);
  EXPECT_LT(accepted, 19'000);
}

}  // namespace
}  // namespace vigil
