#include "engine/methods/replay/detector.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::replay {
namespace {

constexpr double kZeroEnergy = 1e-14;
constexpr double kMostEnergy = 1e150;  // its square is still finite
constexpr std::int64_t kLearnFrom = 3, kLearnTo = 49;

}  // namespace

void EnergyDetector::Ring::restart(int size) {
  values.assign(static_cast<std::size_t>(size), 0.0);
  count = next = 0;
}

void EnergyDetector::Ring::push(double value) {
  values[next] = value;
  next = next + 1 == values.size() ? 0 : next + 1;
  count = std::min(count + 1, values.size());
}

/// Corrected by the mean of what it leaves: exact where all values are equal.
double EnergyDetector::Ring::mean() const {
  const auto size = static_cast<double>(count);
  double sum = 0, rest = 0;
  for (std::size_t i = 0; i < count; ++i) sum += values[i];
  const double first = sum / size;
  for (std::size_t i = 0; i < count; ++i) rest += values[i] - first;
  return first + rest / size;
}

EnergyDetector::EnergyDetector(const DetectorSettings& settings) : settings_(settings) {
  energies_.restart(settings.window);
  statistics_.restart(settings.tau);
}

void EnergyDetector::retune(const DetectorSettings& settings) {
  const DetectorSettings old = settings_;
  settings_ = settings;
  if (settings.window != old.window) energies_.restart(settings.window);
  if (settings.window != old.window || settings.tau != old.tau || settings.threshold != old.threshold) {
    statistics_.restart(settings.tau);
    has_threshold_ = flagged_ = false;
  }
}

Verdict EnergyDetector::hold() const {
  return {.has_threshold = has_threshold_, .threshold = has_threshold_ ? threshold_ : 0};
}

Verdict EnergyDetector::judge(std::int64_t k, const Eigen::Ref<const Eigen::VectorXd>& residual) {
  if (!residual.allFinite()) return hold();
  double energy = std::min(residual.squaredNorm(), kMostEnergy);
  if (energy < kZeroEnergy) energy = 0;
  ++residuals_;
  seen_energy_ = seen_energy_ || energy > 0;
  energies_.push(energy);
  learn(k, energy);
  Verdict verdict;
  verdict.has_statistic = energies_.full();
  if (verdict.has_statistic) {
    verdict.statistic = energies_.mean();
    if (settings_.threshold == Threshold::printed) statistics_.push(verdict.statistic);
    follow();
  }
  verdict.has_threshold = has_threshold_;
  verdict.threshold = has_threshold_ ? threshold_ : 0;
  flagged_ = verdict.has_statistic && has_threshold_ && verdict.statistic > threshold_;
  verdict.flag = flagged_;
  if (settings_.threshold == Threshold::frozen && verdict.has_statistic && !flagged_) {
    statistics_.push(verdict.statistic);
  }
  return verdict;
}

/// Gathers what the fixed thresholds are the largest of, and makes one of it when the time is over.
void EnergyDetector::learn(std::int64_t k, double energy) {
  if (k >= kLearnFrom && k <= kLearnTo) {
    learned_ = true;
    largest_ = std::max(largest_, energy);
  }
  if (!fixed()) return;
  has_threshold_ = learned_ && k > kLearnTo;
  threshold_ = settings_.threshold == Threshold::fixed_norm ? std::sqrt(largest_) : largest_;
}

/// The dynamic thresholds: the candidate, unless the dead-band or, frozen, the flag of the tick before holds the old
/// one.
void EnergyDetector::follow() {
  if (fixed() || !statistics_.full()) return;
  if (settings_.threshold == Threshold::frozen && flagged_) return;
  const double next = candidate();
  const double before = settings_.dead_band == DeadBand::held ? threshold_ : last_candidate_;
  if (!has_threshold_ || std::abs(next - before) >= settings_.iota) threshold_ = next;
  last_candidate_ = next;
  has_threshold_ = true;
}

/// Mean and standard deviation in two passes over the window: a running sum of squares cancels where xi hardly changes.
double EnergyDetector::candidate() const {
  const double mean = statistics_.mean();
  double squares = 0;
  for (const double value : statistics_.values) squares += (value - mean) * (value - mean);
  return mean + settings_.eta * std::sqrt(squares / static_cast<double>(statistics_.values.size() - 1));
}

bool can_rise(int tau, double eta) { return eta * eta < (tau - 1.0) * (tau - 1.0) / tau; }

int longest_step_flag(int tau, double eta) {
  const double limit = tau / (1 + eta * eta * tau / (tau - 1.0));
  return static_cast<int>(std::ceil(limit)) - 1;
}

}  // namespace vigil::replay
