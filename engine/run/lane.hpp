/// One lane of a run: a method, what it hears, what it is worth.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/metrics/attack_score.hpp"
#include "engine/metrics/bound_ratio.hpp"
#include "engine/metrics/lane_score.hpp"
#include "engine/run/fault_table.hpp"

namespace vigil {

class Lane {
 public:
  /// `spared`: the adversary does not touch it. `channels`: of each node's sensor.
  Lane(std::string id, std::string method_id, bool spared, std::unique_ptr<Method> method, Json params,
       const Plant& plant, const std::vector<int>& channels, const Graph& graph, const ScoreRules& rules);
  Lane(const Lane& other);
  Lane(Lane&&) noexcept = default;

  void declare(const Plant& plant, Catalogue& catalogue);
  /// Steps 4, 5 and 7 of a tick. `base` maps each link of `graph` to its place in `effects`.
  void tick(std::int64_t k, const Graph& graph, std::span<const int> base, const LinkEffects& effects,
            const Eigen::VectorXd& input, const Readings& readings);
  /// Scores against the truth and writes the lane's signals (NaN once it has stopped).
  /// `attacks`: what really happened to the readings that this lane heard.
  void publish(std::int64_t k, const Eigen::VectorXd& truth, const SensorEffects& attacks, const Plant& plant,
               std::span<double> values);
  void rewire(const Graph& graph, const std::vector<LinkRates>& rates);

  const std::string& id() const { return id_; }
  const std::string& method_id() const { return method_id_; }
  bool spared() const { return spared_; }
  bool stopped() const { return faults_.stopped(); }
  Method& method() { return *method_; }
  const Method& method() const { return *method_; }
  Json& params() { return params_; }
  FaultTable& faults() { return faults_; }
  const FaultTable& faults() const { return faults_; }
  const std::vector<std::string>& outputs() const { return outputs_; }
  const LaneScore& score() const { return score_; }
  const AttackScore& attack_score() const { return attack_score_; }
  /// Keeps errors and bounds of ticks 1 to `ticks` for a campaign's bound ratio; room for them is made here, none in a
  /// tick.
  void record_bounds(std::int64_t ticks);
  BoundRecord take_record() { return std::move(record_); }

 private:
  struct Slots {
    int estimate, nees, nis;
    int error[LaneScore::kMaxGroups], bound[LaneScore::kMaxGroups];
  };
  void exchange(const Graph& graph, std::span<const int> base, const LinkEffects& effects);
  void publish_output(std::int64_t k, int output, const Eigen::VectorXd& truth, const Plant& plant,
                      std::span<double> values, double& square);
  void publish_spread(const Plant& plant, std::span<double> values) const;

  std::string id_, method_id_;
  bool spared_;
  std::unique_ptr<Method> method_;
  Json params_;
  std::vector<std::string> outputs_;
  std::vector<Delivery> inbox_;
  Eigen::MatrixXd sent_;  ///< message size x nodes
  FaultTable faults_;
  LaneScore score_;
  AttackScore attack_score_;
  std::vector<double> periods_;
  std::vector<Slots> slots_;
  int rmse_slot_ = -1, spread_slot_ = -1;
  bool recording_ = false;
  BoundRecord record_;
};

}  // namespace vigil
