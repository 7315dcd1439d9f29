#include "engine/papers/curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace vigil::papers {
namespace {

constexpr std::size_t kMostPoints = 1000;

std::vector<double> present(const std::vector<double>& values) {
  std::vector<double> kept;
  for (const double value : values) {
    if (!std::isnan(value)) kept.push_back(value);
  }
  return kept;
}

}  // namespace

Estimate mean_of(const std::vector<double>& values) {
  const auto kept = present(values);
  const auto n = static_cast<double>(kept.size());
  if (kept.empty()) return {};
  const auto [least, most] = std::minmax_element(kept.begin(), kept.end());
  if (n > 1 && *least == *most) return {*least, 0};  // a sum's rounding is no error of theirs
  const double mean = std::accumulate(kept.begin(), kept.end(), 0.0) / n;
  double squares = 0;
  for (const double value : kept) squares += (value - mean) * (value - mean);
  return {mean, n > 1 ? std::sqrt(squares / (n - 1) / n) : std::nan("")};
}

Estimate root_of(const std::vector<double>& squares) {
  const Estimate mean = mean_of(squares);
  const double root = std::sqrt(mean.value);
  return {root, root > 0 ? mean.se / (2 * root) : mean.se};
}

Estimate ratio_of(const std::vector<double>& a, const std::vector<double>& b) {
  const double below = mean_of(b).value, ratio = mean_of(a).value / below;
  std::vector<double> apart;
  for (std::size_t i = 0; i < a.size(); ++i) apart.push_back((a[i] - ratio * b[i]) / below);
  return {ratio, mean_of(apart).se};
}

std::vector<double> of_runs(const Records& records, const std::function<double(const Record&)>& measure) {
  std::vector<double> values;
  for (const Record& record : records) values.push_back(measure(record));
  return values;
}

double over_ticks(const Record& record, const std::string& signal, std::size_t from, std::size_t to) {
  const auto& all = record.of(signal);
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(std::min(from, all.size()));
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(to + 1, all.size()));
  return mean_of({begin, end}).value;
}

std::vector<double> mean_curve(const Records& records, const std::string& signal,
                               const std::function<double(double)>& transform) {
  std::size_t length = 0;
  for (const Record& record : records) length = std::max(length, record.ticks());
  std::vector<double> sum(length, 0), count(length, 0);
  for (const Record& record : records) {
    const auto& values = record.of(signal);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::isnan(values[k])) continue;
      sum[k] += transform ? transform(values[k]) : values[k];
      count[k] += 1;
    }
  }
  for (std::size_t k = 0; k < length; ++k) sum[k] = count[k] > 0 ? sum[k] / count[k] : std::nan("");
  return sum;
}

std::vector<double> rms_curve(const Records& records, const std::string& signal) {
  auto curve = mean_curve(records, signal, [](double value) { return value * value; });
  for (double& value : curve) value = std::sqrt(value);
  return curve;
}

std::vector<double> difference(const Record& record, const std::string& a, const std::string& b) {
  const auto &left = record.of(a), &right = record.of(b);
  std::vector<double> result;
  for (std::size_t k = 0; k < left.size(); ++k) result.push_back(left[k] - right[k]);
  return result;
}

std::vector<double> ticks(std::size_t count) {
  std::vector<double> result(count);
  std::iota(result.begin(), result.end(), 0.0);
  return result;
}

Series series(std::string name, const std::vector<double>& x, const std::vector<double>& y, std::string style,
              std::size_t from) {
  Series result{std::move(name), {}, {}, std::move(style)};
  const std::size_t count = std::min(x.size(), y.size()), stride = 1 + (count - std::min(from, count)) / kMostPoints;
  for (std::size_t k = from; k < count; k += stride) {
    result.x.push_back(x[k]);
    result.y.push_back(y[k]);
  }
  return result;
}

double skewness_of(const std::vector<double>& values) {
  const double mean = mean_of(values).value;
  double two = 0, three = 0;
  for (const double value : values) {
    two += std::pow(value - mean, 2);
    three += std::pow(value - mean, 3);
  }
  const auto n = static_cast<double>(values.size());
  return three / n / std::pow(two / n, 1.5);
}

Series normal(std::string name, double mean, double std, std::string style) {
  Series result{std::move(name), {}, {}, std::move(style)};
  for (int i = -80; i <= 80; ++i) {
    const double z = i / 20.0;
    result.x.push_back(mean + z * std);
    result.y.push_back(std::exp(-z * z / 2) / (std * std::sqrt(2 * std::numbers::pi)));
  }
  return result;
}

}  // namespace vigil::papers
