/// A robot of constant speed and turn, and a sensor that sees several landmarks from it: seed 004, (2-47)-(2-52).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

/// Its heading is not wrapped: estimates of several sensors are averaged, and of wrapped angles that is wrong.
class Robot final : public Plant {
 public:
  Robot(const Params& params, double dt) : way_(params.real("zv") * dt), turn_(params.real("zw") * dt) {}

  const std::vector<Component>& state() const override { return state_; }
  const std::vector<Component>& input() const override { return input_; }
  const std::vector<ErrorGroup>& errors() const override { return errors_; }

  void advance(const ConstVector& x, const ConstVector& /*u*/, Eigen::Ref<Eigen::VectorXd> next) const override {
    next[0] = x[0] + way_ * std::cos(x[2]);
    next[1] = x[1] + way_ * std::sin(x[2]);
    next[2] = x[2] + turn_;
  }
  void jacobian(const ConstVector& x, const ConstVector& /*u*/, Eigen::Ref<Eigen::MatrixXd> F) const override {
    F.setIdentity();
    F(0, 2) = -way_ * std::sin(x[2]);
    F(1, 2) = way_ * std::cos(x[2]);
  }

 private:
  double way_, turn_;
  std::vector<Component> state_{{"sx", "m", 0}, {"sy", "m", 0}, {"theta", "rad", 0}};
  std::vector<Component> input_;
  std::vector<ErrorGroup> errors_{{"position", {0, 1}, "m"}, {"heading", {2}, "rad"}};
};

/// Range of every landmark, and the heading less its direction.
class Landmarks final : public Sensor {
 public:
  Landmarks(const Params& params, const Plant& plant) : places_(params.matrix("landmarks")) {
    if (plant.states() != 3) throw InputError("/", "landmarks need a plant with the state (x, y, heading)");
    if (places_.cols() != 2 || places_.rows() < 1)
      throw InputError("/landmarks", "landmarks must be rows [x, y], one a landmark", "[[x,y],..]");
    const auto count = static_cast<int>(places_.rows());
    noise_ = params.square("R", 2 * count);
    for (int k = 1; k <= count; ++k) {
      channels_.push_back({"d" + std::to_string(k), plant.state()[0].unit, 0});
      channels_.push_back({"theta" + std::to_string(k), "rad", 2 * std::numbers::pi});
    }
  }

  const std::vector<Component>& channels() const override { return channels_; }
  const Eigen::MatrixXd& noise() const override { return noise_; }

  void measure(const ConstVector& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    for (Eigen::Index k = 0; k < places_.rows(); ++k) {
      const double dx = places_(k, 0) - x[0], dy = places_(k, 1) - x[1];
      z[2 * k] = std::hypot(dx, dy);
      z[2 * k + 1] = wrap(x[2] - std::atan2(dy, dx), 2 * std::numbers::pi);
    }
  }

  void jacobian(const ConstVector& x, Eigen::Ref<Eigen::MatrixXd> H) const override { differentiate(x, false, H); }
  /// (2-52): the bearing's row is divided by the range where its square belongs.
  void jacobian_as_printed(const ConstVector& x, Eigen::Ref<Eigen::MatrixXd> H) const override {
    differentiate(x, true, H);
  }

 private:
  void differentiate(const ConstVector& x, bool printed, Eigen::Ref<Eigen::MatrixXd> H) const {
    constexpr double kLeastSquare = 1e-12;  // on a landmark, m^2
    for (Eigen::Index k = 0; k < places_.rows(); ++k) {
      const double dx = places_(k, 0) - x[0], dy = places_(k, 1) - x[1];
      const double square = std::max(dx * dx + dy * dy, kLeastSquare), range = std::sqrt(square);
      const double divisor = printed ? range : square;
      H.row(2 * k) << -dx / range, -dy / range, 0;
      H.row(2 * k + 1) << -dy / divisor, dx / divisor, 1;
    }
  }

  Eigen::MatrixXd places_, noise_;
  std::vector<Component> channels_;
};

const Registration<PlantMake> robot({
    "landmark_robot",
    {"A robot of constant speed and turn, heading not wrapped", "恒速恒转率机器人（航向不折返）"},
    "seed 004, (2-47)-(2-50)",
    ParamTable({
        {.name = "zv", .fallback = 1, .unit = "m/s", .symbol = "z_v", .meaning = {"Speed", "线速度"}},
        {.name = "zw", .fallback = 0.05, .unit = "rad/s", .symbol = "z_w", .meaning = {"Rate of turn", "角速度"}},
    }),
    [](const Params& params, double dt) -> std::shared_ptr<const Plant> { return std::make_shared<Robot>(params, dt); },
});

const Registration<SensorMake> landmarks({
    "landmarks",
    {"Ranges and bearings of several landmarks", "多个路标的距离与方位"},
    "seed 004, (2-51), (2-52)",
    ParamTable({
        {.name = "landmarks",
         .type = ParamType::matrix,
         .unit = "m",
         .required = true,
         .meaning = {"Their places, a row [x, y] each", "路标位置，每行 [x, y]"}},
        {.name = "R",
         .type = ParamType::matrix,
         .fallback = 0.01,
         .symbol = "R",
         .meaning = {"Covariance of the noise: range and bearing of each landmark in turn",
                     "噪声协方差：依次为各路标的距离与方位"}},
    }),
    [](const Params& params, const Plant& plant) -> std::shared_ptr<const Sensor> {
      return std::make_shared<Landmarks>(params, plant);
    },
});

}  // namespace
}  // namespace vigil
