#include "engine/scenario/scenario.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/params.hpp"
#include "engine/scenario/fields.hpp"
#include "engine/scenario/presets/presets.hpp"
#include "engine/scenario/sections.hpp"
#include "engine/scenario/structure.hpp"

namespace vigil {
namespace {

const std::vector<std::string> kKeys{"vigil", "id",         "title", "source",       "family", "profile", "time",
                                     "plant", "controller", "nodes", "network",      "noise",  "initial", "adversary",
                                     "lanes", "metrics",    "log",   "reproducible", "view"};

void check_version(Fields& root) {
  if (!root.has("vigil")) {
    root.missing("vigil", "1, the version of the document's format");
  } else if (root.at("vigil") != 1) {
    root.wrong("vigil", "1, the version of the document's format");
  }
}

/// The order of the sections is the canonical one, and each may look at those before it.
Json complete(const Json& given, std::vector<Problem>& problems) {
  Fields root(given, "", problems);
  root.known(kKeys);
  check_version(root);
  Json result = {{"vigil", 1}, {"id", section::id(given, problems)}};
  result["title"] = section::title(given, result, problems);
  result["source"] = root.text("source", "");
  result["family"] = root.choice("family", {"consensus", "sparse", "replay", "observer", "privacy"}, "consensus");
  result["profile"] = root.text("profile", "");
  result["time"] = section::time(given, problems);
  result["plant"] = section::plant(given, problems);
  const int states = section::plant_states(result, problems);
  result["controller"] = section::controller(given, problems);
  result["nodes"] = section::nodes(given, problems);
  result["network"] = section::network(given, result, problems);
  result["noise"] = section::noise(given, result, states, problems);
  result["initial"] = section::initial(given, result, states, problems);
  result["adversary"] = section::adversary(given, result, problems);
  result["lanes"] = section::lanes(given, problems);
  result["metrics"] = section::metrics(given, problems);
  result["log"] = section::log(given, problems);
  result["reproducible"] = root.boolean("reproducible", true);
  result["view"] = section::view(given, problems);
  return result;
}

struct Preset {
  const char* id;
  Json (*make)();
};
constexpr Preset kPresets[] = {{"consensus", presets::consensus},
                               {"consensus-compass", presets::consensus_compass},
                               {"consensus-literal", presets::consensus_literal},
                               {"mrclam", presets::mrclam},
                               {"sparse", presets::sparse},
                               {"replay-nongaussian", presets::replay_nongaussian},
                               {"replay-ubb", presets::replay_ubb},
                               {"replay-mixed", presets::replay_mixed},
                               {"observer-pair", presets::observer_pair},
                               {"observer-areas", presets::observer_areas},
                               {"observer-single", presets::observer_single},
                               {"privacy-robot-linear", presets::privacy_robot_linear},
                               {"privacy-robot-nonlinear", presets::privacy_robot_nonlinear},
                               {"privacy-turn", presets::privacy_turn},
                               {"privacy-engine", presets::privacy_engine}};

}  // namespace

Scenario Scenario::from_json(const Json& document) {
  std::vector<Problem> problems;
  check_structure(document, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!document.is_object())
    throw InputError("", "the document is " + shown(document) + "; expected an object", "object");
  Scenario scenario;
  scenario.document_ = complete(document, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return scenario;
}

const std::vector<std::string>& Scenario::preset_ids() {
  static const std::vector<std::string> ids = [] {
    std::vector<std::string> found;
    for (const Preset& preset : kPresets) found.emplace_back(preset.id);
    return found;
  }();
  return ids;
}

bool Scenario::is_preset(std::string_view id) {
  return std::find(preset_ids().begin(), preset_ids().end(), id) != preset_ids().end();
}

Scenario Scenario::preset(std::string_view id) {
  for (const Preset& preset : kPresets) {
    if (id == preset.id) return from_json(preset.make());
  }
  const std::string near = nearest(id, preset_ids());
  const std::string hint = near.empty() ? "" : "; did you mean " + in_quotes(near) + "?";
  throw InputError("", in_quotes(id) + " is no preset; expected one of " + listed(preset_ids()) + hint,
                   listed(preset_ids()));
}

std::string Scenario::id() const { return document_.value("id", ""); }
std::string Scenario::family() const { return document_.value("family", ""); }

Scenario Scenario::patched(const Json& merge_patch) const {
  std::vector<Problem> problems;
  check_structure(merge_patch, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!merge_patch.is_object())
    throw InputError("", "the patch is " + shown(merge_patch) + "; expected an object", "object");
  Json changed = document_;
  changed.merge_patch(merge_patch);
  return from_json(changed);
}

std::string_view version() { return VIGIL_VERSION; }

}  // namespace vigil
