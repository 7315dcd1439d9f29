/// What a lane writes into a frame.
#include <cmath>
#include <limits>

#include "engine/run/lane.hpp"
#include "engine/run/sensor_signals.hpp"

namespace vigil {

void Lane::publish(const Tick& tick, std::span<double> values) {
  if (stopped()) return;
  const Plant& plant = *tick.world.plant;
  const Eigen::VectorXd& truth = contender_.course(tick.shared).truth;
  double square = 0;
  for (int o = 0; o < static_cast<int>(outputs_.size()); ++o) publish_output(tick.k, o, truth, plant, values, square);
  values[static_cast<std::size_t>(rmse_slot_)] = std::sqrt(square / static_cast<double>(outputs_.size()));
  if (spread_slot_ >= 0) publish_spread(plant, values);
  if (options_.side != Contender::Side::shared) publish_course(tick, values);
  if (fusion_side_) fusion_side_->publish(tick.k, *method().fusion(), method(), truth, values);
  method().publish(values);
}

void Lane::publish_course(const Tick& tick, std::span<double> values) const {
  const Course& course = contender_.course(tick.shared);
  auto* at = values.data() + course_slot_;
  for (Eigen::Index c = 0; c < course.truth.size(); ++c) *at++ = course.truth[c];
  if (tick.k == 0) return;
  for (Eigen::Index c = 0; c < course.input.size(); ++c) *at++ = course.input[c];
  for (Eigen::Index c = 0; ports_.empty() && c < course.drives.size(); ++c) *at++ = course.drives[c];
  publish_sensors(course, effects(tick), values.data() + sensor_slot_);
}

void Lane::publish_output(std::int64_t k, int output, const Eigen::VectorXd& truth, const Plant& plant,
                          std::span<double> values, double& square) {
  if (!method().ready()) {
    square = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const Belief belief = method().belief(output);
  const Slots& slots = slots_[static_cast<std::size_t>(output)];
  const auto put = [&](int slot, double value) { values[static_cast<std::size_t>(slot)] = value; };
  const int n = plant.states();
  const auto own = static_cast<int>(components_[static_cast<std::size_t>(output)].size());
  for (int c = 0; c < own; ++c) put(slots.estimate + c, belief.mean[c]);
  const TickScore score = score_.judge(k, output, truth, belief);
  const auto& groups = plant.errors();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    put(slots.error[g], score.error[g]);
    if (belief.covariance == nullptr) continue;
    double trace = 0;
    for (const int c : groups[g].components) trace += belief.covariance[c * n + c];
    put(slots.bound[g], trace);
  }
  if (slots.nees >= 0) {
    put(slots.nees, score.nees);
    put(slots.nis, score.nis);
  }
  if (slots.unknown >= 0) publish_unknown(output, values);
  if (contender_.detects()) publish_detection(output, values);
  square += score.error[0] * score.error[0];
  if (recording_ && k > 0 && belief.covariance != nullptr) {
    const BoundedVector e = state_error(truth, belief.mean, periods_);
    record_.errors.insert(record_.errors.end(), e.data(), e.data() + n);
    record_.bounds.insert(record_.bounds.end(), belief.covariance, belief.covariance + n * n);
  }
}

void Lane::publish_unknown(int output, std::span<double> values) const {
  const UnknownInputs unknown = method().unknown_inputs(output);
  const DrivePorts& ports = ports_[static_cast<std::size_t>(output)];
  auto at = static_cast<std::size_t>(slots_[static_cast<std::size_t>(output)].unknown);
  for (int c = 0; c < ports.w; ++c, ++at) {
    if (unknown.attack != nullptr) values[at] = unknown.attack[c];
  }
  for (int c = 0; c < ports.f; ++c, ++at) {
    if (unknown.fault != nullptr) values[at] = unknown.fault[c];
  }
  values[at] = unknown.innovation;
}

void Lane::publish_detection(int output, std::span<double> values) const {
  const Slots& slots = slots_[static_cast<std::size_t>(output)];
  const Detection detection = contender_.detection(output);
  values[static_cast<std::size_t>(slots.statistic)] = detection.statistic;
  values[static_cast<std::size_t>(slots.threshold)] = detection.threshold;
  if (detection.judged) values[static_cast<std::size_t>(slots.alarm)] = detection.alarm ? 1 : 0;
}

/// Consensus spread: the largest distance of an estimate from the nodes' mean, over the position-like components.
void Lane::publish_spread(const Plant& plant, std::span<double> values) const {
  const auto& components = plant.errors()[0].components;
  const auto count = static_cast<double>(outputs_.size());
  double worst = 0;
  for (const Slots& node : slots_) {
    double square = 0;
    for (const int c : components) {
      double mean = 0;
      for (const Slots& other : slots_) mean += values[static_cast<std::size_t>(other.estimate + c)] / count;
      const double off = values[static_cast<std::size_t>(node.estimate + c)] - mean;
      square += off * off;
    }
    worst = std::max(worst, square);
  }
  values[static_cast<std::size_t>(spread_slot_)] = std::sqrt(worst);
}

}  // namespace vigil
