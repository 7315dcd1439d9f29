#include "engine/metrics/paired.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/metrics/paired_law.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostBatches = 20, kFewestPairs = 20;

std::vector<double> differences(std::span<const double> a, std::span<const double> b) {
  std::vector<double> all;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isfinite(a[i]) && std::isfinite(b[i])) all.push_back(b[i] - a[i]);
  }
  return all;
}

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Fills what follows from independent values; the mean is there already.
void judge(std::span<const double> values, PairedDifference& result) {
  if (values.size() < 2) return;
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto n = static_cast<double>(values.size());
  result.se = std::sqrt(squares / (n - 1) / n);
  const double reach = student_quantile(0.975, n - 1) * result.se;
  result.lo = result.mean - reach;
  result.hi = result.mean + reach;
  result.p = signed_rank_p(values);
}

double neighbour_correlation(std::span<const double> values) {
  const double mean = mean_of(values);
  double squares = 0, products = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    squares += (values[i] - mean) * (values[i] - mean);
    if (i > 0) products += (values[i] - mean) * (values[i - 1] - mean);
  }
  return squares > 0 ? products / squares : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

PairedDifference paired_difference(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> all = differences(a, b);
  PairedDifference result;
  result.n = static_cast<std::int64_t>(all.size());
  if (all.empty()) return result;
  result.mean = mean_of(all);
  judge(all, result);
  return result;
}

PairedDifference paired_in_time(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> all = differences(a, b);
  PairedDifference result;
  result.n = static_cast<std::int64_t>(all.size());
  if (all.empty()) return result;
  result.mean = mean_of(all);
  if (all.size() < kFewestPairs) return result;
  const std::size_t batches = std::min(kMostBatches, all.size() / 2);
  std::vector<double> means;
  for (std::size_t i = 0; i < batches; ++i) {
    const std::size_t begin = i * all.size() / batches, end = (i + 1) * all.size() / batches;
    means.push_back(mean_of(std::span(all).subspan(begin, end - begin)));
  }
  result.batches = static_cast<int>(batches);
  result.lag1 = neighbour_correlation(means);
  judge(means, result);
  return result;
}

}  // namespace vigil
