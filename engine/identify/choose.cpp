#include "engine/identify/choose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/input_error.hpp"

namespace vigil::identify {
namespace {

constexpr double kSlack = 1.01;      ///< a larger order must be better than this
constexpr double kFurthestRun = 10;  ///< standard deviations that a free run may be off, root mean square
constexpr int kWhitenessLags = 24;

/// Mean square of a column's finite entries.
double mean_square(const Eigen::VectorXd& column) {
  double sum = 0, count = 0;
  for (const double value : column) {
    if (!std::isfinite(value)) continue;
    sum += value * value;
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double variance(const Eigen::VectorXd& column) {
  double sum = 0, count = 0;
  for (const double value : column) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return mean_square(column.array() - sum / count);
}

/// What a model does on the rows from `from` on, by output.
struct Held {
  Eigen::VectorXd error, still, variance;  ///< mean squares: of one step, of the row before, of the output itself
};

Held held_back(const Arx& model, const Records& records, Eigen::Index from) {
  const Eigen::Index rows = records.outputs.rows() - from, n = records.outputs.cols();
  const Eigen::MatrixXd left = residuals(model, records).bottomRows(rows);
  const Eigen::MatrixXd now = records.outputs.bottomRows(rows), before = records.outputs.middleRows(from - 1, rows);
  Held held{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index c = 0; c < n; ++c) {
    held.error[c] = mean_square(left.col(c));
    held.still[c] = mean_square(now.col(c) - before.col(c));
    held.variance[c] = variance(now.col(c));
    if (held.variance[c] > 0 && std::isfinite(held.error[c])) continue;
    throw InputError("/holdout",
                     records.output(c) + " says nothing in the rows held back: it is missing or never changes there");
  }
  return held;
}

void try_one(const Records& records, Eigen::Index from, Candidate& candidate) {
  try {
    const Arx model = fit(records, 0, from, candidate.order, candidate.lag);
    candidate.radius = model.fitted_radius;
    const Held held = held_back(model, records, from);
    const Eigen::ArrayXd share = (held.error.array() / held.variance.array()).max(1e-24);
    candidate.one_step = std::exp(0.5 * share.log().mean());
    candidate.free_run = (free_run_error(model, records, from).array() / held.variance.array().sqrt()).maxCoeff();
    if (!(candidate.free_run <= kFurthestRun))
      candidate.refused = fmt::format("its free run is off by {:.3g} standard deviations", candidate.free_run);
  } catch (const InputError& error) {
    candidate.refused = error.problems().front().detail;
  }
}

std::vector<Candidate> try_all(const Records& records, Eigen::Index from, const Settings& settings) {
  std::vector<Candidate> tried;
  const auto n = static_cast<int>(records.outputs.cols());
  for (int order = 1; order <= settings.max_order && order * n <= settings.most_states; ++order) {
    for (int lag = settings.lag.value_or(0); lag <= settings.lag.value_or(records.inputs.cols() > 0 ? 1 : 0); ++lag) {
      Candidate candidate;
      candidate.order = order;
      candidate.lag = lag;
      try_one(records, from, candidate);
      tried.push_back(std::move(candidate));
    }
  }
  return tried;
}

int pick(const std::vector<Candidate>& tried) {
  double best = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : tried) {
    if (candidate.refused.empty()) best = std::min(best, candidate.one_step);
  }
  int chosen = -1;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const Candidate& candidate = tried[i];
    if (!candidate.refused.empty() || candidate.one_step > kSlack * best) continue;
    const bool first = chosen < 0;
    const Candidate& other = tried[static_cast<std::size_t>(std::max(chosen, 0))];
    if (first || (candidate.order == other.order && candidate.one_step < other.one_step)) chosen = static_cast<int>(i);
  }
  if (chosen < 0) throw InputError("/rows", "no linear model fits: " + tried.front().refused);
  return chosen;
}

void check(const Records& records, const Settings& settings) {
  const auto n = static_cast<int>(records.outputs.cols());
  if (n < 1 || n > settings.most_states)
    throw InputError("/outputs", fmt::format("{} outputs are given; expected 1 to {}", n, settings.most_states));
  if (!(settings.holdout > 0 && settings.holdout <= 0.9))
    throw InputError("/holdout",
                     fmt::format("holdout is {}; expected a share above 0 and at most 0.9", settings.holdout),
                     "(0, 0.9]");
  if (settings.max_order < 1) throw InputError("/max-order", "max-order must be at least 1", ">= 1");
}

}  // namespace

Choice choose(const Records& records, const Settings& settings) {
  check(records, settings);
  const auto rows = static_cast<double>(records.outputs.rows());
  const auto from = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::floor(rows * (1 - settings.holdout))));
  if (from >= records.outputs.rows()) throw InputError("/rows", "no row is left to hold back; expected more rows");
  Choice choice;
  choice.tried = try_all(records, from, settings);
  choice.chosen = pick(choice.tried);
  const Candidate& best = choice.tried[static_cast<std::size_t>(choice.chosen)];
  const Held held = held_back(fit(records, 0, from, best.order, best.lag), records, from);
  choice.model = fit(records, 0, records.outputs.rows(), best.order, best.lag);
  choice.residuals = residuals(choice.model, records);
  for (Eigen::Index c = 0; c < records.outputs.cols(); ++c) {
    OutputFigures figures;
    figures.r2 = 1 - held.error[c] / held.variance[c];
    figures.r2_held = 1 - held.error[c] / held.still[c];
    figures.deviation = std::sqrt(mean_square(choice.residuals.col(c)));
    figures.whiteness = ljung_box(choice.residuals.col(c), kWhitenessLags, best.order);
    choice.outputs.push_back(figures);
  }
  return choice;
}

}  // namespace vigil::identify
