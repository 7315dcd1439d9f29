/// Plants and sensors: Jacobians, the gauge that no camera can see, angles.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/core/input_error.hpp"
#include "engine/random/draws.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"
#include "tests/engine/world/differences.hpp"

namespace vigil::models_test {
namespace {

template <class Make>
Params completed(const std::string& id, const Json& given = Json::object()) {
  std::vector<Problem> problems;
  const Json values = Registry<Make>::find(id)->params.complete(given, "", problems);
  EXPECT_TRUE(problems.empty());
  return Params(values);
}

std::shared_ptr<const Plant> plant_of(const std::string& id, const Json& given = Json::object(), double dt = 0.5) {
  return Registry<PlantMake>::find(id)->make(completed<PlantMake>(id, given), dt);
}

std::shared_ptr<const Sensor> sensor_of(const std::string& id, const Plant& plant, const Json& given) {
  return Registry<SensorMake>::find(id)->make(completed<SensorMake>(id, given), plant);
}

Eigen::VectorXd draw(const char* stream, std::int64_t tick, int size, double scale) {
  Eigen::VectorXd values(size);
  Draws(4, stream).normals(tick, values);
  return scale * values;
}

TEST(Plants, HaveTheirJacobians) {
  const Json own = {{"A", {{1, -0.1, 0}, {0.1, 0.9, 2}, {0, -3, 0.5}}}, {"B", {{0.7, 0}, {0.3, 1}, {0, -2}}}};
  const Json one = {{"subsystems", {{"1", {{"A", {{-1, 0.5}, {0, -2}}}, {"C", {{1, 0}, {0, 1}}}}}}}};
  for (const auto& entry : Registry<PlantMake>::all()) {
    const auto plant = plant_of(entry.id, entry.id == "linear"           ? own
                                          : entry.id == "interconnected" ? one
                                                                         : Json::object());
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::VectorXd x = draw("state", trial, plant->states(), 50);
      const Eigen::VectorXd u = draw("input", trial, plant->inputs(), 3);
      const auto f = [&](const Eigen::VectorXd& at) {
        Eigen::VectorXd next(plant->states());
        plant->advance(at, u, next);
        return next;
      };
      Eigen::MatrixXd F(plant->states(), plant->states());
      plant->jacobian(x, u, F);
      const auto minus = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return Eigen::VectorXd(a - b); };
      EXPECT_LT((F - central_differences(f, x, minus)).cwiseAbs().maxCoeff(), 1e-7) << entry.id;
    }
  }
}

void expect_sensor_jacobian(const Sensor& sensor, const Eigen::VectorXd& x) {
  const auto h = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd z(sensor.size());
    sensor.measure(at, z);
    return z;
  };
  const auto apart = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    Eigen::VectorXd difference = a - b;
    for (int c = 0; c < sensor.size(); ++c)
      difference[c] = wrap(difference[c], sensor.channels()[static_cast<std::size_t>(c)].period);
    return difference;
  };
  Eigen::MatrixXd H(sensor.size(), x.size());
  sensor.jacobian(x, H);
  EXPECT_LT((H - central_differences(h, x, apart, 1e-6)).cwiseAbs().maxCoeff(), 2e-6) << x.transpose();
}

TEST(Sensors, HaveTheirJacobians) {
  const double kappas[] = {std::numbers::pi / 180, 1};
  for (const double kappa : kappas) {
    const auto plant = plant_of("unicycle_wheels", {{"kappa", kappa}});
    const auto camera = sensor_of("camera", *plant, {{"position", {60, 180}}, {"kappa", kappa}});
    const auto compass = sensor_of("camera", *plant, {{"position", {60, 180}}, {"kappa", kappa}, {"compass", true}});
    const auto landmark = sensor_of("range_bearing", *plant, {{"position", {3, -2}}});
    EXPECT_EQ(compass->size(), 3);
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::VectorXd x = draw("place", trial, 3, 40);
      for (const Sensor* sensor : {camera.get(), compass.get(), landmark.get()}) expect_sensor_jacobian(*sensor, x);
    }
  }
}

// Turning the robot about the camera changes nothing that the camera sees, and the prediction carries this direction
// into itself: section 2.
TEST(Camera, CannotSeeItsOwnRotationGauge) {
  const double kappa = std::numbers::pi / 180;
  const auto plant = plant_of("unicycle_wheels");
  const Eigen::Vector2d place(240, 160);
  const auto camera = sensor_of("camera", *plant, {{"position", {240, 160}}});
  const auto gauge = [&](const Eigen::VectorXd& x) {
    return Eigen::Vector3d(-(x[1] - place[1]) * kappa, (x[0] - place[0]) * kappa, 1);
  };
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::VectorXd x = draw("gauge", trial, 3, 120);
    Eigen::MatrixXd H(2, 3), F(3, 3);
    camera->jacobian(x, H);
    EXPECT_LT((H * gauge(x)).norm(), 1e-12 * H.norm() * gauge(x).norm());
    Eigen::VectorXd next(3);
    const Eigen::VectorXd none(0);
    plant->jacobian(x, none, F);
    plant->advance(x, none, next);
    EXPECT_LT((F * gauge(x) - gauge(next)).norm(), 1e-12 * gauge(x).norm());
  }
}

// The numbers of section 5's robot: a left turn of 9.167 degrees and 8 cm a step, (43)-(45); and (46)-(47) by hand.
TEST(Models, GiveTheNumbersOfTheSpecification) {
  const auto plant = plant_of("unicycle_wheels");
  Eigen::VectorXd next(3);
  plant->advance(Eigen::Vector3d(150, 70, 0), Eigen::VectorXd(0), next);
  EXPECT_NEAR(next[0], 158, 1e-12);
  EXPECT_NEAR(next[1], 70, 1e-12);
  EXPECT_NEAR(next[2], 9.16732472209, 1e-9);
  const auto camera = sensor_of("camera", *plant, {{"position", {60, 60}}});
  Eigen::VectorXd z(2);
  camera->measure(Eigen::Vector3d(150, 70, 0), z);
  EXPECT_NEAR(z[0], 9.0213283 / 2.105 * (-10 - 5.36) + 347.20436, 1e-9);
  EXPECT_NEAR(z[1], 9.0250141 / 2.105 * (90 + 6.68) + 284.3475, 1e-9);
}

TEST(RangeBearing, StaysFiniteOnTopOfItsLandmark) {
  const auto plant = plant_of("unicycle");
  const auto sensor = sensor_of("range_bearing", *plant, {{"position", {3, -2}}});
  Eigen::VectorXd z(2);
  Eigen::MatrixXd H(2, 3);
  for (const double off : {0.0, 1e-300, 1e-160, 1e-8}) {
    const Eigen::Vector3d x(3 - off, -2, 0.3);
    sensor->measure(x, z);
    sensor->jacobian(x, H);
    EXPECT_TRUE(z.allFinite() && H.allFinite()) << off;
  }
}

TEST(Wrap, MapsToTheHalfOpenInterval) {
  for (const double period : {360.0, 2 * std::numbers::pi, 1.0}) {
    EXPECT_EQ(wrap(period / 2, period), -period / 2);
    EXPECT_EQ(wrap(-period / 2, period), -period / 2);
    EXPECT_EQ(wrap(0, period), 0);
    for (int trial = 0; trial < 500; ++trial) {
      const double value = 20 * period * draw("angle", trial, 1, 1)[0];
      const double wrapped = wrap(value, period);
      EXPECT_GE(wrapped, -period / 2 * (1 + 1e-14));
      EXPECT_LE(wrapped, period / 2 * (1 + 1e-14));
      const double turns = (value - wrapped) / period;
      EXPECT_NEAR(turns, std::round(turns), 1e-12);
    }
  }
  EXPECT_EQ(wrap(190, 360), -170);
  EXPECT_EQ(wrap(-190, 360), 170);
  EXPECT_EQ(wrap(725, 360), 5);
  EXPECT_EQ(wrap(12345.5, 0), 12345.5);
  EXPECT_TRUE(std::isnan(wrap(std::nan(""), 360)));
}

TEST(Models, RefuseWhatDoesNotFit) {
  const auto plant = plant_of("unicycle");
  for (const std::string pointer : {"/R", "/position"}) {
    try {
      if (pointer == "/R") {
        sensor_of("range_bearing", *plant, {{"position", {0, 0}}, {"R", {1, 2, 3}}});
      } else {
        sensor_of("range_bearing", *plant, {{"position", nullptr}});
      }
      FAIL();
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, pointer);
    }
  }
}

}  // namespace
}  // namespace vigil::models_test
