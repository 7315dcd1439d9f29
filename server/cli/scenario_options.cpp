#include "server/cli/scenario_options.hpp"

#include <algorithm>
#include <filesystem>

#include "engine/core/describe.hpp"
#include "engine/run/trace.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/runs/bundle.hpp"

namespace vigil {
namespace {

bool is_word(const std::string& text) {
  const auto fits = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == ':' || c == '*';
  };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         std::all_of(text.begin(), text.end(), fits);
}

Json parse_value(const std::string& text, const std::string& whole) {
  try {
    return Json::parse(text);
  } catch (const Json::exception&) {
    if (is_word(text) && text != "NaN" && text != "Infinity") return text;
  }
  throw UserError(in_quotes(whole) + " does not hold a JSON value after '='; expected PATH=JSON");
}

std::pair<std::string, std::string> split(const std::string& text, const char* expected) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UserError(in_quotes(text) + " is no assignment; expected " + expected);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

RunOrder load(const std::string& name) {
  RunOrder order;
  if (Scenario::is_preset(name)) {
    order.scenario = Scenario::preset(name);
    return order;
  }
  std::error_code error;
  if (!std::filesystem::exists(name, error)) {
    throw UserError("SCENARIO is " + in_quotes(name) + "; expected a preset (" + listed(Scenario::preset_ids()) +
                    "), a JSON file or a bundle");
  }
  const Json json = read_json(name);
  if (is_bundle(json)) return read_bundle(json).order;
  order.scenario = Scenario::from_json(json);
  return order;
}

}  // namespace

std::pair<std::string, Json> parse_set(const std::string& text) {
  const auto [path, value] = split(text, "PATH=JSON");
  return {path, parse_value(value, text)};
}

std::pair<std::string, std::vector<Json>> parse_sweep(const std::string& text) {
  const auto [path, values] = split(text, "PATH=V1,V2,…");
  std::vector<Json> result;
  std::string part;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i <= values.size(); ++i) {
    const char c = i < values.size() ? values[i] : ',';
    if (c == '"' && (i == 0 || values[i - 1] != '\\')) quoted = !quoted;
    if (!quoted && (c == '[' || c == '{')) ++depth;
    if (!quoted && (c == ']' || c == '}')) --depth;
    if (c == ',' && ((depth == 0 && !quoted) || i == values.size())) {
      result.push_back(parse_value(part, text));
      part.clear();
    } else {
      part += c;
    }
  }
  return {path, result};
}

Scenario with_all(Scenario scenario, std::vector<std::pair<std::string, Json>> sets) {
  while (!sets.empty()) {
    std::vector<std::pair<std::string, Json>> later;
    std::optional<InputError> first;
    for (auto& [path, value] : sets) {
      try {
        scenario = scenario.with(path, value);
      } catch (const InputError& error) {
        // Two values may only be valid together: the other one may still come.
        if (!first) first = error;
        later.emplace_back(path, value);
      }
    }
    if (later.size() == sets.size()) throw *first;
    sets = std::move(later);
  }
  return scenario;
}

void ScenarioOptions::add_document_to(CLI::App& command) {
  command.add_option("SCENARIO", scenario, "a preset's id, a JSON file or a bundle")->required();
  command.add_option("--set", sets, "PATH=JSON, e.g. lanes.consensus.params.tau=0.02")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--patch", patch, "a JSON Merge Patch of the document");
}

void ScenarioOptions::add_to(CLI::App& command) {
  add_document_to(command);
  command.add_option("--trace", trace, "a frame file that takes the place of the world");
  command.add_option("--steps", steps, "last tick")->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}));
}

RunOrder ScenarioOptions::order() const {
  RunOrder order = load(scenario);
  if (!patch.empty()) order.scenario = order.scenario.patched(read_json(patch));
  std::vector<std::pair<std::string, Json>> all;
  for (const std::string& text : sets) all.push_back(parse_set(text));
  if (steps) {
    all.emplace_back("time.steps", *steps);
    order.last.reset();
  }
  order.scenario = with_all(std::move(order.scenario), std::move(all));
  if (!trace.empty()) order.trace = std::make_shared<const Trace>(Trace::from_csv(read_text(trace)));
  return order;
}

void require_end(const RunOrder& order) {
  if (order.last || order.trace || order.scenario.document().at("time").at("steps").is_number()) return;
  throw UserError("time.steps is null, so the run would never end; expected --steps N");
}

}  // namespace vigil
