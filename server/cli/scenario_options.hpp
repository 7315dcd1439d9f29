/// SCENARIO, --set, --patch, --steps, --seed: what `run` and `campaign` share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/runs/order.hpp"

namespace vigil {

struct ScenarioOptions {
  std::string scenario;
  std::vector<std::string> sets;  ///< PATH=JSON
  std::string patch;              ///< file
  std::string trace;              ///< file
  std::optional<std::int64_t> steps;

  void add_to(CLI::App& command);
  /// SCENARIO, --set and --patch alone.
  void add_document_to(CLI::App& command);
  /// The scenario with everything applied; of a bundle also its seed, commands, trace and last tick. Throws UserError,
  /// InputError.
  RunOrder order() const;
};

/// Throws UserError where a run of that order would never end.
void require_end(const RunOrder& order);

/// "path=value": the path and the value as JSON; a bare word is a text. Throws UserError.
std::pair<std::string, Json> parse_set(const std::string& text);
/// "path=v1,v2": splits at commas outside brackets and quotes. Throws UserError.
std::pair<std::string, std::vector<Json>> parse_sweep(const std::string& text);
/// Sets every path; the order does not matter as long as some order passes. Throws InputError.
Scenario with_all(Scenario scenario, std::vector<std::pair<std::string, Json>> sets);

}  // namespace vigil
