/// How well a lane finds the attacks on its sensors. Alone compares with the truth. Specification of seed 001, section
/// 13.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/adversary/attack.hpp"
#include "engine/methods/method.hpp"
#include "engine/run/run.hpp"

namespace vigil {

/// Sums over the ticks of one lane. A value: copies are forks.
class AttackScore {
 public:
  AttackScore() = default;
  /// `channels`: one count a node; `window`: the longest reconstruction in readings, 0 where the lane makes none.
  AttackScore(const std::vector<int>& channels, int window, int outputs);

  /// What really happened to every sensor in the tick that is being judged. Call it first.
  void note(const std::vector<Eigen::VectorXd>& injected, const std::vector<SensorState>& states);
  /// `output` stands at the node of the same index.
  void judge(int output, const Reconstruction& found, int choice);

  /// alarm_rate_clean, omp_exact, omp_hit_rate and omp_false_entries (variant: the type of the attack) of the lane, as
  /// far as it had such windows; choice_attacked_share of each output that chose.
  void append_metrics(const std::string& lane, const std::vector<std::string>& outputs,
                      std::vector<MetricValue>& metrics) const;

 private:
  static constexpr int kStates = 7;
  struct Node {
    Eigen::MatrixXd injected;         ///< channels x window, a ring of ticks
    std::vector<SensorState> states;  ///< of the same ticks
    std::int64_t chosen = 0, chosen_attacked = 0;
  };
  struct Tally {
    std::int64_t windows = 0, exact = 0, entries = 0, hits = 0, false_entries = 0;
  };
  void judge_window(const Node& node, const Reconstruction& found);
  int place(int back, int window) const;

  int window_ = 0;
  std::int64_t ticks_ = 0;  ///< noted so far
  std::vector<Node> nodes_;
  Tally of_type_[kStates];
  std::int64_t clean_windows_ = 0, clean_alarms_ = 0;
};

}  // namespace vigil
