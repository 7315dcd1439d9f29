// Recordings of UTIAS MRCLAM: the importer on a recording made here, and the real robot where the data is at hand.
#include "engine/run/mrclam.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/engine/runs/capture.hpp"

namespace vigil::mrclam_test {
namespace {

MrclamFiles small() {
  return {"# subject barcode\n3 41\n6 72\n7 27\n", "6 1.0 2.0 0 0\n7 -1.0 0.5 0 0\n",
          "100.0 0 0 3.1\n101.0 1 0 -3.1\n102.0 2 0 -3.0\n",
          "100.48 72 2.0 0.5\n100.52 72 4.0 0.7\n101.0 41 1 0\n101.0 99 1 0\n101.2 27 3 -3.14\n",
          "100.0 1.0 0.0\n100.5 3.0 1.0\n102.0 0 0\n"};
}

TEST(Mrclam, ImportsByItsRules) {
  const Trace trace = Trace::from_csv(mrclam_to_csv(small(), 0.5));
  ASSERT_EQ(trace.rows(), 5);
  const auto at = [&](std::int64_t k, const char* name) { return trace.at(k, trace.find(name)); };
  EXPECT_NEAR(at(1, "truth.x"), 0.5, 1e-12);
  EXPECT_NEAR(at(1, "truth.theta"), std::acos(-1.0), 1e-6) << "the short way round";
  EXPECT_GT(at(2, "truth.theta"), 3.1) << "unwrapped";
  EXPECT_NEAR(at(1, "input.v"), 1, 1e-12);
  EXPECT_NEAR(at(2, "input.v"), 3, 1e-12);
  EXPECT_NEAR(at(2, "input.omega"), 1, 1e-12);
  EXPECT_NEAR(at(1, "sensor.6.range"), 3, 1e-12) << "two readings of one landmark in a tick are averaged";
  EXPECT_NEAR(at(1, "sensor.6.bearing"), 0.6, 1e-12);
  EXPECT_TRUE(std::isnan(at(2, "sensor.6.range")));
  EXPECT_NEAR(at(2, "sensor.7.range"), 3, 1e-12) << "101.2 s is nearest to tick 2";
  EXPECT_EQ(at(0, "node.7.position.x"), -1);
  EXPECT_EQ(trace.find("sensor.3.range"), -1) << "another robot is no landmark";
}

TEST(Mrclam, RefusesWhatIsNoRecording) {
  const auto refuse = [](auto change, const char* pointer) {
    MrclamFiles files = small();
    change(files);
    try {
      mrclam_to_csv(files, 0.5);
      ADD_FAILURE() << pointer;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, pointer) << error.what();
    }
  };
  refuse([](MrclamFiles& f) { f.odometry = "100 1\n"; }, "/Odometry");
  refuse([](MrclamFiles& f) { f.measurement = "100 72 two 0\n"; }, "/Measurement");
  refuse([](MrclamFiles& f) { f.groundtruth = "# nothing\n"; }, "/Groundtruth");
  refuse([](MrclamFiles& f) { f.odometry = "900 1 0\n901 1 0\n"; }, "/odometry");
  EXPECT_THROW(mrclam_to_csv(small(), 0), InputError);
  EXPECT_THROW(mrclam_to_csv(small(), 1e-12), InputError);
}

TEST(Mrclam, TheRealRobot) {
  const char* shared = std::getenv("VIGIL_SHARED");
  const std::filesystem::path folder =
      std::filesystem::path(shared != nullptr ? shared : VIGIL_SOURCE_DIR "/../shared") / "data/mrclam6-robot3";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the recording is not at hand: " << folder;
  const auto read = [&](const char* name) {
    std::ifstream file(folder / name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  };
  const MrclamFiles files{read("Barcodes.dat"), read("Landmark_Groundtruth.dat"), read("Robot3_Groundtruth.dat"),
                          read("Robot3_Measurement.dat"), read("Robot3_Odometry.dat")};
  vigil::Run run(Scenario::preset("mrclam"),
                 {1, std::make_shared<Trace>(Trace::from_csv(mrclam_to_csv(files, 0.1))), {}});
  test::Capture capture;
  test::run_to_end(run, capture);
  EXPECT_NEAR(run.dt() * static_cast<double>(run.tick()), 887, 1);
  const auto rmse = [&](const char* lane) { return test::metric(run.metrics(), lane, "rmse_position"); };
  EXPECT_LE(rmse("centralized"), 0.40);
  EXPECT_LE(rmse("centralized_gated"), 0.30);
  EXPECT_NEAR(rmse("dead_reckoning"), 4.26, 0.01);
  EXPECT_LT(rmse("consensus"), rmse("isolated"));
}

}  // namespace
}  // namespace vigil::mrclam_test
