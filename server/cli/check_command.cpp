// `vigil check`: what can be said of a scenario's system before it runs, and which methods fit it.
#include <iostream>
#include <memory>

#include "engine/run/system_report.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/report.hpp"
#include "server/cli/scenario_options.hpp"

namespace vigil {
namespace {

struct CheckCommand {
  ScenarioOptions scenario;
  std::string json;  ///< file
};

using Rows = std::vector<std::vector<std::string>>;

std::string cell(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
  if (value.is_number()) return six_digits(value.get<double>());
  return value.is_string() ? value.get<std::string>() : "-";
}

std::string mode_rows(const Json& modes, const std::string& measure) {
  if (!modes.is_array()) return {};
  Rows rows{{"mode", measure, "behaviour", "count"}};
  for (const Json& mode : modes)
    rows.push_back({cell(mode.at("text")), cell(mode.at("size")), cell(mode.at("behaviour")), cell(mode.at("count"))});
  return aligned(rows) + "\n";
}

std::vector<std::string> seen_row(const std::string& who, const Json& part) {
  const Json& weakest = part.at("weakest");
  std::vector<std::string> row{who};
  for (const char* key : {"rank", "observable", "detectable"}) row.push_back(cell(part.at(key)));
  row.push_back(weakest.is_null() ? "-" : cell(weakest.at("mode")));
  row.push_back(weakest.is_null() ? "-" : cell(weakest.at("value")));
  return row;
}

std::string node_rows(const Json& report) {
  Rows rows{{"node", "rank", "observable", "detectable", "seen worst", "margin"}};
  for (const Json& node : report.at("nodes")) rows.push_back(seen_row(cell(node.at("id")), node));
  rows.push_back(seen_row("together", report.at("joint")));
  return aligned(rows) + "\n";
}

std::string noise_rows(const Json& noise) {
  Rows rows{{"covariance", "smallest", "largest", ""}};
  const auto add = [&rows](const std::string& name, const Json& one) {
    rows.push_back({name, cell(one.at("smallest")), cell(one.at("largest")), cell(one.at("kind"))});
  };
  add("Q", noise.at("Q"));
  add("P0", noise.at("P0"));
  for (const auto& [node, one] : noise.at("R").items()) add("R of " + node, one);
  return aligned(rows) + "\n";
}

std::string method_lines(const Json& methods) {
  std::string fitting, others;
  for (const Json& method : methods) {
    const std::string id = method.at("id");
    if (method.at("fits") == true)
      fitting += "  " + id + (method.at("needs_gains") == true ? " (its gains are found before a run)" : "") + "\n";
    else
      others += "  " + id + ": " + cell(method.at("reason")) + "\n";
  }
  return "methods that fit\n" + (fitting.empty() ? "  none\n" : fitting) +
         (others.empty() ? "" : "methods that do not\n" + others);
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string report_text(const Json& report) {
  const Json& plant = report.at("plant");
  std::string text = report.at("scenario").get<std::string>() + ": plant " + cell(plant.at("type")) + ", " +
                     cell(plant.at("kind")) + ", " + counted(plant.at("states").size(), "state") + ", " +
                     counted(plant.at("inputs").size(), "input") + ", a tick of " + cell(plant.at("dt")) + " s\n\n";
  text += mode_rows(plant.at("poles"), cell(plant.at("measure")));
  text += mode_rows(plant.at("continuous_poles"), "real part");
  text += node_rows(report) + noise_rows(report.at("noise"));
  for (const Json& verdict : report.at("verdicts"))
    text += cell(verdict.at("level")) + ": " + cell(verdict.at("text")) + "\n";
  return text + "\n" + method_lines(report.at("methods"));
}

int carry_out(const CheckCommand& command) {
  const Json report = system_report(command.scenario.order().scenario);
  if (!command.json.empty()) write_text(command.json, report.dump(2) + "\n");
  if (command.json != "-") std::cout << report_text(report);
  return kDone;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App* sub =
      app.add_subcommand("check", "what a scenario's system is, who sees it, and which methods fit; no run");
  command->scenario.add_document_to(*sub);
  sub->add_option("--json", command->json, "the report as JSON into this file; - for standard output, instead of text");
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
