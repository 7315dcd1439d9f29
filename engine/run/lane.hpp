/// One lane of a run: a method, what it hears, what it is worth.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/metrics/attack_score.hpp"
#include "engine/metrics/bound_ratio.hpp"
#include "engine/metrics/detection_score.hpp"
#include "engine/metrics/input_score.hpp"
#include "engine/metrics/lane_score.hpp"
#include "engine/metrics/roc.hpp"
#include "engine/metrics/state_score.hpp"
#include "engine/run/contender.hpp"
#include "engine/run/fault_table.hpp"
#include "engine/run/fusion_side.hpp"

namespace vigil {

/// What a lane is made of besides its method.
struct LaneOptions {
  std::string id, method_id;
  bool spared = false;   ///< the adversary does not touch it
  bool monitor = false;  ///< path "monitor"
  Contender::Side side = Contender::Side::shared;
  std::optional<std::int64_t> last;  ///< the run's last tick
  Json params;
  Json detector;  ///< of the document: {"type","params"} of what is attached; null: nothing is
  ScoreRules rules;
};

class Lane {
 public:
  /// protection: see Contender. detector: attached to every output; null: none.
  Lane(LaneOptions options, std::unique_ptr<Method> method, std::unique_ptr<privacy::Protection> protection,
       const Detector* detector, const World& world, const Graph& graph);
  Lane(const Lane& other);
  Lane(Lane&&) noexcept = default;

  void declare(const World& world, const std::vector<std::string>& nodes, Catalogue& catalogue);
  /// Tick 0.
  void begin(const Tick& tick);
  /// Steps 1 to 7 of a tick.
  void tick(const Tick& tick);
  /// Scores against the truth and writes the lane's signals (NaN once it has stopped). `attacks`: what really happened
  /// to the readings that this lane heard.
  void publish(const Tick& tick, std::span<double> values);
  /// Marks where alarms and faults begin and end.
  void mark_edges(std::int64_t k, Sink& sink);
  void rewire(const Graph& graph, const std::vector<LinkRates>& rates);
  void append_metrics(std::vector<MetricValue>& metrics) const;

  const std::string& id() const { return options_.id; }
  const std::string& method_id() const { return options_.method_id; }
  bool spared() const { return options_.spared; }
  bool monitors() const { return options_.monitor; }
  bool stopped() const { return faults_.stopped(); }
  Method& method() { return contender_.method(); }
  const Method& method() const { return contender_.method(); }
  Contender& contender() { return contender_; }
  const Contender& contender() const { return contender_; }
  /// Where a trace describes the lane's own readings: what happened to them.
  SensorEffects& recorded_effects() { return recorded_effects_; }
  Json& params() { return options_.params; }
  void retune(const Params& params);
  Json& detector() { return options_.detector; }
  void retune_detector(const Params& params);
  FaultTable& faults() { return faults_; }
  const FaultTable& faults() const { return faults_; }
  const std::vector<std::string>& outputs() const { return outputs_; }
  const LaneScore& score() const { return score_; }
  /// Null: it has no fusion centre.
  const FusionSide* fusion_side() const { return fusion_side_ ? &*fusion_side_ : nullptr; }
  /// Keeps errors and bounds of ticks 1 to `ticks` for a campaign's bound ratio; room for them is made here, none in a
  /// tick.
  void record_bounds(std::int64_t ticks);
  BoundRecord take_record() { return std::move(record_); }
  /// Counts for detection curves from now on, where the lane detects.
  void record_detection() { roc_.resize(detection_.size()); }
  /// By output; empty where nothing was recorded.
  const std::vector<RocCounts>& detection_counts() const { return roc_; }

 private:
  struct Slots {
    int estimate, nees = -1, nis = -1;  ///< -1: it has no covariance
    int error[LaneScore::kMaxGroups], bound[LaneScore::kMaxGroups];
    int statistic = -1, threshold = -1, alarm = -1;
    int unknown = -1;  ///< of attacks, faults, then the innovation's norm
  };
  const SensorEffects& effects(const Tick& tick) const;
  void declare_course(const World& world, const std::vector<std::string>& nodes, SignalScope& scope,
                      Catalogue& catalogue);
  void declare_unknown(int output, SignalScope& scope, Slots& slots) const;
  void publish_course(const Tick& tick, std::span<double> values) const;
  void publish_output(std::int64_t k, int output, const Eigen::VectorXd& truth, const Plant& plant,
                      std::span<double> values, double& square);
  void publish_detection(int output, std::span<double> values) const;
  void publish_unknown(int output, std::span<double> values) const;
  void publish_spread(const Plant& plant, std::span<double> values) const;
  void listen(const Tick& tick);
  void judge(const Tick& tick);
  void judge_detection(const Tick& tick);
  bool attacked(const Tick& tick, int output) const;

  LaneOptions options_;
  Contender contender_;
  std::optional<Contender> twin_;  ///< the same lane without any attack, where detection is scored
  std::vector<std::string> outputs_;
  FaultTable faults_, twin_faults_;
  SensorEffects no_effects_, recorded_effects_;
  std::vector<std::vector<int>> components_;  ///< of the plant's states, by output
  LaneScore score_;
  AttackScore attack_score_;
  StateScore state_score_, twin_score_;
  std::vector<DetectionScore> detection_;
  std::vector<RocCounts> roc_;
  InputScore input_score_;
  std::optional<FusionSide> fusion_side_;
  std::vector<char> overheard_;  ///< of every node's link to the centre
  std::vector<double> periods_;
  std::vector<DrivePorts> ports_;  ///< by output; empty: not in continuous time
  std::vector<Slots> slots_;
  int course_slot_ = -1, sensor_slot_ = -1;
  int rmse_slot_ = -1, spread_slot_ = -1;
  std::vector<char> alarms_, marked_;  ///< of each output, as it is and as it was last marked
  bool recording_ = false;
  BoundRecord record_;
};

}  // namespace vigil
