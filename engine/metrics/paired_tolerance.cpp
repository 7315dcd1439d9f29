#include "engine/metrics/paired_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace vigil {
namespace {

/// The base's values within `shift` ticks of the one that is judged.
class Window {
 public:
  virtual ~Window() = default;
  virtual void enter(std::size_t i) = 0;
  virtual void leave(std::size_t i) = 0;  ///< the oldest that is still in
  virtual bool holds(double value) const = 0;
};

class Band : public Window {
 public:
  Band(std::span<const double> base, const Tolerance& tolerance) : base_(base), tolerance_(tolerance) {}

  void enter(std::size_t i) override {
    if (std::isnan(base_[i])) return;
    while (!low_.empty() && bottom(low_.back()) >= bottom(i)) low_.pop_back();
    while (!high_.empty() && top(high_.back()) <= top(i)) high_.pop_back();
    low_.push_back(i);
    high_.push_back(i);
  }
  void leave(std::size_t i) override {
    if (!low_.empty() && low_.front() == i) low_.pop_front();
    if (!high_.empty() && high_.front() == i) high_.pop_front();
  }
  bool holds(double value) const override {
    return !low_.empty() && value >= bottom(low_.front()) && value <= top(high_.front());
  }

 private:
  double margin(std::size_t i) const { return std::max(tolerance_.abs, tolerance_.rel * std::abs(base_[i])); }
  double bottom(std::size_t i) const { return base_[i] - margin(i); }
  double top(std::size_t i) const { return base_[i] + margin(i); }

  std::span<const double> base_;
  const Tolerance tolerance_;
  std::deque<std::size_t> low_, high_;  ///< of each the front is the extreme; the rest may become it
};

class Values : public Window {
 public:
  explicit Values(std::span<const double> base) : base_(base) {}

  void enter(std::size_t i) override {
    if (!std::isnan(base_[i])) ++counts_[base_[i]];
  }
  void leave(std::size_t i) override {
    if (!std::isnan(base_[i]) && --counts_[base_[i]] == 0) counts_.erase(base_[i]);
  }
  bool holds(double value) const override { return counts_.contains(value); }

 private:
  std::span<const double> base_;
  std::map<double, int> counts_;
};

class Judge {
 public:
  Judge(std::span<const std::int64_t> k, std::span<const double> base, std::span<const double> other)
      : k_(k), base_(base), other_(other) {}

  ToleranceVerdict verdict(Window& window, std::int64_t shift) {
    std::size_t begin = 0, end = 0;
    std::int64_t missing = 0;
    for (std::size_t i = 0; i < k_.size(); ++i) {
      for (; end < k_.size() && k_[end] <= k_[i] + shift; ++end) {
        window.enter(end);
        missing += std::isnan(base_[end]) ? 1 : 0;
      }
      for (; k_[begin] < k_[i] - shift; ++begin) {
        window.leave(begin);
        missing -= std::isnan(base_[begin]) ? 1 : 0;
      }
      note(i, std::isnan(other_[i]) ? missing > 0 : window.holds(other_[i]));
    }
    return std::move(verdict_);
  }

 private:
  void note(std::size_t i, bool inside) {
    ++verdict_.ticks;
    const double apart = std::abs(other_[i] - base_[i]);
    if (!std::isnan(apart) && !(apart <= verdict_.worst)) {
      verdict_.worst = apart;
      verdict_.worst_at = k_[i];
    }
    if (inside) {
      ++verdict_.inside;
    } else {
      if (verdict_.outside.empty()) verdict_.first = k_[i];
      if (last_inside_) verdict_.outside.push_back({k_[i], k_[i]});
      verdict_.outside.back().last = k_[i];
    }
    last_inside_ = inside;
  }

  std::span<const std::int64_t> k_;
  std::span<const double> base_, other_;
  bool last_inside_ = true;
  ToleranceVerdict verdict_;
};

}  // namespace

ToleranceVerdict judge_tolerance(std::span<const std::int64_t> k, std::span<const double> base,
                                 std::span<const double> other, const Tolerance& tolerance) {
  Band band(base, tolerance);
  return Judge(k, base, other).verdict(band, tolerance.shift);
}

ToleranceVerdict judge_equal(std::span<const std::int64_t> k, std::span<const double> base,
                             std::span<const double> other, std::int64_t shift) {
  Values values(base);
  return Judge(k, base, other).verdict(values, shift);
}

}  // namespace vigil
