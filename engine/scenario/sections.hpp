/// The sections of a scenario document, one function each: takes the whole given document, appends what is wrong,
/// returns the section complete and in canonical form. `document` is what was completed before: the sections are read
/// in its order.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/core/json.hpp"

namespace vigil::section {

constexpr std::size_t kMostNodes = 64;
constexpr std::size_t kMostLanes = 32;
constexpr std::size_t kMostAttacks = 32;

Json id(const Json& given, std::vector<Problem>& problems);
Json title(const Json& given, const Json& document, std::vector<Problem>& problems);
Json time(const Json& given, std::vector<Problem>& problems);
Json plant(const Json& given, std::vector<Problem>& problems);
Json controller(const Json& given, std::vector<Problem>& problems);
Json nodes(const Json& given, std::vector<Problem>& problems);
Json network(const Json& given, const Json& document, std::vector<Problem>& problems);
/// `states`: of the plant, 0 where it is not known (then sizes are not checked).
Json noise(const Json& given, const Json& document, int states, std::vector<Problem>& problems);
Json initial(const Json& given, const Json& document, int states, std::vector<Problem>& problems);
Json adversary(const Json& given, const Json& document, std::vector<Problem>& problems);
Json lanes(const Json& given, std::vector<Problem>& problems);
Json metrics(const Json& given, std::vector<Problem>& problems);
Json log(const Json& given, std::vector<Problem>& problems);
Json view(const Json& given, std::vector<Problem>& problems);

/// The number of the plant's states; 0, and problems, where it cannot be made.
int plant_states(const Json& document, std::vector<Problem>& problems);

}  // namespace vigil::section
