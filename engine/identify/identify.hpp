/// From a recorded table to a scenario that runs: the model, what is known of it, and the document.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/identify/choose.hpp"
#include "engine/identify/mapping.hpp"
#include "engine/identify/state_space.hpp"

namespace vigil::identify {

/// What the user asks for. Columns may be patterns, in which `*` stands for any text.
struct Task {
  std::vector<std::string> outputs, inputs;
  std::string label;  ///< column, or empty
  std::string id = "identified", source;
  double dt = 1;                 ///< s between rows
  double reading_share = 0.001;  ///< see state_space()
  int window = 24;               ///< innovations in the statistics of the detectors `fixed` and `dynamic`
  Settings settings;
};

struct Identified {
  std::vector<std::string> outputs, inputs;  ///< columns; inputs that move
  std::vector<std::string> flat;             ///< inputs that never change and were left out
  std::vector<std::string> nodes;            ///< ids, one an output
  Eigen::Index rows = 0;
  Choice choice;
  StateSpace space;
  Mapping mapping;
};

/// Fits the table. Throws InputError: see read_table, choose; more inputs than a run may have (11 and the constant); an
/// output that is an input as well.
Identified identify(std::string_view text, const Task& task);

/// The scenario document: plant `linear` whose last input is the constant one, a sensor a tank of the same type, noise,
/// initial estimates at the recorded mean, one filter over all outputs and one at each under every detector, the
/// mapping in `view`. `vigil run` takes it with a trace of the same mapping.
Json scenario_of(const Identified& identified, const Task& task);

}  // namespace vigil::identify
