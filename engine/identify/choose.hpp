/// Which order, and when the inputs act: chosen on rows that were held back from the fit.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/identify/arx.hpp"
#include "engine/identify/whiteness.hpp"

namespace vigil::identify {

struct Settings {
  int max_order = 3;
  std::optional<int> lag;  ///< of the inputs; none: 0 and 1 are both tried
  double holdout = 0.25;   ///< share of the rows, the last ones, that is held back; in (0, 0.9]
  int most_states = 12;    ///< order times outputs may not be more
};

/// One pair of order and lag that was tried.
struct Candidate {
  int order = 1, lag = 0;
  double one_step = 0;  ///< geometric mean over outputs of error / standard deviation, held back
  double free_run = 0;  ///< the worst output's error / standard deviation of the model alone, held back
  double radius = 0;    ///< as least squares has it
  std::string refused;  ///< why it was not; empty: it could have been chosen
};

/// How good the chosen model is at one output. Of rows that its fit had not seen, but for whiteness (all rows).
struct OutputFigures {
  double r2 = 0;         ///< 1 - squared error of one step / variance
  double r2_held = 0;    ///< 1 - squared error of one step / that of saying "as in the row before"
  double deviation = 0;  ///< standard deviation of the residuals, all rows
  Whiteness whiteness;
};

struct Choice {
  Arx model;  ///< fitted to all rows
  std::vector<Candidate> tried;
  int chosen = 0;  ///< among tried
  std::vector<OutputFigures> outputs;
  Eigen::MatrixXd residuals;  ///< of the model, all rows
};

/// Tries every order that `most_states` allows. Of those whose free run stays within ten standard deviations the
/// smallest order is taken whose one-step error is within 1 % of the best. Throws InputError where none is left, with
/// the reason of the first.
Choice choose(const Records& records, const Settings& settings);

}  // namespace vigil::identify
