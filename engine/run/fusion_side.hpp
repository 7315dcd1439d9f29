/// What a lane with a fusion centre has besides a Method: those who listen to it, and what everybody's estimate is
/// worth. Specification (privacy), sections 1.7 and 9.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/methods/fusion_method.hpp"
#include "engine/metrics/confidentiality_score.hpp"
#include "engine/run/frame.hpp"

namespace vigil {

class FusionSide {
 public:
  /// outputs: the lane's, nodes and then "fused". last: the run's last tick.
  FusionSide(const FusionMethod& method, std::string lane, const std::vector<std::string>& outputs, const Plant& plant,
             std::optional<std::int64_t> last);
  FusionSide(const FusionSide& other);
  FusionSide(FusionSide&&) noexcept = default;

  void declare(const Plant& plant, Catalogue& catalogue);
  /// messages: states x nodes, as sent in this tick; overheard: one a node.
  void listen(const FusionMethod& method, const Eigen::MatrixXd& messages, std::span<const char> overheard);
  /// Scores and writes tick k. `beliefs` are the lane's, by output.
  void publish(std::int64_t k, const FusionMethod& method, const Method& beliefs, const Eigen::VectorXd& truth,
               std::span<double> values);

  void append_metrics(std::vector<MetricValue>& metrics) const;
  void append_ratios(std::vector<RatioRecord>& ratios) const;
  /// trace_legitimate, trace_optimal and trace_eavesdropper {"<variant>":…} as of the newest tick.
  Json traces() const;

 private:
  /// One curve: an estimate whose error is followed.
  struct Curve {
    std::string name, node, variant;  ///< of its metric
    int square = -1, trace = -1;      ///< signals
    double value = 0;                 ///< trace of its covariance, NaN where there is none
    SquareTally tally;
  };
  struct Listener {
    std::string variant;
    std::unique_ptr<privacy::Eavesdropper> who;
    int estimate = -1, ci = -1, ci_mse = -1;
  };
  void add_curve(const std::string& name, const std::string& node, const std::string& variant,
                 std::optional<std::int64_t> last);
  double square(const Eigen::VectorXd& truth, const double* estimate) const;
  void put(Curve& curve, std::int64_t k, double square, double trace, std::span<double> values);
  void publish_nodes(std::int64_t k, const FusionMethod& method, const Method& beliefs, const Eigen::VectorXd& truth,
                     std::span<double> values);
  void publish_indices(std::span<double> values);

  std::string lane_;
  std::vector<std::string> names_;  ///< nodes, "fused", "optimal", "eve.<variant>"
  int nodes_, states_;
  std::vector<double> periods_;
  Eigen::MatrixXd sent_, heard_;  ///< states x nodes
  std::vector<char> hears_;
  std::vector<Listener> listeners_;
  std::vector<Curve> curves_;  ///< legitimate, optimal, one a listener, then local, sent and compensated of every node
  std::vector<int> sent_slots_, compensated_slots_;
  int optimal_slot_ = -1, ci_ = -1, rank_ = -1, ci_mse_ = -1;
};

}  // namespace vigil
