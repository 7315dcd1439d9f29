#include "engine/identify/whiteness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/linalg/chi_square.hpp"

namespace vigil::identify {

Whiteness ljung_box(const Eigen::Ref<const Eigen::VectorXd>& residuals, int lags, int fitted) {
  double sum = 0, count = 0;
  for (const double value : residuals) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  const double mean = count > 0 ? sum / count : 0;
  const auto products = [&](Eigen::Index lag) {
    double total = 0;
    for (Eigen::Index k = lag; k < residuals.size(); ++k) {
      const double product = (residuals[k] - mean) * (residuals[k - lag] - mean);
      if (std::isfinite(product)) total += product;
    }
    return total;
  };
  Whiteness result;
  result.lags = std::max(1, std::min(lags, static_cast<int>(count) - 1));
  result.degrees = result.lags - fitted;
  const double power = products(0);
  if (result.degrees < 1 || !(power > 0) || count < 3) {
    result.p = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  for (int lag = 1; lag <= result.lags; ++lag) {
    const double correlation = products(lag) / power;
    result.statistic += count * (count + 2) * correlation * correlation / (count - lag);
  }
  result.p = 1 - chi_square_cdf(result.statistic, result.degrees);
  return result;
}

}  // namespace vigil::identify
