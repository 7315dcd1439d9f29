/// The plant, the nodes that see it and the network between them.
#include "engine/core/describe.hpp"
#include "engine/scenario/document.hpp"
#include "engine/scenario/fields.hpp"
#include "engine/scenario/sections.hpp"
#include "engine/scenario/typed.hpp"
#include "engine/world/controller.hpp"
#include "engine/world/interconnected/waveform.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil::section {
namespace {

const std::vector<std::string> kGraphs{"none",   "ring", "ladder", "path",    "complete",
                                       "centre", "knn2", "knn3",   "radius1", "edges"};
/// Words that stand in a node's place in signal names.
const std::vector<std::string> kReserved{kCentre, "optimal", "sent", "eve", "truth", "input", "sensor"};

Json member(const Json& given, const char* key, const Json& fallback) {
  const auto place = given.find(key);
  return place == given.end() ? fallback : *place;
}

/// Given signals of a plant in continuous time, by channel. Whether the plant has the channel is the run's to say.
Json signals(Fields& fields, std::vector<Problem>& problems) {
  Json result = Json::object();
  const Json& given = fields.at("signals");
  if (!given.is_object()) {
    fields.wrong("signals", "an object of signals keyed by their channels, such as f1");
    return result;
  }
  for (const auto& [channel, value] : given.items()) {
    const std::string pointer = child(fields.pointer("signals"), channel);
    if (!is_node_id(channel)) {
      problems.push_back(
          {pointer, in_quotes(channel) + " is no channel; expected a name such as u1, d1 or f1", "u1, d1, f1"});
      continue;
    }
    Fields signal(value, pointer, problems);
    signal.known({"type", "params"});
    Json complete = Json::object();
    if (value.is_object()) complete_typed<observer::SignalMake>(signal, "type", "signal", complete, problems);
    result[channel] = std::move(complete);
  }
  return result;
}

Json node(const Json& given, const std::string& pointer, std::vector<Problem>& problems) {
  Json result = {{"sensor", Json::object()}};
  Fields fields(given, pointer, problems);
  fields.known({"sensor", "signals"});
  if (fields.has("signals")) result["signals"] = signals(fields, problems);
  if (!fields.has("sensor")) {
    if (given.is_object()) fields.missing("sensor", "{\"type\",\"params\"}");
    return result;
  }
  Fields sensor(fields.at("sensor"), fields.pointer("sensor"), problems);
  sensor.known({"type", "params"});
  if (fields.at("sensor").is_object()) complete_typed<SensorMake>(sensor, "type", "sensor", result["sensor"], problems);
  return result;
}

bool is_reserved(const std::string& id) {
  for (const auto& word : kReserved) {
    if (id == word) return true;
  }
  return false;
}

/// A node id written as text or number; "" where it is neither.
std::string node_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return value.dump();
  return {};
}

Json edge(const Json& given, const Json& nodes, const std::string& pointer, std::vector<Problem>& problems) {
  if (!given.is_array() || given.size() != 2) {
    problems.push_back({pointer, "an edge is " + shown(given) + "; expected two node ids", "two node ids"});
    return nullptr;
  }
  Json result = Json::array();
  for (std::size_t end = 0; end < 2; ++end) {
    const std::string id = node_text(given[end]);
    if (nodes.contains(id)) {
      result.push_back(id);
      continue;
    }
    std::vector<std::string> ids;
    for (const auto& [key, value] : nodes.items()) ids.push_back(key);
    problems.push_back({child(pointer, end),
                        "node " + shown(given[end]) + " is not there; expected one of " + listed(ids), listed(ids)});
  }
  if (result.size() != 2) return nullptr;
  if (result[0] == result[1]) {
    problems.push_back({pointer, "an edge joins node " + shown(given[0]) + " to itself; expected two distinct nodes",
                        "two distinct nodes"});
    return nullptr;
  }
  return result;
}

Json edges(Fields& fields, const Json& nodes, std::vector<Problem>& problems) {
  constexpr std::size_t kMostEdges = 4096;
  Json result = Json::array();
  const Json& given = fields.at("edges");
  if (!given.is_array() || given.size() > kMostEdges) {
    fields.wrong("edges", "an array of up to 4096 pairs of node ids");
    return result;
  }
  for (std::size_t n = 0; n < given.size(); ++n) {
    Json pair = edge(given[n], nodes, child("/network/edges", n), problems);
    if (!pair.is_null()) result.push_back(std::move(pair));
  }
  return result;
}

/// What make_graph says of the name and these nodes; without positions the distances do not matter, only the number of
/// nodes.
void check_graph(const std::string& name, const Json& nodes, std::vector<Problem>& problems) {
  try {
    make_graph(name, Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(nodes.size())));
  } catch (const InputError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
}

/// The sparse family's game needs everybody to be reached: specification of seed 001, section 15.
void check_connected(const Json& nodes, const Json& network, std::vector<Problem>& problems) {
  const auto graph = document_graph({{"nodes", nodes}, {"network", network}});
  if (!graph || graph->connected()) return;
  const auto name = network["graph"].get<std::string>();
  const std::string what = name == "edges" ? "edges do" : "graph is " + in_quotes(name) + ", which does";
  problems.push_back(
      {name == "edges" ? "/network/edges" : "/network/graph",
       what + " not connect the " + std::to_string(nodes.size()) + " nodes; expected a path between every two",
       "a connected network"});
}

}  // namespace

Json plant(const Json& given, std::vector<Problem>& problems) {
  Json result = Json::object();
  if (!given.contains("plant")) {
    Fields(given, "", problems).missing("plant", "{\"type\",\"params\"}");
    return result;
  }
  Fields fields(given["plant"], "/plant", problems);
  fields.known({"type", "params"});
  if (given["plant"].is_object()) complete_typed<PlantMake>(fields, "type", "plant", result, problems);
  return result;
}

Json controller(const Json& given, std::vector<Problem>& problems) {
  const Json section = member(given, "controller", {{"type", "none"}});
  Fields fields(section, "/controller", problems);
  if (!section.is_object() || section.value("type", Json("none")) == "none") {
    fields.known({"type"});
    return {{"type", "none"}};
  }
  fields.known({"type", "params"});
  Json result = Json::object();
  std::vector<std::string> kinds = Registry<ControllerMake>::ids();
  kinds.insert(kinds.begin(), "none");
  if (Registry<ControllerMake>::find(fields.choice("type", kinds, "none").get<std::string>()) == nullptr)
    return {{"type", "none"}};
  complete_typed<ControllerMake>(fields, "type", "controller", result, problems);
  return result;
}

Json nodes(const Json& given, std::vector<Problem>& problems) {
  Json result = Json::object();
  Fields root(given, "", problems);
  const std::string expected = "an object of 1 to " + std::to_string(kMostNodes) + " nodes keyed by their ids";
  if (!root.has("nodes")) {
    root.missing("nodes", expected);
    return result;
  }
  const Json& list = root.at("nodes");
  if (!list.is_object() || list.empty() || list.size() > kMostNodes) {
    problems.push_back({"/nodes",
                        "nodes has " + (list.is_object() ? std::to_string(list.size()) + " members" : shown(list)) +
                            "; expected " + expected,
                        expected});
    return result;
  }
  for (const auto& [key, value] : list.items()) {
    const std::string pointer = child("/nodes", key);
    if (!is_node_id(key)) {
      problems.push_back(
          {pointer, in_quotes(key) + " is no node id; expected 1 to 16 letters, digits and '_'", "[A-Za-z0-9_]{1,16}"});
    } else if (is_reserved(key)) {
      problems.push_back({pointer,
                          in_quotes(key) + " has a meaning of its own in signal names; expected another node id",
                          "not " + listed(kReserved)});
    } else {
      result[key] = node(value, pointer, problems);
    }
  }
  return result;
}

Json network(const Json& given, const Json& document, std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  const Json section = member(given, "network", Json::object());
  Fields fields(section, "/network", problems);
  fields.known({"graph", "edges"});
  const Json& all = document["nodes"];
  Json result = {{"graph", fields.text("graph", "none")}};
  const auto name = result["graph"].get<std::string>();
  if (fields.has("edges")) {
    result["edges"] = edges(fields, all, problems);
  } else if (name == "edges") {
    fields.missing("edges", "an array of pairs of node ids, since graph is \"edges\"");
  }
  if (all.empty()) return result;
  if (name != "edges") {
    if (is_graph_name(name)) {
      check_graph(name, all, problems);
    } else {
      fields.choice("graph", kGraphs, "none");
    }
  }
  if (document["family"] == "sparse" && problems.size() == before) check_connected(all, result, problems);
  return result;
}

int plant_states(const Json& document, std::vector<Problem>& problems) {
  const Json& plant = document["plant"];
  const auto* entry = Registry<PlantMake>::find(plant.value("type", ""));
  if (entry == nullptr || !problems.empty()) return 0;
  try {
    return entry->make(Params(plant["params"]), document["time"]["dt"].get<double>())->states();
  } catch (const InputError& error) {
    for (Problem problem : error.problems()) {
      problem.pointer = "/plant/params" + (problem.pointer == "/" ? "" : problem.pointer);
      problems.push_back(std::move(problem));
    }
    return 0;
  }
}

}  // namespace vigil::section
