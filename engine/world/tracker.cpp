/// A target in space under state feedback: per axis a double integrator whose loop is closed on the true state. Seed
/// 001, eq. (1) and section 4; specification of seed 001, section 3.
#include <array>
#include <cmath>

#include "engine/core/json.hpp"
#include "engine/world/plant.hpp"

namespace vigil {
namespace {

constexpr int kAxes = 3;
/// Least determinant of an axis: below, its inverse loses every digit of a double.
constexpr double kSingular = 1e-12;

/// The closed loop of one axis, A + B g with A = [[1, Ts], [0, 1]] and B = [Ts^2 / 2; Ts], whose eigenvalues are
/// a +- b i. Throws InputError at `pointer` where it is singular or not finite.
Eigen::Matrix2d closed_axis(const Eigen::VectorXd& pole, double Ts, const std::string& pointer) {
  const double trace = 2 * pole[0], determinant = pole[0] * pole[0] + pole[1] * pole[1];
  if (determinant < kSingular) {
    throw InputError(pointer,
                     "the poles " + Json(pole[0]).dump() + " +- " + Json(pole[1]).dump() +
                         "i have a modulus below 1e-6; the step could not be inverted",
                     "a^2 + b^2 >= 1e-12");
  }
  const double g1 = (trace - determinant - 1) / (Ts * Ts), g2 = (trace + determinant - 3) / (2 * Ts);
  Eigen::Matrix2d axis;
  axis << 1 + Ts * Ts / 2 * g1, Ts + Ts * Ts / 2 * g2, Ts * g1, 1 + Ts * g2;
  if (!axis.allFinite()) {
    throw InputError(pointer, "the poles " + Json(pole[0]).dump() + " +- " + Json(pole[1]).dump() +
                                  "i need a gain that is not finite at a step of " + Json(Ts).dump() + " s");
  }
  return axis;
}

class Tracker final : public Plant {
 public:
  Tracker(const Params& params, double Ts) {
    static constexpr const char* kPoles[] = {"poles_x", "poles_y", "poles_z"};
    loop_.setZero();
    for (int a = 0; a < kAxes; ++a) {
      axes_[static_cast<std::size_t>(a)] = closed_axis(params.vector(kPoles[a]), Ts, std::string("/") + kPoles[a]);
      loop_.block<2, 2>(2 * a, 2 * a) = axes_[static_cast<std::size_t>(a)];
    }
  }

  const std::vector<Component>& state() const override { return state_; }
  const std::vector<Component>& input() const override { return input_; }
  const std::vector<ErrorGroup>& errors() const override { return errors_; }
  bool linear() const override { return true; }

  void advance(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
               Eigen::Ref<Eigen::VectorXd> next) const override {
    for (int a = 0; a < kAxes; ++a)
      next.segment<2>(2 * a) = axes_[static_cast<std::size_t>(a)] * x.segment<2>(2 * a).eval();
  }

  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& /*x*/, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
                Eigen::Ref<Eigen::MatrixXd> F) const override {
    F = loop_;
  }

 private:
  std::array<Eigen::Matrix2d, kAxes> axes_;
  Eigen::Matrix<double, 2 * kAxes, 2 * kAxes> loop_;
  std::vector<Component> state_{{"px", "m", 0},   {"vx", "m/s", 0}, {"py", "m", 0},
                                {"vy", "m/s", 0}, {"pz", "m", 0},   {"vz", "m/s", 0}};
  std::vector<Component> input_;
  std::vector<ErrorGroup> errors_{{"position", {0, 2, 4}, "m"}, {"velocity", {1, 3, 5}, "m/s"}};
};

Param poles(const char* name, double a, double b, Words meaning) {
  return {.name = name,
          .type = ParamType::vector,
          .fallback = Json::array({a, b}),
          .rows = 2,
          .symbol = "a ± b i",
          .meaning = std::move(meaning)};
}

const Registration<PlantMake> registration({
    "tracker",
    {"Target in space under state feedback", "状态反馈下的空间目标"},
    "seed 001, eq. (1) and section 4",
    ParamTable({
        poles("poles_x", 0.99, 0.01, {"Closed-loop poles of the x axis: a and b", "x 轴闭环极点：a 与 b"}),
        poles("poles_y", 0.98, 0.02, {"Closed-loop poles of the y axis: a and b", "y 轴闭环极点：a 与 b"}),
        poles("poles_z", 0.97, 0.03, {"Closed-loop poles of the z axis: a and b", "z 轴闭环极点：a 与 b"}),
    }),
    [](const Params& params, double dt) -> std::shared_ptr<const Plant> {
      return std::make_shared<Tracker>(params, dt);
    },
});

}  // namespace
}  // namespace vigil
