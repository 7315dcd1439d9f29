/// When a replay acts, what it plays, and what it refuses.
#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::replay_test {
namespace {

using test::replay_scenario;
using test::Told;

Json params(const Json& values) { return {{"adversary", {{"replay", {{"params", values}}}}}}; }

/// Ticks at which something is played and what is, of the shared sensor's first channel.
std::vector<std::pair<std::int64_t, std::int64_t>> played(const Told& told, const char* signal = "sensor.1.y1.source") {
  std::vector<std::pair<std::int64_t, std::int64_t>> result;
  for (std::int64_t k = 1; k <= told.run.tick(); ++k) {
    const double source = told.at(k, signal);
    if (std::isfinite(source)) result.emplace_back(k, static_cast<std::int64_t>(source));
  }
  return result;
}

TEST(Replay, HasTheTwoCasesOfTheSpecification) {
  for (const auto& [number, start, end] : {std::tuple{1, 101, 180}, std::tuple{2, 250, 300}}) {
    const Told told(replay_scenario("replay-ubb", {"zeta1"}, test::replay_case(number)), {1, nullptr, {}});
    const auto ticks = played(told);
    ASSERT_EQ(ticks.size(), static_cast<std::size_t>(end - start + 1));
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_EQ(ticks[i].first, start + static_cast<int>(i));
      EXPECT_EQ(ticks[i].second, 50 + static_cast<int>(i) % 51);
    }
    const auto marks = told.marks(MarkType::attack, "replay");
    ASSERT_EQ(marks.size(), number == 1 ? 2U : 1U) << "case 2 lasts to the end of the run";
    EXPECT_EQ(marks[0].detail.find("repeats") != std::string::npos, number == 1) << marks[0].detail;
  }
}

TEST(Replay, TakesAnyWindow) {
  const Told told(replay_scenario("replay-ubb", {"zeta1"},
                                  params({{"record_from", 7}, {"record_to", 9}, {"start", 10}, {"end", 14}})),
                  {1, nullptr, {}});
  EXPECT_EQ(played(told),
            (std::vector<std::pair<std::int64_t, std::int64_t>>{{10, 7}, {11, 8}, {12, 9}, {13, 7}, {14, 8}}));
}

TEST(Replay, KeepsToTheTicksOfItsEntry) {
  Json patch = params({{"record_from", 7}, {"record_to", 9}, {"start", 10}});
  patch["adversary"]["replay"]["from"] = 12;
  patch["adversary"]["replay"]["to"] = 13;
  const Told told(replay_scenario("replay-ubb", {"zeta1"}, patch), {1, nullptr, {}});
  EXPECT_EQ(played(told), (std::vector<std::pair<std::int64_t, std::int64_t>>{{12, 9}, {13, 7}}));
  const auto marks = told.marks(MarkType::attack);
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].k, 12);
  EXPECT_EQ(marks[1].k, 14);
}

// Of two attacks on one sensor the one that starts later wins, whatever their names: here by the parameter `start`.
TEST(Replay, TheLaterStartWins) {
  for (const char* later : {"a", "z"}) {
    Json patch = test::no_attack();
    const auto entry = [](int from, int start, int end) {
      return Json{{"type", "replay"},
                  {"on", {"sensor:1"}},
                  {"params", {{"record_from", from}, {"record_to", from + 2}, {"start", start}, {"end", end}}}};
    };
    patch["adversary"]["m"] = entry(5, 20, 30);
    patch["adversary"][later] = entry(10, 24, 26);
    const Told told(replay_scenario("replay-ubb", {"zeta1"}, patch), {1, nullptr, {}});
    for (const auto& [k, source] : played(told))
      EXPECT_EQ(source, k >= 24 && k <= 26 ? 10 + (k - 24) % 3 : 5 + (k - 20) % 3) << later << " at " << k;
    EXPECT_EQ(played(told).size(), 11U);
  }
}

// False data that start before a replay are taken off by it, false data that start later are added to what is played.
TEST(Replay, MeetsFalseDataInTheOrderOfStarts) {
  Json patch = params({{"record_from", 5}, {"record_to", 7}, {"start", 20}, {"end", 30}});
  const auto bias = [](int from, int to) {
    return Json{{"type", "bias"}, {"on", {"sensor:1"}}, {"from", from}, {"to", to}, {"params", {{"vector", {1, 2}}}}};
  };
  patch["adversary"]["early"] = bias(18, 28);
  patch["adversary"]["late"] = bias(25, 33);
  const Told told(replay_scenario("replay-ubb", {"zeta1"}, patch), {1, nullptr, {}});
  for (std::int64_t k = 18; k <= 33; ++k) {
    const double early = k < 20 ? 2 : 0, late = k >= 25 ? 2 : 0;
    EXPECT_EQ(told.at(k, "sensor.1.y2.injected"), early + late) << k;
    const bool playing = k >= 20 && k <= 30;
    const double honest = playing ? told.at(5 + (k - 20) % 3, "sensor.1.y2") : told.at(k, "sensor.1.y2.sent");
    EXPECT_EQ(told.at(k, "sensor.1.y2"), honest + early + late) << k;
    EXPECT_EQ(told.at(k, "sensor.1.state"), k >= 25 || k < 20 ? 2 : 3) << k;
  }
}

TEST(Replay, PlaysTheChannelsItIsToldTo) {
  Json patch = params({{"record_from", 5}, {"record_to", 7}, {"start", 20}, {"end", 30}});
  patch["adversary"]["replay"]["on"] = {"sensor:1.y2"};
  const Told one(replay_scenario("replay-ubb", {"zeta1"}, patch), {1, nullptr, {}});
  EXPECT_TRUE(played(one).empty());
  EXPECT_EQ(played(one, "sensor.1.y2.source").size(), 11U);
  patch["adversary"]["replay"]["on"] = {"sensor:1.y2", "sensor:1.y1"};
  const Told both(replay_scenario("replay-ubb", {"zeta1"}, patch), {1, nullptr, {}});
  EXPECT_EQ(played(both), played(both, "sensor.1.y2.source"));
  EXPECT_EQ(played(both).size(), 11U);
}

TEST(Replay, OfASwitchedOffAttackDoesNothing) {
  Json patch = params(Json::object());
  patch["adversary"]["replay"]["enabled"] = false;
  const Told told(replay_scenario("replay-ubb", {"repaired"}, patch), {1, nullptr, {}});
  EXPECT_TRUE(played(told).empty());
  EXPECT_FALSE(told.has_metric("repaired", "tpr"));
  EXPECT_TRUE(told.has_metric("repaired", "fpr"));
}

struct Refused {
  Json params;
  const char* field;
  const char* words;  ///< of the value and of what was expected
};

TEST(Replay, RefusesASchedule) {
  const Refused table[] = {{{{"record_from", 60}, {"record_to", 59}}, "record_to", "the record from 60 to 59 is empty"},
                           {{{"record_to", 101}}, "record_to", "record_to is 101 and the replay starts at 101"},
                           {{{"start", 100}}, "record_to", "a record must end before it is played"},
                           {{{"start", 190}}, "end", "end is 180; the replay starts at 190"},
                           {{{"start", 1075}, {"end", 1100}},
                            "record_from",
                            "begins 1025 ticks before the replay; the adversary remembers 1024"},
                           {{{"case", 3}}, "case", "expected an integer >= 1 and <= 2"},
                           {{{"record_from", -1}}, "record_from", "record_from is -1; expected"},
                           {{{"end", 1.5}}, "end", "end is 1.5; expected"}};
  for (const Refused& row : table) {
    try {
      const vigil::Run run(replay_scenario("replay-ubb", {"zeta1"}, params(row.params)), {});
      ADD_FAILURE() << row.params;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, std::string("/adversary/replay/params/") + row.field);
      EXPECT_NE(error.problems().front().detail.find(row.words), std::string::npos) << error.what();
    }
  }
  const Json longest = {{"start", 1074}, {"end", 1100}};
  EXPECT_NO_THROW(vigil::Run(replay_scenario("replay-ubb", {"zeta1"}, params(longest)), {}));
}

TEST(Replay, NamesThePlaceThatIsNotThere) {
  Json patch = test::no_attack();
  patch["adversary"]["it"] = {{"type", "replay"}, {"on", {"actuator:1"}}};
  EXPECT_EQ(test::refusal(replay_scenario("replay-ubb", {"zeta1"}, patch)).problems().front().pointer,
            "/adversary/it/on");
  patch["adversary"]["it"]["on"] = {"sensor:1.y3"};
  EXPECT_EQ(test::refusal(replay_scenario("replay-ubb", {"zeta1"}, patch)).problems().front().pointer,
            "/adversary/it/on/0");
}

}  // namespace
}  // namespace vigil::replay_test
