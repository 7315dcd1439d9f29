// Good bodies with a few bytes changed, cut, doubled or put elsewhere: read or refused, never anything else.
#include <gtest/gtest.h>

#include <random>

#include "tests/fuzz/ingest_case.hpp"

namespace vigil::mutation_test {
namespace {

const std::string kGood[] = {
    "{\"seq\":1,\"k\":0,\"node\":\"1\",\"values\":{\"p\":1.5,\"q\":-2e-3}}\n{\"k\":1,\"values\":{\"truth.x\":null}}\n"
    "{\"seq\":3,\"k\":40,\"node\":2,\"values\":{\"p\":7}}",
    R"([{"k":3,"values":{"link.1-2.state":1,"sensor.1.state":0}},{"k":2,"node":"8","values":{"q":0.125}}])",
    "k,t,seq,sensor.1.p,truth.x,truth.y\r\n0,0,1,5,,-1\r\n1,0.1,2,6.25,1e-310,+4\r\n9,0.9,,7,1,2\r\n"};

std::string mutated(std::string text, std::mt19937& random) {
  static const std::string kWords[] = {
      "NaN", "1e999", "null", "-", "\"", "{", "[", ",", "\n", "\xff", "18446744073709551616"};
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t times = 1 + below(4); times > 0; --times) {
    const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at, 12) + 1);
    switch (below(4)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(below(text.size() + 1), below(20)));
        break;
      case 2:
        text.insert(at, kWords[below(std::size(kWords))]);
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(random());
    }
  }
  return text;
}

TEST(PushedBodies, AreReadOrRefused) {
  std::mt19937 random(20260131);
  int taken = 0, refused = 0;
  for (int n = 0; n < 12'000; ++n) {
    const auto form = static_cast<unsigned>(n % 3);
    const std::string body = n < 3 ? kGood[form] : mutated(kGood[form], random);
    SCOPED_TRACE(body);
    bool read = false;
    ASSERT_NO_THROW(read = fuzz::ingest_case(form, body));
    EXPECT_TRUE(read || n >= 3);
    ++(read ? taken : refused);
  }
  EXPECT_GT(taken, 100);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace vigil::mutation_test
