#include "server/papers/scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace vigil::papers {

Scale::Scale(const std::vector<const std::vector<double>*>& values, bool log, double from, double to, bool with_zero)
    : log_(log), from_(from), to_(to) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto* list : values) {
    for (const double value : *list) {
      if (!shows(value)) continue;
      low = std::min(low, of(value));
      high = std::max(high, of(value));
    }
  }
  if (!(low <= high)) return;
  if (with_zero && !log) low = std::min(low, 0.0);
  if (high - low < 1e-12 * std::max(1.0, std::abs(high))) {
    low -= 0.5;
    high += 0.5;
  }
  low_ = low;
  high_ = high;
}

bool Scale::shows(double value) const { return std::isfinite(value) && (!log_ || value > 0); }

double Scale::of(double value) const { return log_ ? std::log10(value) : value; }

double Scale::at(double value) const { return from_ + (of(value) - low_) / (high_ - low_) * (to_ - from_); }

std::vector<double> Scale::ticks() const {
  std::vector<double> result;
  if (log_ && high_ - low_ < 2) {
    for (double power = std::floor(low_); power <= high_; ++power) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(10, power);
        if (of(value) >= low_ && of(value) <= high_) result.push_back(value);
      }
    }
    return result;
  }
  const double raw = (high_ - low_) / 5, power = std::pow(10, std::floor(std::log10(raw)));
  double step = power;
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    step = factor * power;
    if (step >= raw) break;
  }
  if (log_) step = std::max(1.0, std::ceil(step));
  for (double value = std::ceil(low_ / step - 1e-9) * step; value <= high_ + 1e-9 * step; value += step) {
    const double clean = std::abs(value) < 1e-9 * step ? 0 : value;
    result.push_back(log_ ? std::pow(10, clean) : clean);
  }
  return result;
}

std::string tick_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace vigil::papers
