/// What a sample, a reading or a metric holds where there is nothing: it is told as null, never as a number.
#pragma once

#include <limits>

#include "engine/core/missing.hpp"

namespace vigil {

inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace vigil
