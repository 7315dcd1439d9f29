/// A fixed camera that sees the robot: seed 000, (46)-(47).
#include <cmath>

#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

class Camera final : public Sensor {
 public:
  Camera(const Params& params, const Plant& plant)
      : position_(params.vector("position")),
        kappa_(params.real("kappa")),
        au_(params.real("gamma_u") / params.real("z")),
        av_(params.real("gamma_v") / params.real("z")),
        p0_(params.real("p0")),
        q0_(params.real("q0")),
        d1_(params.real("d1")),
        d2_(params.real("d2")),
        compass_(params.boolean("compass")) {
    if (plant.states() != 3) throw InputError("/", "a camera needs a plant with the state (x, y, theta)");
    channels_ = {{"p", "px", 0}, {"q", "px", 0}};
    if (compass_) channels_.push_back({"heading", plant.state()[2].unit, plant.state()[2].period});
    const int n = static_cast<int>(channels_.size());
    noise_ = params.given("R") ? params.square("R", n) : Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n));
  }

  const std::vector<Component>& channels() const override { return channels_; }
  const Eigen::MatrixXd& noise() const override { return noise_; }
  std::optional<Eigen::Vector2d> position() const override { return position_; }

  void measure(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    const double dx = position_[0] - x[0], dy = position_[1] - x[1];
    const double s = std::sin(kappa_ * x[2]), c = std::cos(kappa_ * x[2]);
    z[0] = au_ * (-dx * s + dy * c - d2_) + p0_;
    z[1] = av_ * (-dx * c - dy * s - d1_) + q0_;
    if (compass_) z[2] = x[2];
  }

  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> H) const override {
    const double dx = position_[0] - x[0], dy = position_[1] - x[1];
    const double s = std::sin(kappa_ * x[2]), c = std::cos(kappa_ * x[2]);
    H(0, 0) = au_ * s;
    H(0, 1) = -au_ * c;
    H(0, 2) = au_ * kappa_ * (-dx * c - dy * s);
    H(1, 0) = av_ * c;
    H(1, 1) = av_ * s;
    H(1, 2) = av_ * kappa_ * (dx * s - dy * c);
    if (compass_) {
      H(2, 0) = 0;
      H(2, 1) = 0;
      H(2, 2) = 1;
    }
  }

 private:
  Eigen::Vector2d position_;
  double kappa_, au_, av_, p0_, q0_, d1_, d2_;
  bool compass_;
  std::vector<Component> channels_;
  Eigen::MatrixXd noise_;
};

const Registration<SensorMake> registration({
    "camera",
    {"Fixed camera", "固定摄像机"},
    "seed 000, (46)-(47)",
    ParamTable({
        {.name = "position",
         .type = ParamType::vector,
         .rows = 2,
         .required = true,
         .symbol = "(c_x, c_y)",
         .meaning = {"Place of the camera in the plant's length unit", "摄像机位置（对象的长度单位）"}},
        {.name = "z",
         .fallback = 2.105,
         .unit = "m",
         .minimum = 0,
         .exclusive_minimum = true,
         .symbol = "z",
         .meaning = {"Height of the camera above the robot", "摄像机高度"}},
        {.name = "gamma_u",
         .fallback = 9.0213283,
         .symbol = "γ_u",
         .meaning = {"Horizontal focal factor", "水平焦距系数"}},
        {.name = "gamma_v",
         .fallback = 9.0250141,
         .symbol = "γ_v",
         .meaning = {"Vertical focal factor", "垂直焦距系数"}},
        {.name = "p0",
         .fallback = 347.20436,
         .unit = "px",
         .symbol = "p_0",
         .meaning = {"Image centre, horizontal", "图像中心（水平）"}},
        {.name = "q0",
         .fallback = 284.3475,
         .unit = "px",
         .symbol = "q_0",
         .meaning = {"Image centre, vertical", "图像中心（垂直）"}},
        {.name = "d1",
         .fallback = -6.68,
         .symbol = "d_1",
         .meaning = {"Offset of the marker along the robot", "标记的纵向偏移"}},
        {.name = "d2",
         .fallback = 5.36,
         .symbol = "d_2",
         .meaning = {"Offset of the marker across the robot", "标记的横向偏移"}},
        {.name = "kappa",
         .fallback = 0.017453292519943295,
         .unit = "rad",
         .minimum = 0,
         .exclusive_minimum = true,
         .symbol = "κ",
         .meaning = {"Radians per unit of the heading state, as the plant's", "航向状态每单位对应的弧度，与对象一致"}},
        {.name = "compass",
         .type = ParamType::boolean,
         .fallback = false,
         .meaning = {"Also measures the heading (profile compass, not in the paper)",
                     "同时测量航向（compass 配置，论文中没有）"}},
        {.name = "R",
         .type = ParamType::matrix,
         .unit = "px²",
         .nullable = true,
         .symbol = "R",
         .meaning = {"Covariance of the measurement noise; none given: the identity",
                     "测量噪声协方差；未给出时为单位阵"}},
    }),
    [](const Params& params, const Plant& plant) -> std::shared_ptr<const Sensor> {
      return std::make_shared<Camera>(params, plant);
    },
});

}  // namespace
}  // namespace vigil
