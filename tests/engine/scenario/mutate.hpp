/// Seeded mutations of documents and texts.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

using Random = std::mt19937_64;

inline std::size_t below(Random& random, std::size_t count) { return random() % count; }

/// Values that programs and people get wrong.
inline Json nasty(Random& random) {
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
inline Json& somewhere(Json& document, Random& random) {
  Json* here = &document;
  while (here->is_structured() && !here->empty() && below(random, 5) != 0) {
    auto next = here->begin();
    std::advance(next, static_cast<std::ptrdiff_t>(below(random, here->size())));
    here = &*next;
  }
  return *here;
}

inline void mutate(Json& document, Random& random) {
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

inline std::string mutated_text(std::string text, Random& random) {
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

}  // namespace vigil
