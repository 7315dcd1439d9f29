#include "engine/scenario/markdown.hpp"

#include "engine/adversary/attack.hpp"
#include "engine/core/expectation.hpp"
#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/world/controller.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

/// Text for a table's cell: a bar would end the cell.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string fallback(const Param& param) {
  if (param.required) return "required";
  return "`" + param.fallback.dump() + "`";
}

std::string row(const Param& param) {
  const std::string live = param.live ? "yes" : "";
  return "| `" + param.name + "` | " + cell(param.symbol) + " | " + fallback(param) + " | " + cell(param.unit) + " | " +
         cell(expectation(param)) + " | " + live + " | " + cell(param.meaning.en) + " / " + cell(param.meaning.zh) +
         " |\n";
}

template <class Make>
std::string kind(const std::string& heading, const std::string& where) {
  std::string text = "## " + heading + "\n\n" + where + "\n\n";
  for (const auto& entry : Registry<Make>::all()) {
    text +=
        "### `" + entry.id + "`\n\n" + entry.title.en + " / " + entry.title.zh + ". Source: " + entry.source + ".\n\n";
    text += parameters_table(entry.params);
  }
  return text;
}

}  // namespace

std::string parameters_table(const ParamTable& params) {
  if (params.all().empty()) return "No parameters.\n\n";
  std::string text = "| name | symbol | default | unit | accepts | live | meaning |\n|---|---|---|---|---|---|---|\n";
  for (const auto& param : params.all()) text += row(param);
  return text + "\n";
}

std::string parameters_markdown() {
  std::string text =
      "# Parameters\n\n"
      "Made from the code by `parameters_markdown()`; a test keeps this page equal to it. `null` stands for "
      "\"automatic\" or \"follows\", as\n"
      "the meaning says. *Live* parameters may be changed while a run goes on.\n\n";
  text += kind<PlantMake>("Plants", "`plant.type` and `plant.params` of a scenario.");
  text += kind<SensorMake>("Sensors", "`nodes.<id>.sensor.type` and `.params`.");
  text += kind<AttackMake>("Attacks", "`adversary.<id>.type` and `.params`; the same in an attack started by hand.");
  text += kind<ControllerMake>("Controllers", "`controller.type` and `.params`; `none` has none.");
  text += kind<MethodMake>("Methods", "`lanes.<id>.method` and `.params`.");
  text += kind<ProtectionMake>("Protections", "`lanes.<id>.protection.type` and `.params`; `none` has none.");
  text += kind<DetectorMake>("Detectors", "`lanes.<id>.detector.type` and `.params`; `none` has none.");
  text.pop_back();
  return text;
}

}  // namespace vigil
