/// One extended Kalman filter over every sensor, which uses no channel: the attack-free lower bound. Specification of
/// seed 000, section 9.
#include <algorithm>
#include <cmath>

#include "engine/linalg/chi_square.hpp"
#include "engine/methods/kalman.hpp"
#include "engine/methods/method.hpp"

namespace vigil {
namespace {

class CentralizedEkf final : public Method {
 public:
  CentralizedEkf(const Params& params, const Knowledge& knowledge)
      : plant_(knowledge.plant),
        sensors_(knowledge.sensors),
        Q_(knowledge.Q),
        state_{knowledge.estimates.col(0), knowledge.P0} {
    int channels = 0;
    for (const auto& sensor : sensors_) channels += sensor->size();
    whitened_.resize(channels);
    retune(params);
  }

  std::unique_ptr<Method> clone() const override { return std::make_unique<CentralizedEkf>(*this); }
  std::vector<std::string> outputs() const override { return {"fused"}; }

  void declare(SignalScope& scope) override { used_slot_ = scope.add(0, "readings_used", "", SignalKind::scalar); }

  void predict(const Eigen::VectorXd& input, FaultReport& report) override {
    kalman_predict(state_, *plant_, input, Q_);
    if (!state_.mean.allFinite()) stop(report);
  }

  /// The stacked update, one sensor after another: R is block-diagonal, so conditioning on each in turn at the same
  /// linearisation point is the same algebra with small matrices.
  void update(const Readings& readings, std::span<const Delivery> /*inbox*/, FaultReport& report) override {
    const Gaussian prior = state_;
    whitened_size_ = 0;
    used_ = 0;
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      Innovation innovation = innovate(*sensors_[i], readings[i], prior.mean);
      if (innovation.empty() || !passes_gate(innovation, prior.covariance)) continue;
      const BoundedVector moved = state_.mean - prior.mean;
      innovation.r.noalias() -= innovation.H * moved;
      append_whitened(innovation);
      ++used_;
      if (kalman_update(state_, innovation)) continue;
      stop(report);
      return;
    }
    const int size = std::min(whitened_size_, kMaxSmall);
    if (identity_.rows() != size) identity_ = BoundedMatrix::Identity(size, size);
  }

  Belief belief(int /*output*/) const override {
    Belief belief{.mean = state_.mean.data(), .covariance = state_.covariance.data()};
    if (whitened_size_ > 0) {
      belief.innovation = whitened_.data();
      belief.innovation_size = whitened_size_;
      if (whitened_size_ == identity_.rows()) belief.innovation_covariance = identity_.data();
    }
    return belief;
  }

  void publish(std::span<double> values) const override { values[static_cast<std::size_t>(used_slot_)] = used_; }

  Json design() const override { return {{"gate", gate_ > 0 ? Json(gate_) : Json(nullptr)}}; }

  void retune(const Params& params) override { gate_ = params.given("gate") ? params.real("gate") : 0; }
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  static void stop(FaultReport& report) {
    if (std::string* text = report.stop(0, "diverged")) *text = "the filter over all sensors is no longer finite";
  }

  bool passes_gate(const Innovation& innovation, const BoundedMatrix& P) {
    if (gate_ <= 0) return true;
    const auto size = static_cast<std::size_t>(innovation.r.size());
    if (limit_gate_ != gate_) {
      for (std::size_t m = 1; m < std::size(limits_); ++m)
        limits_[m] = chi_square_quantile(gate_, static_cast<double>(m));
      limit_gate_ = gate_;
    }
    return mahalanobis(innovation, P) <= limits_[size];
  }

  void append_whitened(const Innovation& innovation) {
    const Eigen::LLT<BoundedMatrix> cholesky(innovation_covariance(innovation, state_.covariance));
    const auto size = static_cast<int>(innovation.r.size());
    const BoundedVector whitened = cholesky.matrixL().solve(innovation.r);
    for (int i = 0; i < size; ++i) whitened_[whitened_size_ + i] = whitened[i];
    whitened_size_ += size;
  }

  std::shared_ptr<const Plant> plant_;
  std::vector<std::shared_ptr<const Sensor>> sensors_;
  Eigen::MatrixXd Q_;
  Gaussian state_;
  double gate_ = 0, limit_gate_ = 0;
  double limits_[kMaxSmall + 1] = {};
  Eigen::VectorXd whitened_;  ///< innovations of this tick, each whitened by its own covariance: together N(0, I)
  int whitened_size_ = 0;
  BoundedMatrix identity_;  ///< their covariance, where they are few enough to be judged as one innovation
  int used_ = 0;
  int used_slot_ = 0;
};

const Registration<MethodMake> registration({
    "centralized_ekf",
    {"One filter over all sensors", "集中式滤波"},
    "specification of seed 000, section 9",
    ParamTable({
        {.name = "gate",
         .minimum = 0,
         .maximum = 1,
         .exclusive_minimum = true,
         .exclusive_maximum = true,
         .nullable = true,
         .live = true,
         .meaning = {"A sensor whose innovation lies outside this share of its chi-square law is left out; none given: "
                     "all are used",
                     "新息落在卡方分布该概率之外的传感器不使用；未给出时全部使用"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<CentralizedEkf>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil
