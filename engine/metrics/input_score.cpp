#include "engine/metrics/input_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil {

void InputScore::Sum::add(double square) {
  if (!std::isfinite(square)) return;
  total += square;
  peak = std::max(peak, std::sqrt(square));
  ++count;
}

double InputScore::Sum::rms() const {
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(total / static_cast<double>(count));
}

InputScore::InputScore(const std::vector<std::vector<int>>& components, std::vector<DrivePorts> ports,
                       ScoreWindow window)
    : window_(window) {
  for (std::size_t o = 0; o < components.size(); ++o)
    outputs_.push_back({components[o], ports[o], std::vector<Sum>(components[o].size()), {}, {}});
}

void InputScore::note(std::int64_t k, int output, const Eigen::VectorXd& truth, const Eigen::VectorXd& drives,
                      const double* estimate, const UnknownInputs& unknown) {
  if (!window_.holds(k)) return;
  Output& own = outputs_[static_cast<std::size_t>(output)];
  for (std::size_t c = 0; c < own.components.size(); ++c) {
    const double e = estimate[c] - truth[own.components[c]];
    own.states[c].add(e * e);
  }
  const auto square = [&](const double* found, int first, int count) {
    double sum = 0;
    for (int c = 0; c < count; ++c) sum += (found[c] - drives[first + c]) * (found[c] - drives[first + c]);
    return sum;
  };
  if (unknown.attack != nullptr && own.ports.w > 0)
    own.attack.add(square(unknown.attack, own.ports.at_w(), own.ports.w));
  if (unknown.fault != nullptr && own.ports.f > 0) own.fault.add(square(unknown.fault, own.ports.at_f(), own.ports.f));
}

void InputScore::append_metrics(const std::string& lane, const std::vector<std::string>& outputs,
                                std::vector<MetricValue>& metrics) const {
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    const Output& own = outputs_[o];
    const auto add = [&](const char* what, double rms, double peak) {
      metrics.push_back({lane, outputs[o], std::string("rms_") + what, "", rms, false});
      metrics.push_back({lane, outputs[o], std::string("peak_") + what, "", peak, false});
    };
    double rms = 0, peak = 0;
    for (const Sum& state : own.states) {
      rms = std::isfinite(state.rms()) ? std::max(rms, state.rms()) : state.rms();
      peak = std::max(peak, state.peak);
    }
    add("state_error", rms, peak);
    if (own.attack.count > 0) add("attack_error", own.attack.rms(), own.attack.peak);
    if (own.fault.count > 0) add("fault_error", own.fault.rms(), own.fault.peak);
  }
}

}  // namespace vigil
