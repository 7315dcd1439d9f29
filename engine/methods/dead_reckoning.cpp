/// Integrates the known input and listens to nobody: what any sensor must beat.
#include "engine/methods/kalman.hpp"
#include "engine/methods/method.hpp"

namespace vigil {
namespace {

class DeadReckoning final : public Method {
 public:
  explicit DeadReckoning(const Knowledge& knowledge)
      : plant_(knowledge.plant), Q_(knowledge.Q), state_{knowledge.estimates.col(0), knowledge.P0} {}

  std::unique_ptr<Method> clone() const override { return std::make_unique<DeadReckoning>(*this); }
  std::vector<std::string> outputs() const override { return {"fused"}; }

  void predict(const Eigen::VectorXd& input, FaultReport& report) override {
    kalman_predict(state_, *plant_, input, Q_);
    if (state_.mean.allFinite() && state_.covariance.allFinite()) return;
    if (std::string* text = report.stop(0, "diverged")) *text = "the prediction is no longer finite";
  }
  void update(const Readings& /*readings*/, std::span<const Delivery> /*inbox*/, FaultReport& /*report*/) override {}

  Belief belief(int /*output*/) const override {
    return {.mean = state_.mean.data(), .covariance = state_.covariance.data()};
  }

  void retune(const Params& /*params*/) override {}
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  std::shared_ptr<const Plant> plant_;
  Eigen::MatrixXd Q_;
  Gaussian state_;
};

const Registration<MethodMake> registration({
    "dead_reckoning",
    {"Dead reckoning", "航位推算"},
    "recorded robots",
    ParamTable(),
    [](const Params&, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<DeadReckoning>(knowledge);
    },
});

}  // namespace
}  // namespace vigil
