#include "server/cli/identify_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/describe.hpp"
#include "server/cli/report.hpp"

namespace vigil {
namespace {

std::string tried_table(const identify::Choice& choice) {
  std::vector<std::vector<std::string>> rows{{"order", "input lag", "one step", "free run", "radius", "chosen"}};
  std::string refusals;
  for (std::size_t i = 0; i < choice.tried.size(); ++i) {
    const identify::Candidate& candidate = choice.tried[i];
    const bool chosen = static_cast<int>(i) == choice.chosen;
    const bool tried = candidate.one_step > 0;
    rows.push_back({std::to_string(candidate.order), std::to_string(candidate.lag),
                    tried ? six_digits(candidate.one_step) : "-", tried ? six_digits(candidate.free_run) : "-",
                    tried ? six_digits(candidate.radius) : "-",
                    chosen ? "yes" : (candidate.refused.empty() ? "" : "refused")});
    if (!candidate.refused.empty())
      refusals += fmt::format("Order {}, input lag {}: {}.\n", candidate.order, candidate.lag, candidate.refused);
  }
  return aligned(rows) + refusals;
}

std::string output_table(const identify::Identified& found) {
  std::vector<std::vector<std::string>> rows{{"output", "R2", "R2 over holding", "residual", "Ljung-Box", "p"}};
  for (std::size_t i = 0; i < found.outputs.size(); ++i) {
    const identify::OutputFigures& figures = found.choice.outputs[i];
    rows.push_back({found.outputs[i], six_digits(figures.r2), six_digits(figures.r2_held),
                    six_digits(figures.deviation), six_digits(figures.whiteness.statistic),
                    six_digits(figures.whiteness.p)});
  }
  return aligned(rows);
}

std::string stability(const identify::Arx& model) {
  if (model.radius == model.fitted_radius) return fmt::format("Spectral radius {:.6g}.\n", model.radius);
  return fmt::format(
      "Spectral radius {:.6g}: least squares had {:.6g}, its poles were multiplied by {:.6g}, and the "
      "rest fitted anew; squared error times {:.6g}.\n",
      model.radius, model.fitted_radius, identify::kLargestRadius / model.fitted_radius, model.loss);
}

}  // namespace

std::string identify_report(const identify::Identified& found, const identify::Task& task) {
  const identify::Choice& choice = found.choice;
  std::string text =
      fmt::format("{} rows, the last {:.3g} % held back from the choice.\n\n", found.rows, 100 * task.settings.holdout);
  text += tried_table(choice);
  text += "One step, free run: error / standard deviation on rows held back (mean over outputs; the worst output).\n";
  const int allowed = task.settings.most_states / static_cast<int>(found.outputs.size());
  if (allowed < task.settings.max_order)
    text += fmt::format("Orders above {} were not tried: {} outputs times {} lags are more than {} states.\n", allowed,
                        found.outputs.size(), allowed + 1, task.settings.most_states);
  text += "\n" + stability(choice.model);
  if (choice.model.ridge > 0)
    text += fmt::format("Inputs that say nearly the same: a ridge of {:.3g} was added to their correlations.\n",
                        choice.model.ridge);
  if (!found.flat.empty()) text += fmt::format("Left out, since they never change: {}.\n", listed(found.flat));
  text += "\n" + output_table(found);
  text +=
      "R2: of one step, on rows held back; over holding: beside saying \"as in the row before\". Ljung-Box: of the "
      "residuals of all rows, 24 lags; p below 0.01: they are not white.\n";
  const auto coloured = std::count_if(choice.outputs.begin(), choice.outputs.end(),
                                      [](const auto& figures) { return figures.whiteness.p < 0.01; });
  if (coloured > 0)
    text += fmt::format(
        "{} of {} outputs have residuals that are not white: thresholds from a law of white noise will be "
        "crossed more often than they say.\n",
        coloured, choice.outputs.size());
  return text;
}

}  // namespace vigil
