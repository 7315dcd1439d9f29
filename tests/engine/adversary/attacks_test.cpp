/// Each attack by itself: frequencies, norms, draws, composition, bad input. Sections 4 and 13.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "engine/adversary/attack.hpp"

namespace vigil::attacks_test {
namespace {

constexpr int kLinks = 20, kTicks = 4000;

std::unique_ptr<Attack> make(const std::string& type, const Json& given, const std::string& id = "links",
                             std::uint64_t seed = 1, int message = 3) {
  const auto* entry = Registry<AttackMake>::find(type);
  std::vector<Problem> problems;
  const Json values = entry->params.complete(given, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return entry->make(Params(values), {id, seed, message});
}

std::vector<int> all_links() {
  std::vector<int> links(kLinks);
  std::iota(links.begin(), links.end(), 0);
  return links;
}

LinkEffects effects_of(const std::vector<const Attack*>& attacks, std::int64_t k,
                       const std::vector<int>& links = all_links()) {
  LinkEffects effects;
  effects.resize(3, kLinks);
  effects.clear();
  for (const Attack* attack : attacks) attack->act(k, links, effects);
  return effects;
}

struct Counts {
  int dos = 0, fdi = 0;
};

/// Counts states over all links and ticks and checks what must hold in each.
Counts count(const Attack& attack, double delta) {
  Counts counts;
  for (std::int64_t k = 1; k <= kTicks; ++k) {
    const LinkEffects effects = effects_of({&attack}, k);
    for (int l = 0; l < kLinks; ++l) {
      const LinkState state = effects.state[static_cast<std::size_t>(l)];
      const double norm = effects.injected.col(l).norm();
      counts.dos += state == LinkState::dos ? 1 : 0;
      counts.fdi += state == LinkState::fdi ? 1 : 0;
      EXPECT_LE(norm, delta * (1 + 1e-12));
      if (state != LinkState::fdi) {
        EXPECT_EQ(norm, 0) << "DoS and FDI never on one channel";
      }
      EXPECT_EQ(std::isnan(effects.strength[l]), state == LinkState::clean);
    }
  }
  return counts;
}

/// Within 4.5 standard errors of a binomial law.
void expect_share(int hits, double probability) {
  const double n = double{kLinks} * kTicks;
  EXPECT_LE(std::abs(hits - n * probability), 4.5 * std::sqrt(n * probability * (1 - probability)));
}

TEST(DosFdi, HasItsFrequencies) {
  const std::vector<std::pair<double, double>> rates{{0.2, 0.2}, {0, 0.8}, {0.8, 0}, {0.5, 0.5},
                                                     {1, 0},     {0, 1},   {0, 0},   {0.01, 0.002}};
  for (const auto& [pdos, pfdi] : rates) {
    const auto attack = make("dos_fdi", {{"pdos", pdos}, {"pfdi", pfdi}});
    const Counts counts = count(*attack, 1.5 * std::sqrt(2.0));
    expect_share(counts.dos, pdos);
    expect_share(counts.fdi, pfdi);
    EXPECT_EQ(attack->rates().dos, pdos);
    EXPECT_EQ(attack->rates().fdi, pfdi);
    EXPECT_DOUBLE_EQ(attack->rates().delta, 1.5 * std::sqrt(2.0));
  }
}

TEST(DosFdi, InjectsTheSineOfItsSignal) {
  const auto attack = make("dos_fdi", {{"pdos", 0}, {"pfdi", 1}, {"s_std", 3}, {"xi_scale", 2}});
  const auto constant = make("dos_fdi", {{"pdos", 0}, {"pfdi", 1}, {"s_std", 3}, {"xi_scale", 2}, {"xi_const", true}});
  double square = 0;
  for (std::int64_t k = 1; k <= kTicks; ++k) {
    const LinkEffects effects = effects_of({attack.get()}, k);
    for (int l = 0; l < kLinks; ++l) {
      ASSERT_TRUE(effects.injected.col(l).isApprox(std::sin(effects.strength[l]) * Eigen::Vector3d(3, 3, 0), 1e-14));
      square += effects.strength[l] * effects.strength[l];
    }
    ASSERT_TRUE(effects_of({constant.get()}, k).injected.col(7).isApprox(Eigen::Vector3d(3, 3, 0)));
  }
  const double n = double{kLinks} * kTicks;
  EXPECT_NEAR(square / n, 9, 4.5 * 9 * std::sqrt(2 / n));
}

// A draw belongs to its link, tick, attack and seed: which other links are attacked, and how often, does not matter.
TEST(DosFdi, KeepsItsDraws) {
  const auto weak = make("dos_fdi", {{"pdos", 0.2}, {"pfdi", 0.2}}),
             strong = make("dos_fdi", {{"pdos", 0.4}, {"pfdi", 0.2}});
  const auto other_seed = make("dos_fdi", Json::object(), "links", 2),
             other_name = make("dos_fdi", Json::object(), "second");
  int differs_by_seed = 0, differs_by_name = 0;
  for (std::int64_t k = 1; k <= 200; ++k) {
    const LinkEffects all = effects_of({weak.get()}, k), stronger = effects_of({strong.get()}, k),
                      one = effects_of({weak.get()}, k, {13});
    EXPECT_EQ(all.state[13], one.state[13]);
    EXPECT_EQ(all.injected.col(13), one.injected.col(13));
    EXPECT_EQ(one.state[12], LinkState::clean);
    for (std::size_t l = 0; l < kLinks; ++l) {
      if (all.state[l] != LinkState::clean) {
        EXPECT_EQ(stronger.state[l], LinkState::dos) << "u < 0.4 is a DoS now";
        EXPECT_EQ(stronger.strength[static_cast<Eigen::Index>(l)], all.strength[static_cast<Eigen::Index>(l)]);
      }
    }
    differs_by_seed += all.state != effects_of({other_seed.get()}, k).state;
    differs_by_name += all.state != effects_of({other_name.get()}, k).state;
  }
  EXPECT_GT(differs_by_seed, 190);
  EXPECT_GT(differs_by_name, 190);
}

TEST(DosFdi, SumsOfOneAreLegal) {
  for (int percent = 0; percent <= 100; ++percent) {
    EXPECT_NO_THROW(make("dos_fdi", {{"pdos", percent / 100.0}, {"pfdi", (100 - percent) / 100.0}})) << percent;
  }
}

TEST(Attacks, JamWinsInAnyOrder) {
  const auto jam = make("dos", {{"probability", 0.5}}, "jam");
  const auto bias = make("bias", {{"vector", {1, 2, 3}}, {"probability", 0.5}}, "bias");
  const auto mixed = make("dos_fdi", {{"pdos", 0.3}, {"pfdi", 0.6}}, "mixed");
  int both = 0;
  for (std::int64_t k = 1; k <= 300; ++k) {
    const LinkEffects jam_only = effects_of({jam.get()}, k), bias_only = effects_of({bias.get()}, k);
    for (const auto& order :
         {std::vector<const Attack*>{jam.get(), bias.get()}, std::vector<const Attack*>{bias.get(), jam.get()}}) {
      const LinkEffects effects = effects_of(order, k);
      for (std::size_t l = 0; l < kLinks; ++l) {
        const auto link = static_cast<Eigen::Index>(l);
        if (jam_only.state[l] == LinkState::dos) {
          EXPECT_EQ(effects.state[l], LinkState::dos);
          EXPECT_TRUE(effects.injected.col(link).isZero());
          both += bias_only.state[l] == LinkState::fdi ? 1 : 0;
        } else {
          EXPECT_EQ(effects.state[l], bias_only.state[l]);
          EXPECT_EQ(effects.injected.col(link), bias_only.injected.col(link));
        }
      }
    }
    const LinkEffects two = effects_of({bias.get(), mixed.get()}, k), one = effects_of({mixed.get()}, k);
    for (std::size_t l = 0; l < kLinks; ++l) {  // injections add
      const auto link = static_cast<Eigen::Index>(l);
      if (two.state[l] == LinkState::fdi) {
        EXPECT_TRUE(two.injected.col(link).isApprox(one.injected.col(link) + bias_only.injected.col(link)));
      }
    }
  }
  EXPECT_GT(both, 1000);
}

TEST(Attacks, PlainOnesHaveTheirFrequencies) {
  for (const double p : {0.0, 0.3, 1.0}) {
    int jammed = 0, falsified = 0;
    const auto jam = make("dos", {{"probability", p}});
    const auto bias = make("bias", {{"probability", p}, {"vector", {3, 4, 0}}});
    for (std::int64_t k = 1; k <= kTicks; ++k) {
      for (const LinkState state : effects_of({jam.get()}, k).state) jammed += state == LinkState::dos ? 1 : 0;
      for (const LinkState state : effects_of({bias.get()}, k).state) falsified += state == LinkState::fdi ? 1 : 0;
    }
    expect_share(jammed, p);
    expect_share(falsified, p);
    EXPECT_EQ(jam->rates().dos, p);
    EXPECT_EQ(bias->rates().fdi, p);
    EXPECT_EQ(bias->rates().delta, 5);
  }
}

TEST(Attacks, AreValues) {
  for (const auto& entry : Registry<AttackMake>::all()) {
    Json params = Json::object();
    if (entry.id == "ramp") params["slope"] = {1, 0, 2};
    if (entry.id == "coordinated") params["shift"] = {1, 0, 2};
    if (entry.id == "waveform") params["pieces"] = Json::array({Json::array({1, 0.5, 0, 0, 0, 0, 0})});
    const auto attack = make(entry.id, params);
    const auto copy = attack->clone();
    for (std::int64_t k = 1; k <= 50; ++k)
      EXPECT_EQ(effects_of({attack.get()}, k).state, effects_of({copy.get()}, k).state) << entry.id;
  }
}

struct Bad {
  const char* type;
  const char* params;
  const char* pointer;
};

class BadAttack : public testing::TestWithParam<Bad> {};

TEST_P(BadAttack, IsRefusedAtItsPointer) {
  try {
    make(GetParam().type, Json::parse(GetParam().params));
    FAIL() << GetParam().params;
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().pointer, GetParam().pointer) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Attacks, BadAttack,
    testing::Values(Bad{"dos_fdi", R"({"pdos":0.6,"pfdi":0.41})", "/pfdi"}, Bad{"dos_fdi", R"({"pdos":-0.1})", "/pdos"},
                    Bad{"dos_fdi", R"({"pfdi":1.01})", "/pfdi"}, Bad{"dos_fdi", R"({"delta":2.119})", "/delta"},
                    Bad{"dos_fdi", R"({"delta":2.12,"xi_scale":2})", "/delta"},
                    Bad{"dos_fdi", R"({"xi_dir":[1.5,1.5]})", "/xi_dir"},
                    Bad{"dos_fdi", R"({"xi_dir":[1.5,1.5,0,0]})", "/xi_dir"},
                    Bad{"dos_fdi", R"({"xi_dir":"up"})", "/xi_dir"}, Bad{"dos_fdi", R"({"xi_scale":-1})", "/xi_scale"},
                    Bad{"dos_fdi", R"({"s_std":-1})", "/s_std"}, Bad{"dos_fdi", R"({"p_dos":0.1})", "/p_dos"},
                    Bad{"dos", R"({"probability":2})", "/probability"}, Bad{"bias", R"({"vector":[1]})", "/vector"},
                    Bad{"bias", R"({"probability":null})", "/probability"}));

TEST(DosFdi, TakesTheRoundedBound) {
  const auto attack = make("dos_fdi", {{"delta", 2.12}});  // the paper's: 1.5 sqrt(2) rounded down by less than 0.1 %
  EXPECT_EQ(attack->rates().delta, 2.12);
  EXPECT_DOUBLE_EQ(make("dos_fdi", {{"xi_scale", 30}})->rates().delta, 45 * std::sqrt(2.0));
}

}  // namespace
}  // namespace vigil::attacks_test
