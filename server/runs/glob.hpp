/// Patterns of signal names: '*' stands for any text (dots too), '?' for one character.
#pragma once

#include <string_view>

namespace vigil {

/// Linear memory, time at most the product of the two lengths.
bool glob_match(std::string_view pattern, std::string_view text);

}  // namespace vigil
