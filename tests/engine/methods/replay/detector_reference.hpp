/// Section 5 of the specification (replay) word for word, on a whole series at once.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "engine/methods/replay/detector.hpp"

namespace vigil::replay::reference {

using Series = std::vector<double>;  // energies of samples 1, 2, ...

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

inline double mean_of(const Series& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

inline double candidate_of(const Series& values, double eta) {
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += std::pow(value - mean, 2);
  return mean + eta * std::sqrt(squares / static_cast<double>(values.size() - 1));
}

struct Judged {
  Series statistic, threshold;
  std::vector<bool> flag;
};

/// Index i is sample i + 1; what is not there yet is NaN.
inline Judged by_the_text(const Series& energies, const DetectorSettings& set) {
  Judged all;
  Series xi, kept;  // all statistics; those the frozen window may hold
  double theta = kNone, last = kNone;
  bool flagged = false;
  for (int i = 0; i < static_cast<int>(energies.size()); ++i) {
    double statistic = kNone;
    if (i + 1 >= set.window) {
      statistic = mean_of(Series(energies.begin() + (i + 1 - set.window), energies.begin() + i + 1));
      xi.push_back(statistic);
      const bool frozen = set.threshold == Threshold::frozen;
      const Series& from = frozen ? kept : xi;
      if (static_cast<int>(from.size()) >= set.tau && !(frozen && flagged)) {
        const double c = candidate_of(Series(from.end() - set.tau, from.end()), set.eta);
        const double against = set.dead_band == DeadBand::held ? theta : last;
        if (std::isnan(theta) || std::abs(c - against) >= set.iota) theta = c;
        last = c;
      }
    }
    flagged = statistic > theta;
    if (i + 1 >= set.window && !flagged) kept.push_back(statistic);
    all.statistic.push_back(statistic);
    all.threshold.push_back(theta);
    all.flag.push_back(flagged);
  }
  return all;
}

}  // namespace vigil::replay::reference
