/// One ordinary extended Kalman filter a node: no consensus, no inflation, no guard. Specification of seed 000, section
/// 9, `isolated`.
#include "engine/methods/kalman.hpp"
#include "engine/methods/method.hpp"

namespace vigil {
namespace {

class LocalEkf final : public Method {
 public:
  explicit LocalEkf(const Knowledge& knowledge)
      : plant_(knowledge.plant), sensors_(knowledge.sensors), ids_(knowledge.nodes), Q_(knowledge.Q) {
    for (Eigen::Index i = 0; i < knowledge.estimates.cols(); ++i)
      states_.push_back({knowledge.estimates.col(i), knowledge.P0});
    innovations_.resize(states_.size());
    covariances_.resize(states_.size());
  }

  std::unique_ptr<Method> clone() const override { return std::make_unique<LocalEkf>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }

  void predict(const Eigen::VectorXd& input, FaultReport& report) override {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      kalman_predict(states_[i], *plant_, input, Q_);
      if (!states_[i].mean.allFinite()) stop(i, report);
    }
  }

  void update(const Readings& readings, std::span<const Delivery> /*inbox*/, FaultReport& report) override {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      innovations_[i] = innovate(*sensors_[i], readings[i], states_[i].mean);
      if (innovations_[i].empty()) continue;
      covariances_[i] = innovation_covariance(innovations_[i], states_[i].covariance);
      if (kalman_update(states_[i], innovations_[i])) continue;
      stop(i, report);
      return;
    }
  }

  Belief belief(int output) const override {
    const auto i = static_cast<std::size_t>(output);
    Belief belief{.mean = states_[i].mean.data(), .covariance = states_[i].covariance.data()};
    if (!innovations_[i].empty()) {
      belief.innovation = innovations_[i].r.data();
      belief.innovation_covariance = covariances_[i].data();
      belief.innovation_size = static_cast<int>(innovations_[i].r.size());
    }
    return belief;
  }

  void retune(const Params& /*params*/) override {}
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  void stop(std::size_t i, FaultReport& report) const {
    if (std::string* text = report.stop(static_cast<int>(i), "diverged"))
      *text = "node " + ids_[i] + ": the filter is no longer finite";
  }

  std::shared_ptr<const Plant> plant_;
  std::vector<std::shared_ptr<const Sensor>> sensors_;
  std::vector<std::string> ids_;
  Eigen::MatrixXd Q_;
  std::vector<Gaussian> states_;
  std::vector<Innovation> innovations_;
  std::vector<BoundedMatrix> covariances_;
};

const Registration<MethodMake> registration({
    "local_ekf",
    {"A filter at each node alone", "各节点独立滤波"},
    "specification of seed 000, section 9",
    ParamTable(),
    [](const Params&, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<LocalEkf>(knowledge);
    },
});

}  // namespace
}  // namespace vigil
