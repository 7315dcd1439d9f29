/// A linear plant and a linear sensor of the user's own matrices: x+ = A x + B u, y = C x. Seed 003, eq. (1).
#include <fmt/format.h>

#include <algorithm>

#include "engine/core/describe.hpp"
#include "engine/linalg/covariance.hpp"
#include "engine/linalg/small.hpp"
#include "engine/linalg/zero_order_hold.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

/// What stands between dots in the names of signals and in the places of attacks.
bool is_name(const std::string& text) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return text.size() <= 16 && std::all_of(text.begin(), text.end(), fits);
}

/// `count` components by the names of params, or letter1, letter2, … where none are given. `what`: one of what each is.
std::vector<Component> named(const Params& params, const char* key, const char* letter, Eigen::Index count,
                             const char* what) {
  std::vector<Component> components;
  const std::string pointer = std::string("/") + key;
  if (!params.given(key)) {
    for (Eigen::Index i = 1; i <= count; ++i) components.push_back({letter + std::to_string(i), "", 0});
    return components;
  }
  const std::vector<std::string> names = params.texts(key);
  if (static_cast<Eigen::Index>(names.size()) != count)
    throw InputError(pointer, fmt::format("{} has {} names; expected {}, one {}", key, names.size(), count, what));
  for (const std::string& name : names) {
    if (!is_name(name))
      throw InputError(pointer, in_quotes(name) + " is no name; expected 1 to 16 letters, digits and '_'",
                       "[A-Za-z0-9_]{1,16}");
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(pointer, in_quotes(name) + " is given twice; expected distinct names");
    components.push_back({name, "", 0});
  }
  return components;
}

class LinearPlant final : public Plant {
 public:
  LinearPlant(const Params& params, double dt) : A_(params.matrix("A")) {
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
    if (params.text("time") == "continuous") hold(dt);
    state_ = named(params, "states", "x", n, "a state");
    input_ = named(params, "inputs", "u", B_.cols(), "an input");
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
  /// From x' = A x + B u to ticks of dt seconds.
  void hold(double dt) {
    Held held = zero_order_hold(A_, B_, dt);
    if (!held.A.allFinite() || !held.B.allFinite())
      throw InputError("/A", "in a tick of " + number_text(dt) +
                                 " s this plant grows beyond every number; expected smaller entries of A and B, or a "
                                 "smaller time.dt");
    A_ = std::move(held.A);
    B_ = std::move(held.B);
  }

  Eigen::MatrixXd A_, B_;  ///< of a tick
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
    channels_ = named(params, "channels", "y", p, "a row of C");
    for (const Component& channel : channels_) {
      if (channel.name == "state")  // sensor.<node>.state is whether the sensor is attacked
        throw InputError("/channels", "\"state\" has a meaning of its own in signal names; expected another name",
                         "not state");
    }
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

const Registration<PlantMake> plant_registration({
    "linear",
    {"A linear plant of one's own", "自定义线性对象"},
    "seed 003, eq. (1)",
    ParamTable({
        {.name = "A",
         .type = ParamType::matrix,
         .required = true,
         .symbol = "A",
         .meaning = {"Transition of the state in a tick; where time is continuous, of x' = A x + B u",
                     "每步状态转移矩阵；连续时间时为 x' = A x + B u 的 A"}},
        {.name = "B",
         .type = ParamType::matrix,
         .nullable = true,
         .symbol = "B",
         .meaning = {"Effect of the input; none: the plant has no input", "输入矩阵；无：对象没有输入"}},
        {.name = "time",
         .type = ParamType::text,
         .fallback = "discrete",
         .choices = {"discrete", "continuous"},
         .meaning = {"What A and B are of: a tick, or seconds, the input held from tick to tick (noise.Q is of a tick "
                     "in both)",
                     "A、B 所属时间：离散（每步）或连续（秒，输入在步内保持；两种情形下 noise.Q 均为每步协方差）"}},
        {.name = "states",
         .type = ParamType::texts,
         .nullable = true,
         .meaning = {"Names of the states; none: x1, x2, …", "状态名称；无：x1、x2、…"}},
        {.name = "inputs",
         .type = ParamType::texts,
         .nullable = true,
         .meaning = {"Names of the inputs; none: u1, u2, …", "输入名称；无：u1、u2、…"}},
    }),
    [](const Params& params, double dt) -> std::shared_ptr<const Plant> {
      return std::make_shared<LinearPlant>(params, dt);
    },
});

const Registration<SensorMake> sensor_registration({
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
        {.name = "channels",
         .type = ParamType::texts,
         .nullable = true,
         .meaning = {"Names of what is measured; none: y1, y2, …", "测量通道名称；无：y1、y2、…"}},
    }),
    [](const Params& params, const Plant& own) -> std::shared_ptr<const Sensor> {
      return std::make_shared<LinearSensor>(params, own);
    },
});

}  // namespace
}  // namespace vigil
