/// The tracked target and its stations: gains, poles, track, Jacobians, the places where an angle has no direction.
/// Specification of seed 001, sections 3, 4 and 15.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/core/input_error.hpp"
#include "engine/random/draws.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"
#include "tests/engine/world/differences.hpp"

namespace vigil::radar_test {
namespace {

constexpr double kPi = std::numbers::pi;
const Eigen::VectorXd kNone;

template <class Make>
Params completed(const std::string& id, const Json& given) {
  std::vector<Problem> problems;
  const Json values = Registry<Make>::find(id)->params.complete(given, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return Params(values);
}

std::shared_ptr<const Plant> tracker(const Json& given = Json::object(), double dt = 0.05) {
  return Registry<PlantMake>::find("tracker")->make(completed<PlantMake>("tracker", given), dt);
}

std::shared_ptr<const Sensor> station(const Json& position, const Json& more = Json::object()) {
  Json given = more;
  given["position"] = position;
  return Registry<SensorMake>::find("station")->make(completed<SensorMake>("station", given), *tracker());
}

Eigen::MatrixXd loop_of(const Plant& plant) {
  Eigen::MatrixXd F(6, 6);
  plant.jacobian(Eigen::VectorXd::Zero(6), kNone, F);
  return F;
}

Eigen::VectorXd state(double px, double py, double pz, double vx = 0, double vy = 0, double vz = 0) {
  Eigen::VectorXd x(6);
  x << px, vx, py, vy, pz, vz;
  return x;
}

// The velocity row of an axis is [Ts g1, 1 + Ts g2].
TEST(Tracker, HasTheGainsOfTheSpecification) {
  const Eigen::MatrixXd F = loop_of(*tracker());
  const double Ts = 0.05, g[3][2] = {{-0.08, -0.398}, {-0.32, -0.792}, {-0.72, -1.182}};
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(F(2 * a + 1, 2 * a) / Ts, g[a][0], 1e-11);
    EXPECT_NEAR((F(2 * a + 1, 2 * a + 1) - 1) / Ts, g[a][1], 1e-11);
    EXPECT_NEAR(F(2 * a, 2 * a), 1 + Ts * Ts / 2 * g[a][0], 1e-14);
    EXPECT_NEAR(F(2 * a, 2 * a + 1), Ts + Ts * Ts / 2 * g[a][1], 1e-14);
    for (int b = 0; b < 3; ++b) {
      EXPECT_TRUE(a == b || (F.block<2, 2>(2 * a, 2 * b).isZero(0)));
    }
  }
}

TEST(Tracker, HasItsPoles) {
  const Json given = {{"poles_x", {0.5, 0.3}}, {"poles_y", {0.9, 0}}, {"poles_z", {-0.2, 1.1}}};
  const double poles[3][2] = {{0.5, 0.3}, {0.9, 0}, {-0.2, 1.1}};
  for (const double dt : {0.05, 1.0, 7.0}) {
    const Eigen::MatrixXd F = loop_of(*tracker(given, dt));
    for (int a = 0; a < 3; ++a) {
      const Eigen::Matrix2d axis = F.block<2, 2>(2 * a, 2 * a);
      const Eigen::Vector2cd roots = Eigen::EigenSolver<Eigen::Matrix2d>(axis, false).eigenvalues();
      for (int r = 0; r < 2; ++r) {
        EXPECT_NEAR(roots[r].real(), poles[a][0], 1e-6);  // a double pole moves by the root of the rounding
        EXPECT_NEAR(std::abs(roots[r].imag()), poles[a][1], 1e-6);
      }
      EXPECT_NEAR(axis.trace(), 2 * poles[a][0], 1e-12);
      EXPECT_NEAR(axis.determinant(), poles[a][0] * poles[a][0] + poles[a][1] * poles[a][1], 1e-12);
    }
  }
}

TEST(Tracker, FliesTheTrackOfTheSpecification) {
  const auto plant = tracker();
  Eigen::VectorXd x = state(10, 10, 8), next(6);
  const Eigen::MatrixXd F = loop_of(*plant);
  double lowest = 0;
  for (int k = 1; k <= 200; ++k) {
    plant->advance(x, kNone, next);
    EXPECT_LT((next - F * x).norm(), 1e-13);
    x = next;
    lowest = std::min(lowest, x[2]);
  }
  EXPECT_NEAR(x[0], 0.62, 0.01);
  EXPECT_NEAR(x[2], -0.25, 0.01);
  EXPECT_NEAR(x[4], 0.02, 0.01);
  EXPECT_NEAR(lowest, -0.46, 0.01);
}

TEST(Tracker, IsLinearAndScoresPositionAndVelocity) {
  const auto plant = tracker();
  EXPECT_TRUE(plant->linear());
  EXPECT_EQ(plant->inputs(), 0);
  const char* names[] = {"px", "vx", "py", "vy", "pz", "vz"};
  for (int c = 0; c < 6; ++c) EXPECT_EQ(plant->state()[static_cast<std::size_t>(c)].name, names[c]);
  ASSERT_EQ(plant->errors().size(), 2U);
  EXPECT_EQ(plant->errors()[0].name, "position");
  EXPECT_EQ(plant->errors()[0].components, (std::vector<int>{0, 2, 4}));
  EXPECT_EQ(plant->errors()[1].name, "velocity");
  EXPECT_EQ(plant->errors()[1].components, (std::vector<int>{1, 3, 5}));
}

void expect_refused(const Json& params, double dt, const std::string& pointer) {
  try {
    tracker(params, dt);
    ADD_FAILURE() << params << " at " << dt;
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().pointer, pointer) << error.what();
  }
}

TEST(Tracker, RefusesAStepThatCannotBeInverted) {
  expect_refused({{"poles_x", {0, 0}}}, 0.05, "/poles_x");
  expect_refused({{"poles_y", {1e-7, -1e-7}}}, 0.05, "/poles_y");
  expect_refused({{"poles_z", {0.9}}}, 0.05, "/poles_z");
  expect_refused({{"poles_z", {1e300, 0}}}, 0.05, "/poles_z");
  expect_refused(Json::object(), 1e-200, "/poles_x");
  EXPECT_NO_THROW(tracker({{"poles_x", {1e-5, 0}}}));
}

Eigen::VectorXd drawn(std::int64_t trial, double scale) {
  Eigen::VectorXd x(6);
  Draws(9, "station").normals(trial, x);
  return scale * x;
}

void expect_jacobian(const Sensor& sensor, const Eigen::VectorXd& x) {
  const auto h = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd z(6);
    sensor.measure(at, z);
    return z;
  };
  const auto apart = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    Eigen::VectorXd difference = a - b;
    for (int c = 0; c < 6; ++c)
      difference[c] = wrap(difference[c], sensor.channels()[static_cast<std::size_t>(c)].period);
    return difference;
  };
  Eigen::MatrixXd H(6, 6);
  sensor.jacobian(x, H);
  EXPECT_LT((H - central_differences(h, x, apart, 1e-6)).cwiseAbs().maxCoeff(), 1e-6) << x.transpose();
}

TEST(Station, HasItsJacobian) {
  for (const Json& position : {Json{-6, 8, 0}, Json{0, -10, 3.5}, Json{100, 20, -7}}) {
    const auto sensor = station(position);
    const auto s = position.get<std::vector<double>>();
    int tested = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const Eigen::VectorXd x = drawn(trial, 12);
      if (std::hypot(x[0] - s[0], x[2] - s[1]) < 1) continue;  // third derivatives grow with 1 / distance^3
      expect_jacobian(*sensor, x);
      ++tested;
    }
    EXPECT_GT(tested, 250);
    // Across the negative x axis seen from the station, where the azimuth jumps by a turn.
    for (const double y : {0.0, 1e-9, -1e-9, 1e-3})
      expect_jacobian(*sensor, state(s[0] - 5, s[1] + y, s[2] + 2, 1, 2, 3));
  }
}

TEST(Station, MeasuresByHand) {
  const auto sensor = station({-6, 8, 0});
  Eigen::VectorXd z(6);
  sensor->measure(state(-3, 12, 12, 0.5, -1, 2), z);  // (3, 4, 12) away: 5 on the ground, 13 in all
  EXPECT_DOUBLE_EQ(z[0], 13);
  EXPECT_DOUBLE_EQ(z[1], std::atan2(4, 3));
  EXPECT_DOUBLE_EQ(z[2], std::atan2(12, 5));
  EXPECT_EQ(z.tail(3), Eigen::Vector3d(0.5, -1, 2));
  sensor->measure(state(-10, 5, 0), z);  // behind it: the quadrant is kept
  EXPECT_DOUBLE_EQ(z[1], std::atan2(-3, -4));
  EXPECT_LT(z[1], -kPi / 2);
  EXPECT_EQ(sensor->channels()[1].period, 2 * kPi);
  EXPECT_EQ(sensor->channels()[2].period, 0);
  EXPECT_EQ(*sensor->position(), Eigen::Vector2d(-6, 8));
  EXPECT_TRUE(sensor->noise().isApprox(1e-4 * Eigen::MatrixXd::Identity(6, 6), 0));
}

// The printed azimuth row lacks one division by the horizontal distance; nothing else differs.
TEST(Station, PrintsItsAzimuthRowWithoutOneDivision) {
  const auto sensor = station({-10, 0, 0});
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::VectorXd x = drawn(trial, 8);
    Eigen::MatrixXd H(6, 6), printed(6, 6);
    sensor->jacobian(x, H);
    sensor->jacobian_as_printed(x, printed);
    EXPECT_TRUE(printed.row(1).isApprox(H.row(1) * std::hypot(x[0] + 10, x[2]), 1e-13));
    H.row(1) = printed.row(1);
    EXPECT_EQ(H, printed);
  }
}

// Straight above, at the station and nearer than the clamp: finite, range and velocities still say what they say.
TEST(Station, StaysFiniteStraightBelowTheTarget) {
  const auto sensor = station({3, -2, 1});
  Eigen::VectorXd z(6);
  Eigen::MatrixXd H(6, 6), printed(6, 6);
  for (const double off : {0.0, 1e-300, 1e-160, 1e-12, 1e-7, 1e-5}) {
    for (const double height : {0.0, 1e-9, 5.0, -5.0}) {
      const Eigen::VectorXd x = state(3 + off, -2 - off, 1 + height, 1, 2, 3);
      sensor->measure(x, z);
      sensor->jacobian(x, H);
      sensor->jacobian_as_printed(x, printed);
      EXPECT_TRUE(z.allFinite() && H.allFinite() && printed.allFinite()) << off << " " << height;
      EXPECT_LE(H.row(1).norm(), 1.5e6);
      EXPECT_TRUE(std::abs(height) != 5 || std::abs(H(0, 4) - height / 5) < 1e-11);  // up to 3e-6 rad off the vertical
      EXPECT_TRUE(sensor->limited(x) == (off < 1e-6));
      EXPECT_TRUE(H.bottomRows(3).isApprox(printed.bottomRows(3), 0));
      EXPECT_EQ(H(3, 1), 1);
    }
  }
  sensor->jacobian(state(1e200, -1e200, 1e200), H);
  EXPECT_TRUE(H.allFinite());
}

TEST(Station, RefusesWhatDoesNotFit) {
  EXPECT_THROW(station({1, 2}), InputError);
  EXPECT_THROW(station({1, 2, "up"}), InputError);
  EXPECT_THROW(station({1, 2, 3}, {{"R", {1, 2, 3}}}), InputError);
  EXPECT_NO_THROW(station({1, 2, 3}, {{"R", {1, 2, 3, 4, 5, 6}}}));
  const auto robot = Registry<PlantMake>::find("unicycle")->make(completed<PlantMake>("unicycle", Json::object()), 1);
  EXPECT_THROW(
      Registry<SensorMake>::find("station")->make(completed<SensorMake>("station", {{"position", {0, 0, 0}}}), *robot),
      InputError);
}

}  // namespace
}  // namespace vigil::radar_test
