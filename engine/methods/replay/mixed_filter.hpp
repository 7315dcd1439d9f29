/// The mixed estimator with its detector and its keyed watermark: every profile of seed 003. Specification, sections 4
/// to 7.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/methods/replay/detector.hpp"
#include "engine/methods/replay/schedule.hpp"
#include "engine/methods/replay/start.hpp"
#include "engine/random/draws.hpp"

namespace vigil::replay {

enum class Watermark { none, sensor, control };

class MixedFilter final : public Method {
 public:
  /// Throws InputError for what the table cannot check: section 10 of the specification.
  MixedFilter(const Params& params, const Knowledge& knowledge);

  std::unique_ptr<Method> clone() const override { return std::make_unique<MixedFilter>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }
  void declare(SignalScope& scope) override;

  bool marks() const override { return watermark_ == Watermark::sensor; }
  void emit(int node, const Eigen::VectorXd& reading, const Eigen::VectorXd& input, Eigen::VectorXd& sent) override;
  void predict(const Eigen::VectorXd& input, FaultReport& report) override;
  void measure(const Readings& readings, FaultReport& report) override;
  void judge(const Readings& arrived, FaultReport& report) override;
  void mark_input(std::int64_t k, Eigen::Ref<Eigen::VectorXd> u) override;
  bool ready() const override { return started_at_ > 0; }

  Belief belief(int output) const override;
  bool detects() const override { return true; }
  Detection detection(int output) const override;
  int tail() const override { return detector_.settings().window - 1; }
  void publish(std::span<double> values) const override;
  Json design() const override;
  std::vector<std::string> warnings() const override;
  bool has_bound() const override { return false; }
  void retune(const Params& params) override;
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  void begin(const BoundedVector& estimate);
  void correct(const Eigen::VectorXd& reading, FaultReport& report);
  /// s_k of the sensor's mark; zero where there is none.
  void unmark(Eigen::VectorXd& reading) const;

  System system_;
  std::vector<std::string> ids_;
  Start start_;
  MixedUpdate update_;
  Bounds first_;  ///< Q_n, M_n
  std::shared_ptr<const Schedule> schedule_;
  bool on_schedule_ = true;
  bool by_innovation_, monitor_;
  Watermark watermark_;
  double amplitude_;
  Draws sensor_key_, control_key_;
  EnergyDetector detector_;

  std::int64_t k_ = 0, started_at_ = 0;
  BoundedVector x_, predicted_;
  Bounds bounds_;
  BoundedMatrix spread_;  ///< Q + M
  double zeta_ = 1;
  Eigen::VectorXd input_, heard_, residual_;
  Verdict verdict_;
  bool judged_ = false;
  int sets_slot_ = -1, residual_slot_ = -1, zeta_slot_ = -1;
};

}  // namespace vigil::replay
