/// Integrates the known input and listens to nobody: what any sensor must beat.
#include "engine/methods/kalman.hpp"
#include "engine/methods/method.hpp"

namespace vigil {
namespace {

class DeadReckoning final : public Method {
 public:
  DeadReckoning(const Params& params, const Knowledge& knowledge) : plant_(knowledge.plant), Q_(knowledge.Q) {
    const bool at_nodes = params.text("at") == "nodes";
    ids_ = at_nodes ? knowledge.nodes : std::vector<std::string>{"fused"};
    for (std::size_t i = 0; i < ids_.size(); ++i)
      states_.push_back({knowledge.estimates.col(static_cast<Eigen::Index>(i)), knowledge.P0});
  }

  std::unique_ptr<Method> clone() const override { return std::make_unique<DeadReckoning>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }
  bool reads() const override { return false; }

  void predict(const Eigen::VectorXd& input, FaultReport& report) override {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      Gaussian& state = states_[i];
      kalman_predict(state, *plant_, input, Q_);
      if (state.mean.allFinite() && state.covariance.allFinite()) continue;
      if (std::string* text = report.stop(static_cast<int>(i), "diverged"))
        *text = "the prediction is no longer finite";
      return;
    }
  }

  Belief belief(int output) const override {
    const Gaussian& state = states_[static_cast<std::size_t>(output)];
    return {.mean = state.mean.data(), .covariance = state.covariance.data()};
  }

  void retune(const Params& /*params*/) override {}
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  std::shared_ptr<const Plant> plant_;
  Eigen::MatrixXd Q_;
  std::vector<std::string> ids_;
  std::vector<Gaussian> states_;
};

const Registration<MethodMake> registration({
    "dead_reckoning",
    {"Dead reckoning", "航位推算"},
    "recorded robots; specification of seed 001, section 13, PRED",
    ParamTable({
        {.name = "at",
         .type = ParamType::text,
         .fallback = "fused",
         .choices = {"fused", "nodes"},
         .meaning = {"One prediction from the first node's initial estimate, or one at each node from its own",
                     "由首个节点的初始估计作一个预测，或每个节点由各自的初始估计预测"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<DeadReckoning>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil
