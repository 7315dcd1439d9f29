/// Live commands: what may be changed while a run goes on.
#include <fmt/format.h>

#include <algorithm>

#include "engine/core/describe.hpp"
#include "engine/methods/detectors/detector.hpp"
#include "engine/run/state.hpp"
#include "engine/scenario/document.hpp"
#include "engine/scenario/fields.hpp"
#include "engine/scenario/structure.hpp"

namespace vigil {
namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    parts.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  parts.push_back(path.substr(begin));
  return parts;
}

[[noreturn]] void not_live(const std::string& path, const std::string& pointer) {
  throw InputError(pointer, fmt::format("\"{}\" cannot be changed while the run goes on", path),
                   "lanes.<lane>.params.<live parameter>, lanes.<lane>.detector.params.<live parameter>, "
                   "adversary.<attack>.params.<live parameter>, "
                   "adversary.<attack>.enabled, network.graph");
}

/// Runs `change` and gives the problems it throws the path of the value they speak of, else that of the group's first.
template <class Change>
void at_paths(const ParamGroup& group, Change&& change) {
  try {
    change();
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      const std::string name = problem.pointer.substr(problem.pointer.rfind('/') + 1);
      problem.pointer =
          group.paths.contains(name) ? group.paths[name].get<std::string>() : group.paths.front().get<std::string>();
    }
    throw InputError(std::move(problems));
  }
}

/// Whose value a path names; none: no live one.
std::optional<ParamGroup::Of> owner(const std::vector<std::string>& parts) {
  const bool params = parts.size() == 4 && parts[2] == "params";
  if (parts[0] == "adversary" && (params || (parts.size() == 3 && parts[2] == "enabled")))
    return ParamGroup::Of::attack;
  if (parts[0] != "lanes") return std::nullopt;
  if (params) return ParamGroup::Of::lane;
  if (parts.size() == 5 && parts[2] == "detector" && parts[3] == "params") return ParamGroup::Of::detector;
  return std::nullopt;
}

/// `params` with live values in place of its own. Throws with pointers that end in a parameter's name. `path`: of the
/// params, for the sentence.
Json with_live(Json params, const Json& values, const ParamTable* table, const std::string& path) {
  for (const auto& [name, value] : values.items()) {
    const Param* declared = table == nullptr ? nullptr : table->find(name);
    if (declared == nullptr || !declared->live) not_live(path + "." + name, "/" + name);
    if (const auto problem = table->check(*declared, value, "/" + name)) throw InputError({*problem});
    params[name] = value;
  }
  return params;
}

/// A hand's attack, checked like one of the document; without "from" it begins at once.
Json hand_attack(const Json& given, const Json& document) {
  if (!given.is_object())
    throw InputError("/attack", "attack is " + shown(given) + "; expected {\"type\",\"on\",…}", "object");
  std::vector<Problem> problems;
  Json rest = given;
  rest.erase("id");
  if (rest.contains("from") && rest["from"].is_null()) rest.erase("from");
  Json attack = complete_attack(rest, document, "/attack", problems);
  const Json id = given.value("id", Json(nullptr));
  if (!id.is_string() || !is_member_id(id.get_ref<const std::string&>())) {
    problems.push_back(
        {"/attack/id", "id is " + shown(id) + "; expected 1 to 32 small letters, digits and '_'", "[a-z0-9_]{1,32}"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  attack["id"] = id;
  if (!rest.contains("from")) attack.erase("from");
  return attack;
}

Lane& find_lane(std::vector<Lane>& lanes, const std::string& id) {
  const auto lane = std::find_if(lanes.begin(), lanes.end(), [&](const Lane& other) { return other.id() == id; });
  if (lane == lanes.end()) throw InputError("", fmt::format("this run has no lane \"{}\"", id));
  return *lane;
}

}  // namespace

void Run::State::change(const Command& command, Sink* sink) {
  const Json& body = command.body;
  std::vector<Problem> problems;
  check_structure(body, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!body.is_object() || body.size() != 1)
    throw InputError("", "a command has exactly one of params, attack, end_attack");
  Mark mark;
  mark.k = command.k;
  mark.type = MarkType::command;
  if (body.contains("params")) {
    set_params(body["params"]);
    mark.code = "params";
    for (const auto& [path, value] : body["params"].items())
      mark.detail += (mark.detail.empty() ? "" : ", ") + path + " = " + value.dump();
  } else if (body.contains("attack")) {
    const Json attack = hand_attack(body["attack"], scenario.document());
    adversary.start(attack, command.k);
    mark.code = "attack";
    mark.id = attack["id"].get<std::string>();
    mark.detail = attack["type"].get<std::string>() + " on " + attack["on"].dump();
  } else if (body.contains("end_attack") && body["end_attack"].is_string()) {
    mark.id = body["end_attack"].get<std::string>();
    adversary.end(mark.id, command.k);
    rewire_lanes();
    mark.code = "end_attack";
  } else {
    throw InputError("", "a command has exactly one of params, attack, end_attack");
  }
  if (sink != nullptr) sink->mark(mark);
}

/// Values for one lane or one attack are judged together, so that their order in the command does not matter.
void Run::State::set_params(const Json& params) {
  if (!params.is_object() || params.empty())
    throw InputError("/params",
                     "expected an object of paths and values, such as {\"lanes.consensus.params.tau\":0.02}");
  std::vector<ParamGroup> groups;
  for (const auto& [path, value] : params.items()) {
    if (path == "network.graph") {
      set_graph(value);
      continue;
    }
    const std::vector<std::string> parts = split(path);
    const auto of = owner(parts);
    if (!of) not_live(path, "/params/" + path);
    const auto same = [&](const ParamGroup& group) { return group.of == *of && group.id == parts[1]; };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(groups.end(), {*of, parts[1], Json::object(), Json::object()});
    group->values[parts.back()] = value;
    group->paths[parts.back()] = "/params/" + path;
  }
  for (const ParamGroup& group : groups) {
    at_paths(group, [&] {
      if (group.of == ParamGroup::Of::attack) adversary.retune(group.id, group.values);
      if (group.of == ParamGroup::Of::lane) retune_lane(group);
      if (group.of == ParamGroup::Of::detector) retune_detector(group);
    });
  }
  rewire_lanes();
}

/// Throws with pointers that end in a parameter's name.
void Run::State::retune_lane(const ParamGroup& group) {
  Lane& lane = find_lane(lanes, group.id);
  const auto* entry = Registry<MethodMake>::find(lane.method_id());
  Json changed =
      with_live(lane.params(), group.values, entry ? &entry->params : nullptr, "lanes." + group.id + ".params");
  lane.retune(Params(changed));
  lane.params() = std::move(changed);
}

/// Throws with pointers that end in a parameter's name.
void Run::State::retune_detector(const ParamGroup& group) {
  Lane& lane = find_lane(lanes, group.id);
  if (lane.detector().is_null())
    throw InputError("", fmt::format("no detector is attached to the lane \"{}\"", group.id));
  const auto* entry = Registry<DetectorMake>::find(lane.detector()["type"].get<std::string>());
  Json changed = with_live(lane.detector()["params"], group.values, entry ? &entry->params : nullptr,
                           "lanes." + group.id + ".detector.params");
  lane.retune_detector(Params(changed));
  lane.detector()["params"] = std::move(changed);
}

void Run::State::set_graph(const Json& value) {
  if (!value.is_string()) throw InputError("/params/network.graph", "expected the name of a graph");
  const Graph wanted = under("/params/network.graph", [&] { return make_graph(value.get<std::string>(), positions); });
  std::vector<int> places;
  for (const Link& link : wanted.links()) {
    places.push_back(base.find(link.from, link.to));
    if (places.back() < 0) {
      throw InputError("/params/network.graph",
                       fmt::format("\"{}\" needs the channel {}, which this run was not started with; a live change "
                                   "may only use channels of the run's first graph",
                                   value.get<std::string>(), link_name(link, nodes)));
    }
  }
  graph = wanted;
  base_of = std::move(places);
  rewire_lanes();
}

void Run::State::rewire_lanes() {
  const std::vector<LinkRates> rates = adversary.rates(graph);
  for (Lane& lane : lanes) under("/params/lanes." + lane.id(), [&] { lane.rewire(graph, rates); });
}

}  // namespace vigil
