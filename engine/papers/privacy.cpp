/// Seed 004: all of its items, in order.
#include "engine/papers/privacy.hpp"

namespace vigil::papers {

Panel errors_panel(const Records& records, const std::vector<std::pair<std::string, std::string>>& named_signals,
                   const std::string& title) {
  Panel panel{title, {"t"}, {"MSE", true}, {}};
  for (const auto& [name, signal] : named_signals) {
    const auto curve = mean_curve(records, signal);
    panel.series.push_back(series(name, ticks(curve.size()), curve, "line", 1));
  }
  return panel;
}

Json protection(const std::string& lane, const Json& params) {
  return {{"lanes", {{lane, {{"protection", {{"params", params}}}}}}}};
}

std::vector<Item> privacy_items() {
  std::vector<Item> list;
  for (const auto& part : {linear_robot_items(), nonlinear_robot_items(), turning_target_items(), engine_error_items(),
                           engine_design_items()})
    list.insert(list.end(), part.begin(), part.end());
  return list;
}

}  // namespace vigil::papers
