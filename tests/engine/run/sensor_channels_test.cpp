#include "engine/run/sensor_channels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/engine/methods/rig.hpp"

namespace vigil::sensor_channels_test {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Two nodes of two channels; what is sent at tick k on channel c of node i is 1000 i + 10 k + c.
class Channels : public testing::Test {
 protected:
  void SetUp() override {
    const auto plant =
        Registry<PlantMake>::find("linear")->make(rig::completed<PlantMake>("linear", {{"A", {{1, 0}, {0, 1}}}}), 1);
    const auto sensor = Registry<SensorMake>::find("linear")->make(
        rig::completed<SensorMake>("linear", {{"C", {{1, 0}, {0, 1}}}}), *plant);
    sensors = {sensor, sensor};
    world.plant = plant;
    world.sensors = sensors;
    world.process_covariance = 0.1 * Eigen::Matrix2d::Identity();
    course = Course(world);
    effects.resize({2, 2});
  }

  static double value(int node, std::int64_t k, int channel) {
    return 1000.0 * node + 10.0 * static_cast<double>(k) + channel;
  }

  /// Ticks up to and with `to`, nobody interferes but `act`.
  template <class Act>
  void pass(SensorChannels& channels, std::int64_t to, Act&& act) {
    while (k < to) {
      ++k;
      effects.clear();
      act(k);
      for (int i = 0; i < 2; ++i)
        course.sent[static_cast<std::size_t>(i)] = Eigen::Vector2d(value(i, k, 0), value(i, k, 1));
      for (const auto& [tick, node, channel] : holes) {
        if (tick == k) course.sent[static_cast<std::size_t>(node)][channel] = kMissing;
      }
      channels.carry(k, world, effects, course);
    }
  }
  void pass(SensorChannels& channels, std::int64_t to) {
    pass(channels, to, [](std::int64_t) {});
  }
  double got(int node, int channel) const { return course.received[static_cast<std::size_t>(node)][channel]; }

  struct Hole {
    std::int64_t tick;
    int node, channel;
  };
  std::vector<std::shared_ptr<const Sensor>> sensors;
  std::vector<Hole> holes;
  SensorEffects effects;
  World world;
  Course course;
  std::int64_t k = -1;
};

TEST_F(Channels, CarryWhatIsSentWhereNobodyInterferes) {
  SensorChannels channels(sensors, 50);
  pass(channels, 20);
  EXPECT_EQ(got(0, 1), 201);
  EXPECT_EQ(got(1, 0), 1200);
}

TEST_F(Channels, PlayARecordBackAtTheirNodeOnly) {
  SensorChannels channels(sensors, 50);
  pass(channels, 20, [&](std::int64_t tick) {
    if (tick >= 11) effects.play({1, -1}, {3, 6, 3 + (tick - 11) % 4});
  });
  EXPECT_EQ(got(0, 0), 200);
  EXPECT_EQ(got(1, 0), value(1, 4, 0));  // 3 + 9 % 4
  EXPECT_EQ(got(1, 1), value(1, 4, 1));
  EXPECT_EQ(course.sent[1][0], 1200) << "the honest value stays";
}

TEST_F(Channels, PlayOneChannelAndLeaveTheOther) {
  SensorChannels channels(sensors, 50);
  pass(channels, 20, [&](std::int64_t tick) {
    if (tick >= 11) effects.play({0, 1}, {5, 5, 5});
  });
  EXPECT_EQ(got(0, 0), 200);
  EXPECT_EQ(got(0, 1), value(0, 5, 1));
}

// Two records on the two channels of one sensor at the same time.
TEST_F(Channels, PlayEachChannelsOwnRecord) {
  SensorChannels channels(sensors, 50);
  pass(channels, 20, [&](std::int64_t tick) {
    if (tick >= 11) effects.play({0, 0}, {2, 4, 3});
    if (tick >= 15) effects.play({0, 1}, {5, 9, 7});
  });
  EXPECT_EQ(got(0, 0), value(0, 3, 0));
  EXPECT_EQ(got(0, 1), value(0, 7, 1));
}

TEST_F(Channels, AddWhatIsInjectedToWhatIsPlayed) {
  SensorChannels channels(sensors, 50);
  pass(channels, 12, [&](std::int64_t tick) {
    effects.add({0, -1}, Eigen::Vector2d(7, 7), SensorState::fdi);  // taken off by the playback that starts later
    if (tick >= 11) effects.play({0, -1}, {2, 4, 3});
    if (tick >= 12) effects.add({0, 0}, Eigen::VectorXd::Constant(1, 0.5), SensorState::fdi);
  });
  EXPECT_EQ(got(0, 0), value(0, 3, 0) + 0.5);
  EXPECT_EQ(got(0, 1), value(0, 3, 1));
}

TEST_F(Channels, TheLaterPlaybackWins) {
  SensorChannels channels(sensors, 50);
  const auto both = [&](std::int64_t tick) {
    if (tick >= 11) effects.play({0, -1}, {2, 4, 2 + (tick - 11) % 3});
    if (tick >= 15 && tick < 18) effects.play({0, -1}, {7, 8, 7});
  };
  pass(channels, 15, both);
  EXPECT_EQ(got(0, 0), value(0, 7, 0));
  pass(channels, 18, both);
  EXPECT_EQ(got(0, 0), value(0, 3, 0)) << "the earlier goes on where the later has ended: 2 + 7 % 3";
}

TEST_F(Channels, KeepWhatTheyPlayWhenTheMemoryHasPassedIt) {
  SensorChannels channels(sensors, std::nullopt);
  pass(channels, 5000, [&](std::int64_t tick) {
    if (tick >= 1000) effects.play({0, -1}, {10, 900, 10 + (tick - 1000) % 891});
  });
  EXPECT_EQ(got(0, 0), value(0, 10 + 4000 % 891, 0));
}

TEST_F(Channels, RememberSoManyTicksAndNoMore) {
  for (const auto& [start, known] : {std::pair{1034, true}, std::pair{1035, false}}) {
    k = -1;
    SensorChannels channels(sensors, std::nullopt);
    pass(channels, start, [&, first = start](std::int64_t tick) {
      if (tick >= first) effects.play({0, -1}, {10, 12, 10});
    });
    EXPECT_EQ(std::isfinite(got(0, 0)), known) << start - 10 << " ticks back, memory " << SensorChannels::kMemory;
    if (known) {
      EXPECT_EQ(got(0, 0), value(0, 10, 0));
    }
  }
}

// Specification, section 10: in the record the last good one is replayed.
TEST_F(Channels, FillAGapInTheRecordWithTheLastGoodValue) {
  holes = {{4, 0, 0}, {5, 0, 0}, {5, 0, 1}};
  SensorChannels channels(sensors, 50);
  const auto act = [&](std::int64_t tick) {
    if (tick >= 11) effects.play({0, -1}, {3, 6, 3 + (tick - 11)});
  };
  const double expected[4][2] = {{30, 31}, {30, 41}, {30, 41}, {60, 61}};
  for (int i = 0; i < 4; ++i) {
    pass(channels, 11 + i, act);
    EXPECT_EQ(got(0, 0), expected[i][0]) << i;
    EXPECT_EQ(got(0, 1), expected[i][1]) << i;
  }
}

TEST_F(Channels, PlayNothingWhereNothingGoodWasSent) {
  holes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  SensorChannels channels(sensors, 50);
  pass(channels, 11, [&](std::int64_t tick) {
    if (tick >= 11) effects.play({0, -1}, {2, 3, 2});
  });
  EXPECT_TRUE(std::isnan(got(0, 0)));
  EXPECT_EQ(got(0, 1), value(0, 2, 1));
}

TEST_F(Channels, AMissingReadingIsReplacedByWhatIsPlayed) {
  holes = {{11, 0, 0}};
  SensorChannels channels(sensors, 50);
  pass(channels, 11, [&](std::int64_t tick) {
    if (tick >= 11) effects.play({0, -1}, {2, 3, 2});
  });
  EXPECT_EQ(got(0, 0), value(0, 2, 0));
}

}  // namespace
}  // namespace vigil::sensor_channels_test
