/// Curves and numbers out of recorded runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/papers/item.hpp"

namespace vigil::papers {

/// Mean with its standard error over independent values; those that are NaN are left out.
Estimate mean_of(const std::vector<double>& values);
/// Root of the mean square with its standard error (delta method).
Estimate root_of(const std::vector<double>& squares);
/// a / b of values that belong together run by run, as the ratio of their means (delta method).
Estimate ratio_of(const std::vector<double>& a, const std::vector<double>& b);

/// What `measure` makes of each run.
std::vector<double> of_runs(const Records& records, const std::function<double(const Record&)>& measure);
/// Mean of a signal over the ticks from..to of one run, missing ones left out.
double over_ticks(const Record& record, const std::string& signal, std::size_t from, std::size_t to);

/// Mean over runs, tick by tick; `transform` of the signal's value where one is given.
std::vector<double> mean_curve(const Records& records, const std::string& signal,
                               const std::function<double(double)>& transform = {});
/// Root of the mean square over runs, tick by tick.
std::vector<double> rms_curve(const Records& records, const std::string& signal);
/// The difference of two signals of a run.
std::vector<double> difference(const Record& record, const std::string& a, const std::string& b);

/// 0, 1, 2, … count - 1.
std::vector<double> ticks(std::size_t count);
/// A series from tick `from` on, at most about 1000 points of it.
Series series(std::string name, const std::vector<double>& x, const std::vector<double>& y, std::string style = "line",
              std::size_t from = 0);

/// A density by Gaussian kernels (Silverman's width) at 300 places within the central 99.8 % of the values.
struct Density {
  std::vector<double> x, y;
  int peaks = 0;  ///< maxima that stand out by 5 % of the highest at least
};
Density density_of(std::vector<double> values);
double skewness_of(const std::vector<double>& values);
/// The normal density, over four standard deviations to both sides.
Series normal(std::string name, double mean, double std, std::string style = "line");

}  // namespace vigil::papers
