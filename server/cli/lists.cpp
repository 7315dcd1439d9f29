// `vigil scenarios` and `vigil methods`.
#include <iostream>
#include <memory>

#include "engine/scenario/scenario.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/report.hpp"

namespace vigil {
namespace {

std::string join(const Json& object) {
  std::string text;
  for (const auto& [key, value] : object.items()) text += (text.empty() ? "" : " ") + key;
  return text;
}

int scenarios(const std::string& id, bool json) {
  if (!id.empty()) {
    std::cout << Scenario::preset(id).document().dump(2) << "\n";
    return kDone;
  }
  Json list = Json::array();
  std::string text;
  for (const std::string& preset : Scenario::preset_ids()) {
    const Json document = Scenario::preset(preset).document();
    text += preset + "  (" + document.at("family").get<std::string>() + ")\n  " + document.at("title").value("en", "") +
            "\n  lanes: " + join(document.at("lanes")) + "\n";
    Json lanes = Json::array();
    for (const auto& [lane, body] : document.at("lanes").items()) lanes.push_back(lane);
    list.push_back(
        {{"id", preset}, {"family", document.at("family")}, {"title", document.at("title")}, {"lanes", lanes}});
  }
  std::cout << (json ? list.dump(2) + "\n" : text);
  return kDone;
}

std::string range(const Json& param) {
  if (param.contains("choices") && !param.at("choices").empty()) {
    std::string text;
    for (const Json& choice : param.at("choices")) text += (text.empty() ? "" : "|") + choice.get<std::string>();
    return text;
  }
  const auto bound = [&param](const char* key) {
    return param.contains(key) && param.at(key).is_number() ? param.at(key).dump() : "";
  };
  const std::string low = bound("minimum"), high = bound("maximum");
  return low.empty() && high.empty() ? "" : low + ".." + high;
}

int methods(bool json) {
  const Json registry = registry_json();
  if (json) {
    std::cout << registry.dump(2) << "\n";
    return kDone;
  }
  for (const auto& [kind, entries] : registry.items()) {
    for (const Json& entry : entries) {
      std::cout << kind << "  " << entry.value("id", "") << "  " << entry.value("title", Json::object()).value("en", "")
                << "\n";
      std::vector<std::vector<std::string>> rows;
      for (const Json& param : entry.value("parameters", Json::array())) {
        rows.push_back({"    " + param.value("name", ""), param.value("type", ""),
                        param.contains("default") ? param.at("default").dump() : "", range(param),
                        param.value("unit", ""), param.value("live", false) ? "live" : ""});
      }
      std::cout << aligned(rows);
    }
  }
  return kDone;
}

}  // namespace

void add_lists(CLI::App& app, Action& action) {
  struct Options {
    std::string id;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* list = app.add_subcommand("scenarios", "the presets; with an ID, that scenario's whole document");
  list->add_option("ID", options->id, "a preset's id");
  list->add_flag("--json", options->json, "as JSON");
  list->callback([options, &action] { action = [options] { return scenarios(options->id, options->json); }; });
  CLI::App* registry =
      app.add_subcommand("methods", "every method, attack, plant and law with its declared parameters");
  registry->add_flag("--json", options->json, "as JSON");
  registry->callback([options, &action] { action = [options] { return methods(options->json); }; });
}

}  // namespace vigil
