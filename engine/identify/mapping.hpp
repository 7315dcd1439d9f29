/// Which column of somebody's table is which signal of a scenario. Kept in the scenario's view, or in a file beside it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil::identify {

struct Mapping {
  double dt = 1;                                             ///< s between rows
  std::vector<std::pair<std::string, std::string>> columns;  ///< signal, column
  std::vector<std::pair<std::string, double>> constants;     ///< signal, its value in every row
  int input_lag = 0;  ///< 1: the inputs of a row act from that row on, so they stand one row later in the trace
  std::string label;  ///< column that says whether a row is attacked (above zero: yes); empty: there is none
  std::vector<std::string> labelled;  ///< nodes whose `sensor.<node>.state` the label gives
};

/// {"dt","columns":{"<signal>":"<column>"},"constants":{"<signal>":number},"input_lag","label":{"column","nodes"}}; all
/// but `columns` may be left out. Throws InputError under `pointer`.
Mapping read_mapping(const Json& value, const std::string& pointer);
Json to_json(const Mapping& mapping);

/// The table as a trace: k and t from the row's number, an empty cell where the table has one. A label above zero is
/// the sensor state FDI (what was done is not known, only that something was), any other or none is clean. Throws
/// InputError as read_table does.
std::string table_to_trace(std::string_view text, const Mapping& mapping);

}  // namespace vigil::identify
