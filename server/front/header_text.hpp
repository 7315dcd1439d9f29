/// What the head of a request and its fields are compared and cut by.
#pragma once

#include <string_view>

namespace vigil {

/// Whether two names of a header are the same: case does not count.
bool same_name(std::string_view a, std::string_view b);
/// Without the spaces and tabs at both ends.
std::string_view trim(std::string_view text);

}  // namespace vigil
