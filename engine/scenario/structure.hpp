/// What holds for any value of any document, before its meaning is looked at.
#pragma once

#include <string>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/core/json.hpp"

namespace vigil {

constexpr std::size_t kDeepest = 32;
constexpr std::size_t kLongestText = 4096;
constexpr std::size_t kMostValues = 200'000;

/// Appends a problem for each value that is nested more than 32 deep, each text or key of more than 4096 bytes or not
/// UTF-8, each number that is not finite, and for more than 200 000 values. Looks no further than that.
void check_structure(const Json& value, const std::string& pointer, std::vector<Problem>& problems);

}  // namespace vigil
