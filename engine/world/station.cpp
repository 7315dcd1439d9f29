/// A ground station: range, azimuth and elevation of the target, and its velocity. Seed 001, eq. (2) and section 4;
/// specification of seed 001, section 4.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

constexpr int kSize = 6;
/// Where a denominator has the horizontal distance, it is at least this: straight above the station the azimuth has no
/// direction.
constexpr double kNearest = 1e-6;

/// The ray from the station to the target.
struct Ray {
  double dx, dy, dz;
  double flat;          ///< horizontal distance, as it is
  double divisor;       ///< the same, clamped
  double range;         ///< of the clamped one
  double sine, cosine;  ///< of the azimuth, zero where it has no direction
};

class Station final : public Sensor {
 public:
  Station(const Params& params, const Plant& plant)
      : position_(params.vector("position")), noise_(params.square("R", kSize)) {
    static constexpr std::array<std::string_view, kSize> kStates{"px", "vx", "py", "vy", "pz", "vz"};
    const bool fits = std::equal(kStates.begin(), kStates.end(), plant.state().begin(), plant.state().end(),
                                 [](std::string_view name, const Component& c) { return c.name == name; });
    if (!fits) throw InputError("/", "a station needs a plant with the state (px, vx, py, vy, pz, vz)");
    const std::string length = plant.state()[0].unit, speed = plant.state()[1].unit;
    channels_ = {{"range", length, 0},    {"azimuth", "rad", 2 * std::numbers::pi},
                 {"elevation", "rad", 0}, {"vx", speed, 0},
                 {"vy", speed, 0},        {"vz", speed, 0}};
  }

  const std::vector<Component>& channels() const override { return channels_; }
  const Eigen::MatrixXd& noise() const override { return noise_; }
  std::optional<Eigen::Vector2d> position() const override { return position_.head<2>(); }

  void measure(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    const double dx = x[0] - position_[0], dy = x[2] - position_[1], dz = x[4] - position_[2];
    const double flat = std::hypot(dx, dy);
    z[0] = std::hypot(flat, dz);
    z[1] = wrap(std::atan2(dy, dx), channels_[1].period);
    z[2] = std::atan2(dz, flat);
    for (int axis = 0; axis < 3; ++axis) z[3 + axis] = x[2 * axis + 1];
  }

  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> H) const override {
    const Ray ray = to(x);
    fill(ray, H);
    H(1, 0) /= ray.divisor;
    H(1, 2) /= ray.divisor;
  }

  /// The printed azimuth row is divided by the horizontal distance instead of its square.
  void jacobian_as_printed(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> H) const override {
    fill(to(x), H);
  }

  bool limited(const Eigen::Ref<const Eigen::VectorXd>& x) const override { return to(x).flat < kNearest; }

 private:
  Ray to(const Eigen::Ref<const Eigen::VectorXd>& x) const {
    Ray ray{};
    ray.dx = x[0] - position_[0];
    ray.dy = x[2] - position_[1];
    ray.dz = x[4] - position_[2];
    ray.flat = std::hypot(ray.dx, ray.dy);
    ray.divisor = std::max(ray.flat, kNearest);
    ray.range = std::hypot(ray.divisor, ray.dz);
    ray.cosine = ray.dx / ray.divisor;
    ray.sine = ray.dy / ray.divisor;
    return ray;
  }

  static void fill(const Ray& ray, Eigen::Ref<Eigen::MatrixXd> H) {
    const double up = ray.dz / ray.range;
    H.setZero();
    H(0, 0) = ray.dx / ray.range;
    H(0, 2) = ray.dy / ray.range;
    H(0, 4) = up;
    H(1, 0) = -ray.sine;
    H(1, 2) = ray.cosine;
    H(2, 0) = -ray.cosine * up / ray.range;
    H(2, 2) = -ray.sine * up / ray.range;
    H(2, 4) = ray.flat / ray.range / ray.range;
    for (int axis = 0; axis < 3; ++axis) H(3 + axis, 2 * axis + 1) = 1;
  }

  Eigen::Vector3d position_;
  Eigen::MatrixXd noise_;
  std::vector<Component> channels_;
};

const Registration<SensorMake> registration({
    "station",
    {"Ground station: range, azimuth, elevation, velocity", "地面站：距离、方位角、俯仰角与速度"},
    "seed 001, eq. (2) and section 4",
    ParamTable({
        {.name = "position",
         .type = ParamType::vector,
         .unit = "m",
         .rows = 3,
         .required = true,
         .symbol = "(x̃, ỹ, z̃)",
         .meaning = {"Place of the station", "地面站位置"}},
        {.name = "R",
         .type = ParamType::matrix,
         .fallback = 1e-4,
         .symbol = "R",
         .meaning = {"Covariance of the measurement noise, in m, rad and m/s", "测量噪声协方差（单位 m、rad、m/s）"}},
    }),
    [](const Params& params, const Plant& plant) -> std::shared_ptr<const Sensor> {
      return std::make_shared<Station>(params, plant);
    },
});

}  // namespace
}  // namespace vigil
