/// Live commands: what may be changed while a run goes on.
#include <fmt/format.h>

#include "engine/core/describe.hpp"
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

[[noreturn]] void not_live(const std::string& path) {
  throw InputError("/params/" + path, fmt::format("\"{}\" cannot be changed while the run goes on", path),
                   "lanes.<lane>.params.<live parameter>, adversary.<attack>.params.<live parameter>, adversary.<attack>.enabled, network.graph");
}

/// A hand's attack, checked like one of the document; without "from" it begins at once.
Json hand_attack(const Json& given, const Json& document) {
  if (!given.is_object()) throw InputError("/attack", "attack is " + shown(given) + "; expected {\"type\",\"on\",…}", "object");
  std::vector<Problem> problems;
  Json rest = given;
  rest.erase("id");
  if (rest.contains("from") && rest["from"].is_null()) rest.erase("from");
  Json attack = complete_attack(rest, document, "/attack", problems);
  const Json id = given.value("id", Json(nullptr));
  if (!id.is_string() || !is_member_id(id.get_ref<const std::string&>())) {
    problems.push_back({"/attack/id", "id is " + shown(id) + "; expected 1 to 32 small letters, digits and '_'", "[a-z0-9_]{1,32}"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  attack["id"] = id;
  if (!rest.contains("from")) attack.erase("from");
  return attack;
}

}  // namespace

void Run::State::change(const Command& command, Sink* sink) {
  const Json& body = command.body;
  std::vector<Problem> problems;
  check_structure(body, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!body.is_object() || body.size() != 1) throw InputError("", "a command has exactly one of params, attack, end_attack");
  Mark mark;
  mark.k = command.k;
  mark.type = MarkType::command;
  if (body.contains("params")) {
    set_params(body["params"]);
    mark.code = "params";
    for (const auto& [path, value] : body["params"].items()) mark.detail += (mark.detail.empty() ? "" : ", ") + path + " = " + value.dump();
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

void Run::State::set_params(const Json& params) {
  if (!params.is_object() || params.empty()) throw InputError("/params", "expected an object of paths and values, such as {\"lanes.consensus.params.tau\":0.02}");
  for (const auto& [path, value] : params.items()) set_param(path, value);
}

void Run::State::set_param(const std::string& path, const Json& value) {
  const std::vector<std::string> parts = split(path);
  if (path == "network.graph") return set_graph(value);
  if (parts.size() == 4 && parts[0] == "lanes" && parts[2] == "params") {
    for (Lane& lane : lanes) {
      if (lane.id() != parts[1]) continue;
      const auto* entry = Registry<MethodMake>::find(lane.method_id());
      const Param* declared = entry == nullptr ? nullptr : entry->params.find(parts[3]);
      if (declared == nullptr || !declared->live) not_live(path);
      if (const auto problem = entry->params.check(*declared, value, "/params/" + path)) throw InputError({*problem});
      Json changed = lane.params();
      changed[parts[3]] = value;
      at_path("/params/" + path, [&] { lane.method().retune(Params(changed)); });
      lane.params() = std::move(changed);
      return;
    }
    throw InputError("/params/" + path, fmt::format("this run has no lane \"{}\"", parts[1]));
  }
  const bool attack = parts.size() == 4 && parts[0] == "adversary" && parts[2] == "params";
  const bool enabled = parts.size() == 3 && parts[0] == "adversary" && parts[2] == "enabled";
  if (!attack && !enabled) not_live(path);
  at_path("/params/" + path, [&] { adversary.retune(parts[1], parts.back(), value); });
  rewire_lanes();
}

void Run::State::set_graph(const Json& value) {
  if (!value.is_string()) throw InputError("/params/network.graph", "expected the name of a graph");
  const Graph wanted = under("/params/network.graph", [&] { return make_graph(value.get<std::string>(), positions); });
  std::vector<int> places;
  for (const Link& link : wanted.links()) {
    places.push_back(base.find(link.from, link.to));
    if (places.back() < 0) {
      throw InputError("/params/network.graph",
                       fmt::format("\"{}\" needs the channel {}-{}, which this run was not started with; a live change may only use channels of "
                                   "the run's first graph",
                                   value.get<std::string>(), nodes[static_cast<std::size_t>(link.from)], nodes[static_cast<std::size_t>(link.to)]));
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
