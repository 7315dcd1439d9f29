/// False data on radars: its laws, its one azimuth a run, its schedule to the tick. Specification of seed 001, sections
/// 5 and 15.
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "engine/adversary/attack.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::radar_fdi_test {
namespace {

constexpr int kNodes = 5, kChannels = 6;
constexpr double kTurn = 2 * std::numbers::pi;
using State = SensorState;

std::unique_ptr<Attack> make(const Json& given, const std::string& id = "it", std::uint64_t seed = 1,
                             std::vector<int> readings = {kChannels}) {
  const auto* entry = Registry<AttackMake>::find("radar_fdi");
  std::vector<Problem> problems;
  const Json values = entry->params.complete(given, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return entry->make(Params(values), {id, seed, kChannels, false, std::move(readings)});
}

SensorEffects effects_at(const Attack& attack, std::int64_t k, const std::vector<SensorPlace>& places) {
  SensorEffects effects;
  effects.resize(std::vector<int>(kNodes, kChannels));
  attack.tamper(k, places, effects);
  return effects;
}

const std::vector<SensorPlace> kAll{{0, -1}, {1, -1}, {2, -1}, {3, -1}, {4, -1}};

/// Sums of one channel over all nodes and 4000 ticks.
struct Sample {
  double sum = 0, square = 0, least = 1e300, most = -1e300;
  int count = 0;
  void add(double value) {
    sum += value;
    square += value * value;
    least = std::min(least, value);
    most = std::max(most, value);
    ++count;
  }
};

/// The sample is of the uniform law between `low` and `high`: mean and mean square within 4.5 standard errors, range
/// kept and nearly filled.
void expect_uniform(const Sample& sample, double low, double high) {
  const double n = sample.count, middle = (low + high) / 2, width = high - low;
  EXPECT_NEAR(sample.sum / n, middle, 4.5 * width / std::sqrt(12 * n));
  const double variance = sample.square / n - std::pow(sample.sum / n, 2);
  EXPECT_NEAR(variance, width * width / 12, 4.5 * width * width / std::sqrt(180 * n));  // of (x - middle)^2
  EXPECT_GE(sample.least, low);
  EXPECT_LT(sample.most, high);
  EXPECT_LT(sample.least, low + width * 20 / n);  // missed by all n with probability e^-20
  EXPECT_GT(sample.most, high - width * 20 / n);
}

TEST(RadarFdi, HasTheLawsOfTable1) {
  const std::map<std::string, State> kinds{{"I", State::type_i}, {"II", State::type_ii}, {"R", State::type_r}};
  for (const auto& [kind, state] : kinds) {
    SCOPED_TRACE(kind);
    const auto attack = make({{"kind", kind}});
    Sample range, azimuth;
    for (std::int64_t k = 1; k <= 4000; ++k) {
      const SensorEffects effects = effects_at(*attack, k, kAll);
      for (std::size_t n = 0; n < kNodes; ++n) {
        ASSERT_EQ(effects.state[n], state);
        range.add(effects.injected[n][0]);
        azimuth.add(effects.injected[n][1]);
        ASSERT_TRUE(effects.injected[n].tail(4).isZero(0));
      }
    }
    const double centre = kind == "II" ? 10 : 0;
    expect_uniform(range, centre - 5, centre + 5);
    if (kind == "I") expect_uniform(azimuth, 0, kTurn);
    EXPECT_TRUE(kind != "R" || azimuth.square == 0);
  }
}

TEST(RadarFdi, FollowsItsParameters) {
  const auto wide = make({{"kind", "I"}, {"range_spread", 50}, {"azimuth_span", 0.1}});
  const auto plain = make({{"kind", "I"}});
  const auto shifted = make({{"kind", "II"}, {"range_spread", 0}, {"range_offset", -3}, {"psi", -0.5}});
  for (std::int64_t k = 1; k <= 50; ++k) {
    for (std::size_t n = 0; n < kNodes; ++n) {
      const Eigen::VectorXd a = effects_at(*wide, k, kAll).injected[n], b = effects_at(*plain, k, kAll).injected[n];
      EXPECT_NEAR(a[0], 10 * b[0], 1e-12) << "the same draw, scaled";
      EXPECT_NEAR(a[1], b[1] * 0.1 / kTurn, 1e-15);
      const Eigen::VectorXd c = effects_at(*shifted, k, kAll).injected[n];
      EXPECT_EQ(c[0], -3);
      EXPECT_EQ(c[1], -0.5);
    }
  }
}

/// psi_t of every node in this run.
std::vector<double> azimuths(std::uint64_t seed, const std::string& id, std::int64_t k) {
  const SensorEffects effects = effects_at(*make({{"kind", "II"}}, id, seed), k, kAll);
  std::vector<double> result;
  for (const Eigen::VectorXd& e : effects.injected) result.push_back(e[1]);
  return result;
}

TEST(RadarFdi, DrawsOneAzimuthANodeAndRun) {
  std::set<double> seen;
  Sample all;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const auto first = azimuths(seed, "it", 1);
    for (const std::int64_t k : {2, 50, 119, 200, 100'000}) EXPECT_EQ(azimuths(seed, "it", k), first);
    for (const double psi : first) {
      EXPECT_GT(psi, 0);
      all.add(psi);
      seen.insert(psi);
    }
  }
  EXPECT_EQ(seen.size(), 400U * kNodes) << "no node and no run shares its azimuth";
  expect_uniform(all, 0, kTurn);
  EXPECT_NE(azimuths(1, "it", 1), azimuths(1, "other", 1));
}

// A draw belongs to its node, tick, attack and seed: which other nodes are attacked does not matter, nor does a copy.
TEST(RadarFdi, KeepsItsDraws) {
  const auto attack = make({{"kind", "I"}});
  const auto copy = attack->clone();
  for (std::int64_t k = 1; k <= 100; ++k) {
    const SensorEffects all = effects_at(*attack, k, kAll), one = effects_at(*attack, k, {{3, -1}});
    EXPECT_EQ(all.injected[3], one.injected[3]);
    EXPECT_EQ(one.state[2], State::clean);
    EXPECT_TRUE(one.injected[2].isZero(0));
    EXPECT_EQ(effects_at(*copy, k, kAll).injected[4], all.injected[4]);
    EXPECT_NE(effects_at(*make({{"kind", "I"}}, "it", 2), k, kAll).injected[3], all.injected[3]);
    EXPECT_NE(all.injected[0], all.injected[1]);
  }
}

TEST(RadarFdi, RefusesASingleChannelAndBadNumbers) {
  EXPECT_THROW(make(Json::object(), "it", 1, {1}), InputError);
  EXPECT_THROW(make(Json::object(), "it", 1, {6, 1}), InputError);
  EXPECT_NO_THROW(make(Json::object(), "it", 1, {6, 2}));
  for (const char* bad : {R"({"kind":"III"})", R"({"range_spread":-1})", R"({"azimuth_span":-1})", R"({"psi":"drawn"})",
                          R"({"range_offset":null})", R"({"spread":5})"})
    EXPECT_THROW(make(Json::parse(bad)), InputError) << bad;
}

/// The sparse scenario with two light lanes, one of them spared, and this adversary.
Json document(const Json& adversary) {
  Json document = Scenario::preset("sparse").document();
  document["lanes"] = {{"hit", {{"method", "local_ekf"}}}, {"spared", {{"method", "local_ekf"}, {"adversary", false}}}};
  if (!adversary.is_null()) document["adversary"] = adversary;
  return document;
}

struct Ran {
  std::unique_ptr<vigil::Run> run;
  test::Capture capture;

  explicit Ran(const Json& given, std::uint64_t seed = 1)
      : run(std::make_unique<vigil::Run>(Scenario::from_json(given), RunOptions{seed, nullptr, {}})) {
    test::run_to_end(*run, capture);
  }
  double at(std::int64_t k, const std::string& signal) const {
    const int id = run->catalogue().find(signal);
    EXPECT_GE(id, 0) << signal;
    return capture.frames[static_cast<std::size_t>(k)].values[static_cast<std::size_t>(id)];
  }
};

// Section 5 to the tick: t in [start, end), k = 119 is 5.95 s, 120 is 6 s, 179 is 8.95 s, 180 is 9 s, 200 is 10 s.
TEST(RadarFdi, KeepsTheScheduleOfTable1) {
  const Ran ran(document(nullptr));
  const auto attacked = [&](std::int64_t k) {
    std::map<int, int> result;
    for (int n = 1; n <= kNodes; ++n) {
      const int state = static_cast<int>(ran.at(k, "sensor." + std::to_string(n) + ".state"));
      if (state != 0) result[n] = state;
    }
    return result;
  };
  const std::map<int, int> first{{2, 4}, {4, 5}}, second{{3, 5}, {5, 4}}, last{{1, 4}, {3, 5}, {5, 4}};
  for (std::int64_t k = 1; k <= 200; ++k) EXPECT_EQ(attacked(k), k <= 119 ? first : k <= 179 ? second : last) << k;
}

/// On station 2.
Json attack(const char* kind, int from, const Json& to) {
  return {{"type", "radar_fdi"}, {"on", {"sensor:2"}}, {"from", from}, {"to", to}, {"params", {{"kind", kind}}}};
}

TEST(RadarFdi, SparesTheSparedAndWrapsTheAzimuth) {
  Json turned = attack("II", 1, nullptr);
  turned["params"]["psi"] = 3;  // station 2 first sees the target at 0.46 rad: the sum passes pi
  const Ran hit(document({{"it", turned}})), quiet(document(Json::object()));
  test::expect_same(*hit.run, hit.capture, *quiet.run, quiet.capture, "lane.spared.");
  int wrapped = 0;
  for (std::int64_t k = 1; k <= 200; ++k) {
    for (const char* channel : {"range", "azimuth", "elevation", "vx", "vy", "vz"}) {
      const std::string name = std::string("sensor.2.") + channel;
      const double received = hit.at(k, name), honest = quiet.at(k, name), added = hit.at(k, name + ".injected");
      const double turns = (honest + added - received) / kTurn;
      EXPECT_NEAR(turns, std::round(turns), 1e-12) << name << " " << k;
      wrapped += std::round(turns) != 0 ? 1 : 0;
      if (std::string(channel) == "azimuth") {
        EXPECT_LE(std::abs(received), kTurn / 2);
      }
    }
  }
  EXPECT_GT(wrapped, 0) << "the sum is carried over the cut";
}

// Where two overlap on one node, the later start wins, then the greater id, whatever their order in the document; one
// alone is what is injected.
TEST(RadarFdi, TheLaterStartWinsThenTheGreaterId) {
  const Json later = {{"z", attack("I", 10, nullptr)}, {"a", attack("II", 20, 40)}};
  const Json equal = {{"b", attack("R", 10, nullptr)}, {"c", attack("II", 10, 30)}, {"a", attack("I", 10, nullptr)}};
  const Ran by_start(document(later)), by_id(document(equal)), alone(document({{"a", attack("II", 20, 40)}}));
  for (std::int64_t k = 1; k <= 60; ++k) {
    const State start = k < 10 ? State::clean : k < 20 || k > 40 ? State::type_i : State::type_ii;
    EXPECT_EQ(by_start.at(k, "sensor.2.state"), static_cast<double>(start)) << k;
    const State id = k < 10 ? State::clean : k > 30 ? State::type_r : State::type_ii;
    EXPECT_EQ(by_id.at(k, "sensor.2.state"), static_cast<double>(id)) << k;
    if (k < 20 || k > 40) continue;
    for (const char* channel : {"range", "azimuth"}) {
      const std::string name = std::string("sensor.2.") + channel + ".injected";
      EXPECT_EQ(by_start.at(k, name), alone.at(k, name)) << "replaced, not added";
    }
  }
}

TEST(RadarFdi, IsRefusedOnChannelsAndLinks) {
  for (const char* place : {"sensor:2.range", "link:1-2"}) {
    Json given = attack("I", 1, nullptr);
    given["on"] = {place};
    try {
      const vigil::Run run(Scenario::from_json(document({{"it", given}})), {1, nullptr, {}});
      ADD_FAILURE() << place;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().size(), 1U);
      EXPECT_EQ(error.problems().front().pointer.find("/adversary/it/"), 0U) << error.what();
    }
  }
}

}  // namespace
}  // namespace vigil::radar_fdi_test
