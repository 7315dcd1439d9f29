/// Linear feedback by the user's own gain: u = -K (xh - x_ref) + u_ref.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "engine/world/controller.hpp"

namespace vigil {
namespace {

/// Zero where the parameter is null.
Eigen::VectorXd vector_of(const Params& params, const char* name, int size, const char* what) {
  if (!params.given(name)) return Eigen::VectorXd::Zero(size);
  Eigen::VectorXd values = params.vector(name);
  if (values.size() != size)
    throw InputError(std::string("/") + name,
                     fmt::format("{} has {} entries; expected {}, one {}", name, values.size(), size, what));
  return values;
}

class Feedback final : public Controller {
 public:
  Feedback(const Params& params, const Plant& plant) {
    const int n = plant.states(), m = plant.inputs();
    if (!plant.linear() || m == 0) throw InputError("/", "linear feedback needs a linear plant with an input");
    K_ = params.matrix("K");
    if (K_.rows() != m || K_.cols() != n)
      throw InputError("/K",
                       fmt::format("K is {} x {}; expected {} x {}, a row [..] an input and in it an entry a state",
                                   K_.rows(), K_.cols(), m, n),
                       fmt::format("{} x {}", m, n));
    u_ref_ = vector_of(params, "u_ref", m, "an input");
    offset_ = u_ref_ + K_ * vector_of(params, "x_ref", n, "a state");
    const LinearModel model = linear_model(plant);
    const Eigen::MatrixXd closed = model.A - model.B * K_;
    if (closed.allFinite()) poles_ = Eigen::EigenSolver<Eigen::MatrixXd>(closed, false).eigenvalues();
    if (!poles_.allFinite() || !offset_.allFinite() || poles_.size() == 0)
      throw InputError("/K", "the closed loop A - B K has entries beyond every number; expected smaller ones");
  }

  void input(std::int64_t /*k*/, const double* estimate, Eigen::Ref<Eigen::VectorXd> u) const override {
    u = estimate == nullptr ? u_ref_ : offset_;
    if (estimate == nullptr) return;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      for (Eigen::Index c = 0; c < K_.cols(); ++c) u[i] -= K_(i, c) * estimate[c];
    }
  }

  Json design() const override {
    Json K = Json::array(), poles = Json::array();
    for (const auto& row : K_.rowwise()) {
      K.push_back(Json::array());
      for (const double gain : row) K.back().push_back(gain);
    }
    for (const std::complex<double>& pole : poles_) poles.push_back({{"re", pole.real()}, {"im", pole.imag()}});
    return {{"K", std::move(K)}, {"poles", std::move(poles)}, {"spectral_radius", radius()}, {"stable", radius() < 1}};
  }

  std::vector<std::string> warnings() const override {
    if (radius() < 1) return {};
    return {fmt::format("the closed loop A - B K is not stable: its spectral radius is {:.6g}", radius())};
  }

 private:
  double radius() const { return poles_.cwiseAbs().maxCoeff(); }

  Eigen::MatrixXd K_;
  Eigen::VectorXd u_ref_, offset_;  ///< offset_: K x_ref + u_ref
  Eigen::VectorXcd poles_;          ///< of A - B K
};

const Registration<ControllerMake> registration({
    "feedback",
    {"Linear feedback of the lane's own estimate by a gain of one's own", "以自定义增益对各通道自身估计作线性反馈"},
    "textbook",
    ParamTable({
        {.name = "K",
         .type = ParamType::matrix,
         .required = true,
         .symbol = "K",
         .meaning = {"Gain, inputs x states: u = -K (x̂ - x_ref) + u_ref",
                     "增益，输入×状态：u = -K (x̂ - x_ref) + u_ref"}},
        {.name = "x_ref",
         .type = ParamType::vector,
         .nullable = true,
         .symbol = "x_ref",
         .meaning = {"Where the state is to be; none: zero", "状态参考值；无：零"}},
        {.name = "u_ref",
         .type = ParamType::vector,
         .nullable = true,
         .symbol = "u_ref",
         .meaning = {"The input that holds it there; none: zero", "保持该状态的输入；无：零"}},
    }),
    [](const Params& params, const Plant& plant) -> std::shared_ptr<const Controller> {
      return std::make_shared<Feedback>(params, plant);
    },
});

}  // namespace
}  // namespace vigil
