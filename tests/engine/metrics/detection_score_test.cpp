#include "engine/metrics/detection_score.hpp"

#include <gtest/gtest.h>

#include <map>

namespace vigil::detection_score_test {
namespace {

using Figures = std::map<std::string, double>;

Figures figures(const DetectionScore& score, bool twin = true) {
  std::vector<MetricValue> metrics;
  score.append_metrics("lane", "", twin, metrics);
  Figures result;
  for (const MetricValue& m : metrics) {
    EXPECT_EQ(m.lane, "lane");
    EXPECT_TRUE(m.node.empty());
    result[m.name] = m.value;
  }
  return result;
}

/// One character a tick from tick 1 on: 'A' attacked; flags: '!' flagged, '?' flagged in the twin, '#' in both.
DetectionScore scored(const std::string& attacked, const std::string& flags, std::int64_t from, int tail) {
  EXPECT_EQ(attacked.size(), flags.size());
  DetectionScore score(from, tail);
  for (std::size_t i = 0; i < attacked.size(); ++i) {
    const bool alarm = flags[i] == '!' || flags[i] == '#', twin = flags[i] == '?' || flags[i] == '#';
    score.note(static_cast<std::int64_t>(i) + 1, attacked[i] == 'A', alarm, twin);
  }
  return score;
}

TEST(DetectionScore, CountsASeriesByHand) {
  //                                    1234567890123456
  const DetectionScore score = scored("......AAAAA.....",  //
                                      ".!..!...!!.!!..!", 4, 2);
  const Figures f = figures(score);
  EXPECT_DOUBLE_EQ(f.at("tpr"), 2.0 / 5);
  EXPECT_DOUBLE_EQ(f.at("fpr"), 2.0 / 6) << "ticks 4, 5, 6 and 14, 15, 16: flags at 5 and 16";
  EXPECT_DOUBLE_EQ(f.at("accuracy"), 8.0 / 16) << "all ticks count: quiet and silent 6, attacked and flagged 2";
  EXPECT_EQ(f.at("event"), 1);
  EXPECT_EQ(f.at("event_without_attack"), 0);
  EXPECT_EQ(f.at("delay"), 2);
  EXPECT_EQ(f.at("longest"), 2);
}

// An attack's samples leave the statistic with the last of t: t - 1 ticks are neither right nor wrong for the FPR, yet
// they are for the accuracy.
TEST(DetectionScore, LeavesTheTailOutOfTheFalseAlarms) {
  for (int tail = 0; tail <= 4; ++tail) {
    const Figures f = figures(scored("..AA....", "....!!!!", 1, tail));
    EXPECT_DOUBLE_EQ(f.at("fpr"), static_cast<double>(4 - tail) / (6 - tail)) << tail;
    EXPECT_DOUBLE_EQ(f.at("accuracy"), 2.0 / 8);
  }
}

TEST(DetectionScore, CountsFalseAlarmsFromItsFirstTick) {
  for (const std::int64_t from : {1, 3, 5, 9}) {
    const Figures f = figures(scored("........", "!!!!....", from, 4));
    if (from == 9) {
      EXPECT_FALSE(f.contains("fpr")) << "no tick to count";
    } else {
      EXPECT_DOUBLE_EQ(f.at("fpr"),
                       static_cast<double>(std::max<std::int64_t>(5 - from, 0)) / static_cast<double>(9 - from));
    }
    EXPECT_FALSE(f.contains("tpr") || f.contains("event") || f.contains("delay") || f.contains("longest"));
  }
}

TEST(DetectionScore, HasNoDelayWhereNothingWasFound) {
  const Figures missed = figures(scored("..AAA..", "!....!!", 1, 0));
  EXPECT_FALSE(missed.contains("delay"));
  EXPECT_EQ(missed.at("event"), 0);
  EXPECT_EQ(missed.at("longest"), 0);
  EXPECT_EQ(missed.at("tpr"), 0);
  EXPECT_EQ(figures(scored("..AAA..", "..!....", 1, 0)).at("delay"), 0);
}

TEST(DetectionScore, TellsTheTwinsEvent) {
  const DetectionScore twin_only = scored("..AAA..", "..?....", 1, 0);
  EXPECT_EQ(figures(twin_only).at("event"), 0);
  EXPECT_EQ(figures(twin_only).at("event_without_attack"), 1);
  EXPECT_FALSE(figures(twin_only, false).contains("event_without_attack"));
  EXPECT_EQ(figures(scored("..AAA..", "??.#.??", 1, 0)).at("event_without_attack"), 1);
  EXPECT_EQ(figures(scored("..AAA..", "??...??", 1, 0)).at("event_without_attack"), 0) << "outside the window";
}

// Two attacks: rates over both, the delay of the first flag from the first attack, runs do not join across the pause.
TEST(DetectionScore, TakesTwoAttacksTogether) {
  //                                    123456789012345
  const DetectionScore score = scored(".AAA...AAAA....",  //
                                      "...!!!!!!...!..", 1, 1);
  const Figures f = figures(score);
  EXPECT_DOUBLE_EQ(f.at("tpr"), 3.0 / 7);
  EXPECT_DOUBLE_EQ(f.at("fpr"), 3.0 / 6) << "1, 6, 7, 13, 14, 15 without the tails 5 and 12: flags at 6, 7, 13";
  EXPECT_EQ(f.at("delay"), 2);
  EXPECT_EQ(f.at("longest"), 2);
  EXPECT_EQ(figures(scored(".AA..AA.", ".....!!.", 1, 0)).at("delay"), 4) << "found at the second";
}

TEST(DetectionScore, NamesItsNodeAndForksByCopy) {
  DetectionScore score = scored("..A", "..!", 1, 0);
  DetectionScore copy = score;
  copy.note(4, true, false, false);
  EXPECT_EQ(figures(score).at("tpr"), 1);
  EXPECT_DOUBLE_EQ(figures(copy).at("tpr"), 0.5);
  std::vector<MetricValue> metrics;
  copy.append_metrics("lane", "7", false, metrics);
  for (const MetricValue& m : metrics) EXPECT_EQ(m.node, "7");
}

}  // namespace
}  // namespace vigil::detection_score_test
