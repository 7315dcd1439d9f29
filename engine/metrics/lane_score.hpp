/// What a lane is worth: errors against the truth, consistency of its covariances. Alone sees the truth.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/linalg/small.hpp"
#include "engine/methods/method.hpp"
#include "engine/run/run.hpp"
#include "engine/world/plant.hpp"

namespace vigil {

/// What one output's belief is worth at one tick; NaN where it cannot be said.
struct TickScore {
  double error[4] = {};  ///< norm of the error in each of the plant's error groups
  double nees = 0;       ///< e' P^-1 e over the whole state, angles wrapped
  double nis = 0;        ///< r' S^-1 r
};

/// The ticks that count, both ends included. Tick 0, the initial state, never does.
struct ScoreWindow {
  std::int64_t from = 1;
  std::int64_t to = std::numeric_limits<std::int64_t>::max();
  bool holds(std::int64_t k) const { return k >= 1 && k >= from && k <= to; }
};

/// A figure that the scenario asks for: the mean square error of one state component at each output, over ticks of its
/// own.
struct MseFigure {
  std::string name;
  int component = 0;
  ScoreWindow window;
};

/// What the scenario's "metrics" say.
struct ScoreRules {
  ScoreWindow window;
  std::vector<MseFigure> mse;
  std::int64_t detection_from = 50;  ///< first tick that may count as a false alarm
  std::int64_t state_from = 20;      ///< first tick of rmse_state and peak_error
};

/// Sums over the ticks of one lane's window. A value: copies are forks.
class LaneScore {
 public:
  static constexpr int kMaxGroups = 4;
  static constexpr int kWindow = 10;  ///< ticks of rmse_position_last10

  LaneScore() = default;
  /// components: of the plant's states, what each output estimates; empty: all of them.
  LaneScore(const Plant& plant, std::vector<std::string> outputs, ScoreRules rules = {},
            std::vector<std::vector<int>> components = {});

  /// Judges one output; the truth may have NaN. Counts it where the window holds k.
  TickScore judge(std::int64_t k, int output, const Eigen::VectorXd& truth, const Belief& belief);

  /// rmse_<group> (whole lane and per output), rmse_<first group>_last10, the scenario's own figures, nees_mean,
  /// nis_mean.
  void append_metrics(const std::string& lane, std::vector<MetricValue>& metrics) const;
  /// Chi-square intervals (95 %) of one NEES and one NIS, for the lane's design.
  Json bounds(int channels) const;

 private:
  struct Sum {
    double total = 0;
    std::int64_t count = 0;
    void add(double value);
    double mean() const;
  };
  Sum& cell(int output, int group) { return sums_[static_cast<std::size_t>(output * groups() + group)]; }
  const Sum& cell(int output, int group) const { return sums_[static_cast<std::size_t>(output * groups() + group)]; }
  int groups() const { return static_cast<int>(groups_.size()); }

  ScoreRules rules_;
  std::vector<ErrorGroup> groups_;
  std::vector<double> periods_;
  std::vector<std::string> outputs_;
  std::vector<std::vector<int>> components_;            ///< of the plant's states, by output
  std::vector<std::vector<std::vector<int>>> members_;  ///< by output and group: places in the output's own error
  Eigen::VectorXd error_;
  std::vector<Sum> sums_;  ///< squared errors, outputs x groups
  std::vector<Sum> last_;  ///< squared errors of the first group in the last ticks, outputs x kWindow
  std::vector<Sum> mse_;   ///< of each figure in rules_, figures x outputs
  Sum nees_, nis_;
};

/// e = estimate - truth with angles wrapped.
BoundedVector state_error(const Eigen::VectorXd& truth, const double* estimate, const std::vector<double>& periods);

}  // namespace vigil
