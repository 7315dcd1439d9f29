/// Parts of seed 003's items.
#pragma once

#include <string>
#include <vector>

#include "engine/papers/item.hpp"

namespace vigil::papers {

/// Figures 1, 3 and 6: estimation errors without an attack.
std::vector<Item> replay_error_items();
/// Figures 2, 4, 5 and 7: detection.
std::vector<Item> replay_detection_items();

/// A patch that selects the attack's case, 1 (ticks 101 to 180) or 2 (250 to 300).
Json replay_case(int number);
/// "lane.<lane>.1.<what>"
std::string replay_signal(const std::string& lane, const std::string& what);

}  // namespace vigil::papers
