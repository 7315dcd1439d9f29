/// What an item stands on: the runs that its figure is of, and the equations behind it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/core/params.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil::papers {

/// A run that a figure is of: a preset with some lanes of it and a merge patch over that.
struct Scene {
  Words name;
  std::string preset;
  std::vector<std::string> lanes;
  Json patch = Json::object();

  /// The one merge patch that makes this run of the preset, its other lanes taken out.
  Json whole_patch() const;
  Scenario scenario() const { return Scenario::preset(preset).patched(whole_patch()); }
  /// Methods, protections and detectors of its lanes: whose pages of docs/methods there are.
  std::vector<std::string> methods() const;
};

struct Basis {
  std::vector<Scene> scenes;
  std::vector<std::string> equations;  ///< ids of engine/methods/equation.hpp
};

/// Null where there is no such item.
const Basis* basis_of(std::string_view key);

struct KeyedBasis {
  std::string key;
  Basis basis;
};

std::vector<KeyedBasis> consensus_basis();
std::vector<KeyedBasis> sparse_basis();
std::vector<KeyedBasis> observer_basis();
std::vector<KeyedBasis> replay_basis();
std::vector<KeyedBasis> privacy_basis();

}  // namespace vigil::papers
