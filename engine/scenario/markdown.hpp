/// The documentation's tables, made from what the code declares.
#pragma once

#include <string>

namespace vigil {

/// docs/parameters.md: every plant, sensor, attack and method with its parameters.
std::string parameters_markdown();

}  // namespace vigil
