/// Linear-quadratic feedback to a reference: u = L (xh - xref) + uref. Seed 003, section 4; specification of seed 003,
/// section 2.
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "engine/core/describe.hpp"
#include "engine/linalg/covariance.hpp"
#include "engine/linalg/riccati.hpp"
#include "engine/world/controller.hpp"

namespace vigil {
namespace {

class Lqg final : public Controller {
 public:
  Lqg(const Params& params, const Plant& plant) : reference_(params.text("reference")) {
    if (!plant.linear() || plant.inputs() == 0)
      throw InputError("/", "linear-quadratic feedback needs a linear plant with an input");
    const LinearModel model = linear_model(plant);
    const int n = plant.states();
    const Eigen::MatrixXd Qc = params.square("Qc", n), Rc = params.square("Rc", plant.inputs());
    check_covariance(Qc, "/Qc", Definiteness::semidefinite);
    check_covariance(Rc, "/Rc", Definiteness::definite);
    if (!stabilisable(model.A, model.B))
      throw InputError("/",
                       "the input does not move a mode of the plant that does not decay, so no feedback stabilises "
                       "it; expected a stabilisable pair (A, B)");
    const auto S = solve_dare(model.A, model.B, Qc, Rc);
    if (!S)
      throw InputError("/Qc", "Qc is " + shown(params.values()["Qc"]) +
                                  ", which does not weigh a mode on the unit circle: the Riccati equation has no "
                                  "stabilising solution; expected every such mode weighed");
    L_ = lqr_gain(model.A, model.B, Rc, *S);
    closed_ = model.A + model.B * L_;
    steady_ = Eigen::MatrixXd::Zero(n, plant.inputs());
    if (reference_ == "zero") return;
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(Eigen::MatrixXd::Identity(n, n) - model.A);
    if (!lu.isInvertible())
      throw InputError("/reference",
                       "A has an eigenvalue at 1, so a constant input has no steady state; expected zero");
    steady_ = lu.solve(model.B);
  }

  void input(std::int64_t k, const double* estimate, Eigen::Ref<Eigen::VectorXd> u) const override {
    const double level = reference(k);
    u.setConstant(level);
    if (estimate == nullptr) return;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      for (Eigen::Index c = 0; c < L_.cols(); ++c) u[i] += L_(i, c) * (estimate[c] - level * steady_.row(c).sum());
    }
  }

  Json design() const override {
    Json L = Json::array();
    for (Eigen::Index i = 0; i < L_.rows(); ++i) {
      L.push_back(Json::array());
      for (Eigen::Index c = 0; c < L_.cols(); ++c) L.back().push_back(L_(i, c));
    }
    return {{"L", L}, {"spectral_radius", spectral_radius(closed_)}};
  }

 private:
  /// uref of every input.
  double reference(std::int64_t k) const {
    if (reference_ == "step") return k < 101 ? 1 : (k < 200 ? 3 : 2);
    if (reference_ == "sine") return 2 * std::sin(2 * std::numbers::pi * static_cast<double>(k % 40) / 40);
    return 0;
  }

  std::string reference_;
  Eigen::MatrixXd L_, closed_, steady_;  ///< steady_: (I - A)^-1 B
};

const Registration<ControllerMake> registration({
    "lqg",
    {"Linear-quadratic feedback of the lane's own estimate", "基于各通道自身估计的线性二次反馈"},
    "seed 003, section 4",
    ParamTable({
        {.name = "Qc",
         .type = ParamType::matrix,
         .fallback = 1,
         .symbol = "Q_c",
         .meaning = {"Weight of the state", "状态权重"}},
        {.name = "Rc",
         .type = ParamType::matrix,
         .fallback = 1,
         .symbol = "R_c",
         .meaning = {"Weight of the input", "输入权重"}},
        {.name = "reference",
         .type = ParamType::text,
         .fallback = "zero",
         .choices = {"zero", "step", "sine"},
         .symbol = "u_ref",
         .meaning = {"Feed-forward: none, steps at 101 and 200, or a sine of 40 ticks",
                     "前馈：无、在 101 与 200 步跳变，或周期 40 步的正弦"}},
    }),
    [](const Params& params, const Plant& plant) -> std::shared_ptr<const Controller> {
      return std::make_shared<Lqg>(params, plant);
    },
});

}  // namespace
}  // namespace vigil
