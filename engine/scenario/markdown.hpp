/// The documentation's tables, made from what the code declares.
#pragma once

#include <string>

#include "engine/core/params.hpp"

namespace vigil {

/// docs/parameters.md: every plant, sensor, attack and method with its parameters.
std::string parameters_markdown();
/// The table of one entry, or a line where it has no parameters; a blank line ends it.
std::string parameters_table(const ParamTable& params);

}  // namespace vigil
