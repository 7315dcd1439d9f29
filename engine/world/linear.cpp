/// A linear plant and a linear sensor of the user's own matrices: x+ = A x + B u, y = C x. Seed 003, eq. (1).
#include "engine/linalg/covariance.hpp"
#include "engine/linalg/small.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

std::vector<Component> numbered(const char* letter, Eigen::Index count) {
  std::vector<Component> components;
  for (Eigen::Index i = 1; i <= count; ++i) components.push_back({letter + std::to_string(i), "", 0});
  return components;
}

class LinearPlant final : public Plant {
 public:
  explicit LinearPlant(const Params& params) : A_(params.matrix("A")) {
    const Eigen::Index n = A_.rows();
    if (A_.cols() != n)
      throw InputError("/A", "A has " + std::to_string(n) + " rows and " + std::to_string(A_.cols()) +
                                 " columns; expected a square matrix");
    B_ = params.given("B") ? params.matrix("B") : Eigen::MatrixXd(n, 0);
    if (B_.rows() != n)
      throw InputError("/B",
                       "B has " + std::to_string(B_.rows()) + " rows; expected " + std::to_string(n) + ", one a state");
    if (n > kMaxSmall || B_.cols() > kMaxSmall)
      throw InputError("/A", "a plant has at most " + std::to_string(kMaxSmall) + " states and as many inputs");
    state_ = numbered("x", n);
    input_ = numbered("u", B_.cols());
    errors_ = {{"norm", {}, ""}};
    for (int c = 0; c < static_cast<int>(n); ++c) errors_[0].components.push_back(c);
  }

  const std::vector<Component>& state() const override { return state_; }
  const std::vector<Component>& input() const override { return input_; }
  const std::vector<ErrorGroup>& errors() const override { return errors_; }
  bool linear() const override { return true; }

  void advance(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& u,
               Eigen::Ref<Eigen::VectorXd> next) const override {
    next.noalias() = A_ * x;
    if (B_.cols() > 0) next.noalias() += B_ * u;
  }

  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& /*x*/, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
                Eigen::Ref<Eigen::MatrixXd> F) const override {
    F = A_;
  }

 private:
  Eigen::MatrixXd A_, B_;
  std::vector<Component> state_, input_;
  std::vector<ErrorGroup> errors_;
};

class LinearSensor final : public Sensor {
 public:
  LinearSensor(const Params& params, const Plant& plant) : C_(params.matrix("C")) {
    if (C_.cols() != plant.states())
      throw InputError("/C", "C has " + std::to_string(C_.cols()) + " columns; the plant has " +
                                 std::to_string(plant.states()) + " states");
    const auto p = static_cast<int>(C_.rows());
    noise_ = params.square("R", p);
    shape_ = params.square("Mv", p);
    check_covariance(shape_, "/Mv", Definiteness::semidefinite);
    channels_ = numbered("y", p);
  }

  const std::vector<Component>& channels() const override { return channels_; }
  const Eigen::MatrixXd& noise() const override { return noise_; }
  Eigen::MatrixXd bounded_noise() const override { return shape_; }
  bool may_be_exact() const override { return true; }
  bool linear() const override { return true; }

  void measure(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    z.noalias() = C_ * x;
  }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& /*x*/, Eigen::Ref<Eigen::MatrixXd> H) const override {
    H = C_;
  }

 private:
  Eigen::MatrixXd C_, noise_, shape_;
  std::vector<Component> channels_;
};

const Registration<PlantMake> plant({
    "linear",
    {"A linear plant of one's own", "自定义线性对象"},
    "seed 003, eq. (1)",
    ParamTable({
        {.name = "A",
         .type = ParamType::matrix,
         .required = true,
         .symbol = "A",
         .meaning = {"Transition of the state in a tick", "每步状态转移矩阵"}},
        {.name = "B",
         .type = ParamType::matrix,
         .nullable = true,
         .symbol = "B",
         .meaning = {"Effect of the input; none: the plant has no input", "输入矩阵；无：对象没有输入"}},
    }),
    [](const Params& params, double) -> std::shared_ptr<const Plant> { return std::make_shared<LinearPlant>(params); },
});

const Registration<SensorMake> sensor({
    "linear",
    {"A linear sensor of one's own", "自定义线性传感器"},
    "seed 003, eq. (1)",
    ParamTable({
        {.name = "C",
         .type = ParamType::matrix,
         .required = true,
         .symbol = "C",
         .meaning = {"What is measured of the state", "观测矩阵"}},
        {.name = "R",
         .type = ParamType::matrix,
         .fallback = 1,
         .symbol = "R",
         .meaning = {"Covariance of the random noise; may be zero", "随机噪声协方差，可为零"}},
        {.name = "Mv",
         .type = ParamType::matrix,
         .fallback = 0,
         .symbol = "M_v",
         .meaning = {"Shape of the ellipsoid of the bounded noise", "有界噪声椭球的形状矩阵"}},
    }),
    [](const Params& params, const Plant& own) -> std::shared_ptr<const Sensor> {
      return std::make_shared<LinearSensor>(params, own);
    },
});

}  // namespace
}  // namespace vigil
