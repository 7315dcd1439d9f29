/// Where a number stands on a drawn axis, and which numbers the axis shows.
#pragma once

#include <string>
#include <vector>

namespace vigil::papers {

class Scale {
 public:
  /// From pixel `from` (of the least value) to pixel `to`. Values that cannot be shown are left out of the range.
  Scale(const std::vector<const std::vector<double>*>& values, bool log, double from, double to,
        bool with_zero = false);
  bool shows(double value) const;
  double at(double value) const;  ///< px
  std::vector<double> ticks() const;

 private:
  double of(double value) const;

  bool log_;
  double low_ = 0, high_ = 1, from_, to_;
};

/// At most four significant digits.
std::string tick_text(double value);

}  // namespace vigil::papers
