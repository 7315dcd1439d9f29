#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/papers/curves.hpp"

namespace vigil::papers {
namespace {

constexpr int kPlaces = 300;

/// Maxima whose way down to every higher neighbour is 5 % of the highest at least.
int count_peaks(const std::vector<double>& y) {
  const double step = 0.05 * *std::max_element(y.begin(), y.end());
  int peaks = 0;
  bool rising = true;
  double turn = y.front();
  for (const double value : y) {
    if (rising) {
      if (value > turn) turn = value;
      if (value < turn - step) {
        ++peaks;
        rising = false;
        turn = value;
      }
    } else {
      if (value < turn) turn = value;
      if (value > turn + step) {
        rising = true;
        turn = value;
      }
    }
  }
  return peaks;
}

}  // namespace

Density density_of(std::vector<double> values) {
  Density result;
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.size() < 10) return result;
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const double width = 1.06 * (quantile(0.75) - quantile(0.25)) / 1.34 * std::pow(values.size(), -0.2);
  if (!(width > 0)) return result;
  const double low = quantile(0.001) - width, high = quantile(0.999) + width;
  const double scale = 1 / (static_cast<double>(values.size()) * width * std::sqrt(2 * std::numbers::pi));
  for (int i = 0; i < kPlaces; ++i) {
    const double x = low + (high - low) * i / (kPlaces - 1);
    const auto begin = std::lower_bound(values.begin(), values.end(), x - 5 * width);
    const auto end = std::upper_bound(begin, values.end(), x + 5 * width);
    double sum = 0;
    for (auto value = begin; value != end; ++value) sum += std::exp(-std::pow((x - *value) / width, 2) / 2);
    result.x.push_back(x);
    result.y.push_back(sum * scale);
  }
  result.peaks = count_peaks(result.y);
  return result;
}

}  // namespace vigil::papers
