/// The generalised minimum-error-entropy Kalman filter. Seed 003, reference [25]; specification, section 8.1.
#include <Eigen/Cholesky>

#include "engine/methods/method.hpp"
#include "engine/methods/replay/gmee_update.hpp"
#include "engine/methods/replay/start.hpp"

namespace vigil::replay {
namespace {

GmeeSettings settings_of(const Params& params) {
  return {params.real("alpha"), params.real("beta"),
          params.text("form") == "square" ? GmeeForm::square : GmeeForm::diff};
}

/// Checks before anything is made of them.
const System& definite(const System& system) {
  for (const auto& [name, matrix] : {std::pair{"noise.Q", &system.P}, std::pair{"R", &system.R}}) {
    if (matrix->llt().info() != Eigen::Success)
      throw InputError("/", named(name, *matrix) +
                                " and is singular; the error-entropy filter expects both random noises positive "
                                "definite");
  }
  return system;
}

class Gmeekf final : public Method {
 public:
  Gmeekf(const Params& params, const Knowledge& knowledge)
      : system_(definite(read_system(knowledge))),
        ids_(knowledge.nodes),
        start_(system_),
        settings_(settings_of(params)),
        update_(system_.C, system_.R, settings_),
        x_(knowledge.estimates.col(0)),
        P_(start_.batch().error(system_.P, system_.R, system_.Mw, system_.Mv).Q) {}

  std::unique_ptr<Method> clone() const override { return std::make_unique<Gmeekf>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }
  bool ready() const override { return started_; }
  bool has_bound() const override { return false; }

  void predict(const Eigen::VectorXd& input, FaultReport& /*report*/) override {
    input_ = input;
    if (!started_) return;
    BoundedVector next = system_.B * input_;
    next.noalias() += system_.A * x_;
    x_ = next;
    const BoundedMatrix AP = system_.A * P_;
    P_ = system_.P;
    P_.noalias() += AP * system_.A.transpose();
    symmetrise(P_);
  }

  void measure(const Readings& readings, FaultReport& report) override {
    const Eigen::VectorXd& reading = readings.front();
    if (!started_) {
      const auto estimate = start_.take(input_, reading);
      started_ = estimate.has_value();
      if (started_) x_ = *estimate;
      return;
    }
    const auto step = reading.allFinite() ? update_.update(x_, P_, reading) : std::nullopt;
    if (step) {
      x_ = step->x;
      P_ = step->P;
      unconverged_ += step->converged ? 0 : 1;
      return;
    }
    if (std::string* text = report.fault(0, reading.allFinite() ? "no_gain" : "no_reading"))
      *text = reading.allFinite() ? "the iteration left the finite numbers; the reading was not used"
                                  : "no finite reading; the prediction stands";
  }

  Belief belief(int /*output*/) const override { return {.mean = x_.data(), .covariance = P_.data()}; }

  Json design() const override {
    return {{"alpha", settings_.alpha},
            {"beta", settings_.beta},
            {"form", settings_.form == GmeeForm::square ? "square" : "diff"}};
  }
  std::vector<OwnMetric> metrics() const override {
    return {{-1, "unconverged", static_cast<double>(unconverged_), false}};
  }
  void retune(const Params& /*params*/) override {}
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  System system_;
  std::vector<std::string> ids_;
  Start start_;
  GmeeSettings settings_;
  GmeeUpdate update_;
  Eigen::VectorXd input_;
  BoundedVector x_;
  BoundedMatrix P_;
  bool started_ = false;
  std::int64_t unconverged_ = 0;
};

const Registration<MethodMake> registration({
    "gmeekf",
    {"Minimum-error-entropy Kalman filter", "广义最小误差熵卡尔曼滤波器"},
    "seed 003, reference [25]; specification, section 8.1",
    ParamTable({
        {.name = "alpha",
         .fallback = 2.0,
         .minimum = 0,
         .maximum = 100,
         .exclusive_minimum = true,
         .symbol = "α",
         .meaning = {"Shape of the kernel", "核函数形状参数"}},
        {.name = "beta",
         .fallback = 2.0,
         .minimum = 0,
         .maximum = 1e9,
         .exclusive_minimum = true,
         .symbol = "β",
         .meaning = {"Width of the kernel", "核函数宽度"}},
        {.name = "form",
         .type = ParamType::text,
         .fallback = "square",
         .choices = {"square", "diff"},
         .meaning = {"Weights Psi'Psi + Phi'Phi, or Psi - Phi", "权矩阵取 Ψ'Ψ + Φ'Φ 或 Ψ - Φ"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<Gmeekf>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::replay
