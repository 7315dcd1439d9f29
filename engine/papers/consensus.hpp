/// Parts of seed 000's items.
#pragma once

#include <vector>

#include "engine/papers/item.hpp"

namespace vigil::papers {

/// Figures 4 and 5.
std::vector<Item> consensus_tracking_items();

}  // namespace vigil::papers
