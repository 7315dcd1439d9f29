// `vigil compatibility`: which lane of a scenario meets which attack, and why not where not.
#include <algorithm>
#include <iostream>
#include <memory>

#include "engine/run/compatibility.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/report.hpp"
#include "server/cli/scenario_options.hpp"

namespace vigil {
namespace {

struct CompatibilityCommand {
  ScenarioOptions scenario;
  std::string json;  ///< file
};

std::string table_text(const Json& table) {
  std::vector<std::string> reasons;
  const auto number = [&reasons](const std::string& reason) {
    const auto found = std::find(reasons.begin(), reasons.end(), reason);
    const auto place = found - reasons.begin();
    if (found == reasons.end()) reasons.push_back(reason);
    return std::to_string(place + 1);
  };
  std::vector<std::vector<std::string>> rows{{"attack", "on"}};
  for (const Json& lane : table["lanes"]) rows.front().push_back(lane["id"]);
  for (const Json& row : table["rows"]) {
    rows.push_back({row["attack"], row["channel"].get<std::string>() + "s"});
    for (const Json& lane : table["lanes"]) {
      if (!row["reason"].is_null()) {
        rows.back().push_back(number(row["reason"]));
        continue;
      }
      const Json& cell = row["cells"][lane["id"].get<std::string>()];
      rows.back().push_back(cell["meets"].is_null() ? number(cell["reason"]) : cell["meets"].get<std::string>());
    }
  }
  std::string text = aligned(rows) + "\n";
  for (std::size_t i = 0; i < reasons.size(); ++i) text += std::to_string(i + 1) + ": " + reasons[i] + "\n";
  return text;
}

int carry_out(const CompatibilityCommand& command) {
  const Json table = compatibility(command.scenario.order().scenario);
  if (!command.json.empty()) write_text(command.json, table.dump(2) + "\n");
  if (command.json != "-") std::cout << table_text(table);
  return kDone;
}

}  // namespace

void add_compatibility(CLI::App& app, Action& action) {
  auto command = std::make_shared<CompatibilityCommand>();
  CLI::App* sub =
      app.add_subcommand("compatibility", "which lane of a scenario meets which attack, and why not; no run");
  command->scenario.add_document_to(*sub);
  sub->add_option("--json", command->json, "the table as JSON into this file; - for standard output, instead of text");
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
