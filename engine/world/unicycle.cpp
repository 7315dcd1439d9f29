/// Planar robots. Both have the state (x, y, theta); they differ in where speed and turn come from.
#include <cmath>

#include "engine/world/plant.hpp"

namespace vigil {
namespace {

/// Two wheels at constant speed: seed 000, (43)-(45). kappa: radians per unit of the heading state; s = (sR + sL) / 2.
class UnicycleWheels final : public Plant {
 public:
  explicit UnicycleWheels(const Params& params)
      : kappa_(params.real("kappa")),
        step_((params.real("sR") + params.real("sL")) / 2),
        turn_((params.real("sR") - params.real("sL")) / (params.real("b") * kappa_)) {
    const std::string length = params.text("length_unit");
    const double turn = 2 * std::acos(-1.0) / kappa_;
    state_ = {{"x", length, 0}, {"y", length, 0}, {"theta", params.text("heading_unit"), turn}};
    errors_ = {{"position", {0, 1}, length}, {"heading", {2}, state_[2].unit}};
  }

  const std::vector<Component>& state() const override { return state_; }
  const std::vector<Component>& input() const override { return input_; }
  const std::vector<ErrorGroup>& errors() const override { return errors_; }

  void advance(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
               Eigen::Ref<Eigen::VectorXd> next) const override {
    const double angle = kappa_ * x[2];
    next[0] = x[0] + step_ * std::cos(angle);
    next[1] = x[1] + step_ * std::sin(angle);
    next[2] = x[2] + turn_;
  }

  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
                Eigen::Ref<Eigen::MatrixXd> F) const override {
    const double angle = kappa_ * x[2];
    F.setIdentity();
    F(0, 2) = -step_ * kappa_ * std::sin(angle);
    F(1, 2) = step_ * kappa_ * std::cos(angle);
  }

 private:
  double kappa_, step_, turn_;
  std::vector<Component> state_, input_;
  std::vector<ErrorGroup> errors_;
};

/// Odometry as the known input: x+ = x + v dt cos(theta), y+ = y + v dt sin(theta), theta+ = theta + omega dt. Metres
/// and radians.
class Unicycle final : public Plant {
 public:
  explicit Unicycle(double dt) : dt_(dt) {}

  const std::vector<Component>& state() const override { return state_; }
  const std::vector<Component>& input() const override { return input_; }
  const std::vector<ErrorGroup>& errors() const override { return errors_; }

  void advance(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& u,
               Eigen::Ref<Eigen::VectorXd> next) const override {
    next[0] = x[0] + u[0] * dt_ * std::cos(x[2]);
    next[1] = x[1] + u[0] * dt_ * std::sin(x[2]);
    next[2] = x[2] + u[1] * dt_;
  }

  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& u,
                Eigen::Ref<Eigen::MatrixXd> F) const override {
    F.setIdentity();
    F(0, 2) = -u[0] * dt_ * std::sin(x[2]);
    F(1, 2) = u[0] * dt_ * std::cos(x[2]);
  }

 private:
  double dt_;
  std::vector<Component> state_{{"x", "m", 0}, {"y", "m", 0}, {"theta", "rad", 2 * std::acos(-1.0)}};
  std::vector<Component> input_{{"v", "m/s", 0}, {"omega", "rad/s", 0}};
  std::vector<ErrorGroup> errors_{{"position", {0, 1}, "m"}, {"heading", {2}, "rad"}};
};

const Registration<PlantMake> wheels({
    "unicycle_wheels",
    {"Two-wheeled robot at constant wheel speeds", "恒定轮速的两轮机器人"},
    "seed 000, (43)-(45)",
    ParamTable({
        {.name = "kappa",
         .fallback = 0.017453292519943295,
         .unit = "rad",
         .minimum = 0,
         .exclusive_minimum = true,
         .symbol = "κ",
         .meaning = {"Radians per unit of the heading state", "航向状态每单位对应的弧度"}},
        {.name = "sR",
         .fallback = 10.4,
         .symbol = "s^R",
         .meaning = {"Way of the right wheel in a step", "右轮每步行程"}},
        {.name = "sL",
         .fallback = 5.6,
         .symbol = "s^L",
         .meaning = {"Way of the left wheel in a step", "左轮每步行程"}},
        {.name = "b",
         .fallback = 30.0,
         .minimum = 0,
         .exclusive_minimum = true,
         .symbol = "b",
         .meaning = {"Distance between the wheels", "两轮间距"}},
        {.name = "length_unit",
         .type = ParamType::text,
         .fallback = "cm",
         .choices = {"cm", "m"},
         .meaning = {"Unit that lengths are shown in", "长度的显示单位"}},
        {.name = "heading_unit",
         .type = ParamType::text,
         .fallback = "deg",
         .choices = {"deg", "rad"},
         .meaning = {"Unit that the heading is shown in", "航向的显示单位"}},
    }),
    [](const Params& params, double) -> std::shared_ptr<const Plant> {
      return std::make_shared<UnicycleWheels>(params);
    },
});

const Registration<PlantMake> unicycle({
    "unicycle",
    {"Robot driven by its odometry", "由里程计驱动的机器人"},
    "seed 000, (43)-(45), with measured speeds",
    ParamTable(),
    [](const Params&, double dt) -> std::shared_ptr<const Plant> { return std::make_shared<Unicycle>(dt); },
});

}  // namespace
}  // namespace vigil
