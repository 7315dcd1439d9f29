/// `signals=`: names, patterns and ids, comma-separated.
#pragma once

#include <string_view>
#include <vector>

#include "engine/run/frame.hpp"

namespace vigil {

/// The ids asked for, in the order asked, none twice; all of them for "". Throws HttpError 400 for a name, pattern or
/// id that fits none.
std::vector<int> pick_signals(std::string_view wanted, const std::vector<Signal>& signals);

}  // namespace vigil
