/// Targets of seed 004 that move in a line and in a turn. Both are linear; a tick is the sampling step.
#include <cmath>

#include "engine/world/plant.hpp"

namespace vigil {
namespace {

class Target : public Plant {
 public:
  Target(Eigen::MatrixXd A, std::vector<Component> state, std::vector<ErrorGroup> errors)
      : A_(std::move(A)), state_(std::move(state)), errors_(std::move(errors)) {}

  const std::vector<Component>& state() const override { return state_; }
  const std::vector<Component>& input() const override { return input_; }
  const std::vector<ErrorGroup>& errors() const override { return errors_; }
  bool linear() const override { return true; }

  void advance(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
               Eigen::Ref<Eigen::VectorXd> next) const override {
    next.noalias() = A_ * x;
  }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& /*x*/, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
                Eigen::Ref<Eigen::MatrixXd> F) const override {
    F = A_;
  }

 private:
  Eigen::MatrixXd A_;
  std::vector<Component> state_, input_;
  std::vector<ErrorGroup> errors_;
};

/// (2-44): position and velocity.
std::shared_ptr<const Plant> line(double dt) {
  return std::make_shared<Target>(Eigen::MatrixXd{{1, dt}, {0, 1}},
                                  std::vector<Component>{{"position", "m", 0}, {"velocity", "m/s", 0}},
                                  std::vector<ErrorGroup>{{"position", {0}, "m"}, {"velocity", {1}, "m/s"}});
}

/// (3-34), with its limit for a target that goes straight on.
std::shared_ptr<const Plant> turn(double rate, double dt) {
  constexpr double kStraight = 1e-9;  // rad/s
  const bool straight = std::abs(rate) < kStraight;
  const double s = straight ? 0 : std::sin(rate * dt), c = straight ? 1 : std::cos(rate * dt);
  const double along = straight ? dt : s / rate, across = straight ? 0 : (1 - c) / rate;
  const Eigen::MatrixXd A{{1, along, 0, -across}, {0, c, 0, -s}, {0, across, 1, along}, {0, s, 0, c}};
  return std::make_shared<Target>(
      A, std::vector<Component>{{"sx", "m", 0}, {"vx", "m/s", 0}, {"sy", "m", 0}, {"vy", "m/s", 0}},
      std::vector<ErrorGroup>{{"position", {0, 2}, "m"}, {"velocity", {1, 3}, "m/s"}});
}

const Registration<PlantMake> line_target({
    "line_target",
    {"A target that moves in a line", "直线运动目标"},
    "seed 004, (2-44)-(2-46)",
    ParamTable(),
    [](const Params& /*params*/, double dt) { return line(dt); },
});

const Registration<PlantMake> turning_target({
    "turning_target",
    {"A target that turns at a constant rate", "匀速转弯目标"},
    "seed 004, (3-34)-(3-36)",
    ParamTable({
        {.name = "p",
         .fallback = 0.1,
         .unit = "rad/s",
         .symbol = "p",
         .meaning = {"Rate of the turn; 0: straight on", "转弯角速度；0：直线"}},
    }),
    [](const Params& params, double dt) { return turn(params.real("p"), dt); },
});

}  // namespace
}  // namespace vigil
