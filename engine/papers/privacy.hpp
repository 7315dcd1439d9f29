/// Parts of seed 004's items.
#pragma once

#include <string>
#include <vector>

#include "engine/papers/curves.hpp"
#include "engine/papers/item.hpp"

namespace vigil::papers {

std::vector<Item> linear_robot_items();     ///< figures 2-2 to 2-4
std::vector<Item> nonlinear_robot_items();  ///< figures 2-5 to 2-7
std::vector<Item> turning_target_items();   ///< figures 3-3 to 3-7
std::vector<Item> engine_error_items();     ///< figures 4-2 and 4-3
std::vector<Item> engine_design_items();    ///< figure 4-4, (4-33) and the confidentiality index

/// Mean squared errors over runs on a logarithmic axis: one curve a signal, from tick 1 on.
Panel errors_panel(const Records& records, const std::vector<std::pair<std::string, std::string>>& named_signals,
                   const std::string& title);
/// A patch of a lane's protection.
Json protection(const std::string& lane, const Json& params);

}  // namespace vigil::papers
