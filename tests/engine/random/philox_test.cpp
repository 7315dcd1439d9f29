#include "engine/random/philox.hpp"

#include <gtest/gtest.h>

#include <set>

#include "engine/random/draws.hpp"

namespace vigil::philox_test {
namespace {

// Known answers of the generator's authors (Random123, philox4x32 with 10 rounds).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (PhiloxBlock{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}), (PhiloxBlock{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxBlock{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Draws, DependOnEveryPartOfTheirAddressAndNothingElse) {
  const Draws draws(7, "plant");
  EXPECT_EQ(draws.block(3, 5, 2), Draws(7, "plant").block(3, 5, 2));
  std::set<PhiloxBlock> seen;
  for (const std::uint64_t seed : {0ULL, 1ULL, 2ULL, ~0ULL}) {
    for (const char* stream :
         {"", "plant", "sensor.1", "sensor.2", "adversary.links.branch", "adversary.links.signal"}) {
      for (const std::int64_t tick : {0LL, 1LL, 2LL, (1LL << 32) + 1, (1LL << 47) - 1}) {
        for (const std::uint32_t index : {0U, 1U, ~0U}) {
          for (const std::uint32_t sub : {0U, 1U, 0xFFFFU}) seen.insert(Draws(seed, stream).block(tick, index, sub));
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), 4U * 6 * 5 * 3 * 3) << "two addresses share their bits";
}

TEST(Draws, AreTheSameInAnyOrder) {
  const Draws draws(11, "sensor.4");
  std::vector<double> forward, backward;
  for (std::int64_t tick = 0; tick < 200; ++tick) forward.push_back(draws.normal(tick, 1) + draws.uniform(tick, 0));
  for (std::int64_t tick = 199; tick >= 0; --tick) {
    static_cast<void>(draws.gamma(tick, 1, 0.3, 2));  // asking for other numbers moves none
    backward.push_back(draws.normal(tick, 1) + draws.uniform(tick, 0));
  }
  for (std::size_t i = 0; i < forward.size(); ++i) EXPECT_EQ(forward[i], backward[199 - i]);
}

TEST(Draws, GiveAVectorTheNumbersOfItsEntries) {
  const Draws draws(5, "initial.1");
  for (const int size : {1, 2, 3, 7}) {
    Eigen::VectorXd all(size);
    draws.normals(9, all);
    for (int i = 0; i < size; ++i) EXPECT_EQ(all[i], draws.normal(9, static_cast<std::uint32_t>(i)));
  }
}

}  // namespace
}  // namespace vigil::philox_test
