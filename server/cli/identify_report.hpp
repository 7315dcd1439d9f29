/// What `vigil identify` found, as a person reads it.
#pragma once

#include <string>

#include "engine/identify/identify.hpp"

namespace vigil {

/// What was tried, what was chosen, what was done for stability, and a row an output.
std::string identify_report(const identify::Identified& found, const identify::Task& task);

}  // namespace vigil
