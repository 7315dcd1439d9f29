/// What observers in continuous time are worth: errors of state, attack and fault, each subsystem by itself.
/// Specification (observer), section 9.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/metrics/lane_score.hpp"
#include "engine/run/run.hpp"
#include "engine/world/continuous.hpp"

namespace vigil {

/// Sums over the recorded samples of the scenario's window. A value: copies are forks.
class InputScore {
 public:
  InputScore() = default;
  /// components: of the plant's states, by output. ports: by output.
  InputScore(const std::vector<std::vector<int>>& components, std::vector<DrivePorts> ports, ScoreWindow window);

  /// truth: states; drives: by the plant's ports; entries that are not known (NaN) are left out.
  void note(std::int64_t k, int output, const Eigen::VectorXd& truth, const Eigen::VectorXd& drives,
            const double* estimate, const UnknownInputs& unknown);

  /// rms_state_error (of the largest component), rms_attack_error, rms_fault_error (of the norm), and the same with
  /// peak_, by output; nothing where an output has no attack or no fault.
  void append_metrics(const std::string& lane, const std::vector<std::string>& outputs,
                      std::vector<MetricValue>& metrics) const;

 private:
  struct Sum {
    double total = 0, peak = 0;
    std::int64_t count = 0;
    void add(double square);
    double rms() const;
  };
  struct Output {
    std::vector<int> components;
    DrivePorts ports;
    std::vector<Sum> states;
    Sum attack, fault;
  };
  std::vector<Output> outputs_;
  ScoreWindow window_;
};

}  // namespace vigil
