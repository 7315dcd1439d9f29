/// The columns of a trace whose rows are pushed into a run while it goes on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/frame.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil {

struct PushedColumns {
  std::vector<std::string> nodes;  ///< of the scenario, in its order
  std::vector<std::string> names;  ///< sensor.<node>.<channel>, input.<c>, truth.<c>, then the further ones
  std::vector<int> reporter;       ///< by column: the node that reports it, -1: nobody in particular
  bool inputs = false;             ///< the plant is driven by known inputs, which every tick needs
};

/// Every reading, known input and state component of the scenario, and `further` ones that a trace may have
/// (sensor.1.range.injected, link.1-2.state, lane.mine.1.estimate.x …). Throws InputError below /input/ingest/columns,
/// or where the scenario's plant or sensors cannot be made.
PushedColumns pushed_columns(const Scenario& scenario, const std::vector<std::string>& further = {});

/// A further column that the run has no signal for would be pushed in vain. Throws InputError below
/// /input/ingest/columns.
void check_pushed(const PushedColumns& columns, const Catalogue& catalogue);

/// The largest state in a column link.<link>.state or sensor.<node>.state, whose cells are whole numbers from 0; empty
/// for every other.
std::optional<int> largest_state(std::string_view column);

}  // namespace vigil
