#include "engine/papers/basis.hpp"

#include <algorithm>
#include <map>

#include "engine/methods/words.hpp"

namespace vigil::papers {

Json Scene::whole_patch() const {
  const Json all = Scenario::preset(preset).document();
  Json whole = Json::object();
  for (const auto& [id, lane] : all.at("lanes").items()) {
    if (std::find(lanes.begin(), lanes.end(), id) == lanes.end()) whole["lanes"][id] = nullptr;
  }
  // Members are put together here: a merge would take the lanes' nulls for something to remove.
  for (const auto& [member, value] : patch.items()) {
    if (member != "lanes") whole[member] = value;
  }
  if (patch.contains("lanes")) {
    for (const auto& [id, lane] : patch.at("lanes").items()) whole["lanes"][id] = lane;
  }
  return whole;
}

std::vector<std::string> Scene::methods() const {
  std::vector<std::string> found;
  const auto add = [&](const Json& id) {
    if (!id.is_string() || find_words(id.get<std::string>()) == nullptr) return;
    if (std::find(found.begin(), found.end(), id.get<std::string>()) == found.end()) found.push_back(id);
  };
  const Json document = scenario().document();
  for (const Json& lane : document.at("lanes")) {
    add(lane.value("method", Json()));
    for (const char* part : {"protection", "detector"}) {
      if (lane.contains(part) && lane.at(part).is_object()) add(lane.at(part).value("type", Json()));
    }
  }
  return found;
}

const Basis* basis_of(std::string_view key) {
  static const std::map<std::string, Basis, std::less<>> all = [] {
    std::map<std::string, Basis, std::less<>> map;
    for (auto& list : {consensus_basis(), sparse_basis(), observer_basis(), replay_basis(), privacy_basis()}) {
      for (const KeyedBasis& one : list) map.emplace(one.key, one.basis);
    }
    return map;
  }();
  const auto place = all.find(key);
  return place == all.end() ? nullptr : &place->second;
}

}  // namespace vigil::papers
