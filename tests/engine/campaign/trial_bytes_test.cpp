/// A trial that went through bytes is the trial; bytes that are none are refused.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/bytes.hpp"
#include "engine/run/campaign.hpp"
#include "engine/run/trace.hpp"
#include "tests/engine/campaign/everything.hpp"

namespace vigil::trial_bytes_test {
namespace {

class TrialBytes : public testing::TestWithParam<const char*> {};

// Bounds (consensus), pooled ratios (privacy), counts of detectors (replay).
TEST_P(TrialBytes, GiveTheSameTable) {
  const Scenario scenario = Scenario::preset(GetParam()).with("time.steps", 25);
  CampaignTable here, elsewhere;
  TrialColumns columns_here, columns_elsewhere;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const TrialResult trial = run_trial(scenario, seed);
    const std::string bytes = save_trial(trial);
    const TrialResult back = load_trial(bytes);
    EXPECT_EQ(save_trial(back), bytes);
    EXPECT_EQ(back.seed, seed);
    EXPECT_EQ(back.ticks, trial.ticks);
    EXPECT_EQ(back.design.dump(), trial.design.dump());
    EXPECT_EQ(back.warnings, trial.warnings);
    ASSERT_EQ(back.faults.size(), trial.faults.size());
    for (std::size_t i = 0; i < back.faults.size(); ++i) EXPECT_EQ(to_json(back.faults[i]), to_json(trial.faults[i]));
    EXPECT_EQ(columns_here.encode(trial), columns_elsewhere.encode(back));
    here.add(trial);
    elsewhere.add(back);
  }
  EXPECT_EQ(everything(here), everything(elsewhere));
  EXPECT_EQ(here.save(), elsewhere.save());
  EXPECT_EQ(columns_here.to_json(), columns_elsewhere.to_json());
}

INSTANTIATE_TEST_SUITE_P(Presets, TrialBytes,
                         testing::Values("consensus", "privacy-turn", "replay-nongaussian", "sparse"),
                         [](const auto& preset) {
                           std::string name = preset.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(TrialBytesOf, AFailedTrialKeepsItsReason) {
  TrialResult failed;
  failed.seed = 7;
  failed.error = "It could not be run.";
  const TrialResult back = load_trial(save_trial(failed));
  EXPECT_EQ(back.error, failed.error);
  EXPECT_EQ(back.seed, 7u);
  EXPECT_TRUE(back.design.is_null());
  EXPECT_EQ(back.extra, nullptr);
}

TEST(TrialBytesOf, GarbageIsRefused) {
  const std::string good = save_trial(run_trial(Scenario::preset("consensus").with("time.steps", 3), 1));
  EXPECT_THROW(load_trial(""), std::runtime_error);
  EXPECT_THROW(load_trial(good + "x"), std::runtime_error);
  EXPECT_THROW(load_trial(std::string(5000, '\xff')), std::runtime_error);
  EXPECT_THROW(load_trial(good.substr(0, 8) + std::string(200'000, '[')), std::runtime_error);
  for (std::size_t size = 0; size < good.size(); size += 1 + size / 50)
    EXPECT_THROW(load_trial(good.substr(0, size)), std::runtime_error) << size;
}

// Whatever byte is wrong: refused, or a trial that a table can take.
TEST(TrialBytesOf, AnyDamagedByteIsSurvived) {
  const std::string good = save_trial(run_trial(Scenario::preset("replay-nongaussian").with("time.steps", 4), 1));
  int refused = 0;
  for (std::size_t place = 0; place < good.size(); place += 1 + place / 200) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ 0x81);
    try {
      CampaignTable table;
      table.add(load_trial(bad));
      EXPECT_EQ(table.trials(), 1);
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(TraceBytes, KeepEveryBit) {
  const Trace trace = Trace::from_csv("k,t,sensor.1.range,input.u\n3,0.3,1.1,\n4,0.4,-0,2e-300\n");
  const Trace back = Trace::load(trace.save());
  EXPECT_EQ(back.save(), trace.save());
  EXPECT_EQ(back.first_tick(), 3);
  EXPECT_EQ(back.rows(), 2);
  EXPECT_EQ(back.dt(), trace.dt());
  EXPECT_EQ(back.columns(), trace.columns());
  EXPECT_EQ(back.find("input.u"), 1);
  EXPECT_TRUE(std::isnan(back.at(3, 1)));
  EXPECT_TRUE(std::signbit(back.at(4, 0)));
  const std::string good = trace.save();
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_THROW(Trace::load(good.substr(0, size)), std::runtime_error) << size;
  EXPECT_THROW(Trace::load(good + "x"), std::runtime_error);
  EXPECT_THROW(Trace::growing({"input.u"}).save(), std::logic_error);
}

}  // namespace
}  // namespace vigil::trial_bytes_test
