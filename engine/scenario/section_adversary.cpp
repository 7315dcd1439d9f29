/// The adversary: what acts, where and when.
#include "engine/adversary/attack.hpp"
#include "engine/core/describe.hpp"
#include "engine/scenario/document.hpp"
#include "engine/scenario/fields.hpp"
#include "engine/scenario/sections.hpp"
#include "engine/scenario/structure.hpp"
#include "engine/scenario/typed.hpp"

namespace vigil {
namespace {

constexpr const char* kPlaces =
    "link:<from>-<to>, link:*, sensor:<node>, sensor:<node>.<channel>, actuator:<node> or actuator:<node>.<channel>";

/// The document as an attack sees it: its nodes and, where it tells, its graph.
struct Ground {
  std::vector<std::string> nodes;
  std::optional<Graph> graph;

  explicit Ground(const Json& document) {
    for (const auto& [id, node] : document["nodes"].items()) nodes.push_back(id);
    try {
      graph = document_graph(document);
    } catch (const InputError&) {
      graph.reset();  // reported where the network was read
    }
  }

  int index(const std::string& id) const { return end_index(id, nodes, graph.value_or(Graph())); }
};

std::optional<Problem> check_link(const Place& place, const Ground& ground, const std::string& text,
                                  const std::string& pointer) {
  for (const std::string& id : {place.from, place.to}) {
    if (ground.index(id) >= 0 || (id == kCentre && !ground.graph)) continue;
    return Problem{pointer,
                   in_quotes(text) + " names node " + in_quotes(id) + ", which is not there; expected nodes of " +
                       listed(ground.nodes),
                   listed(ground.nodes)};
  }
  const bool known = !ground.graph || ground.graph->find(ground.index(place.from), ground.index(place.to)) >= 0;
  if (known) return std::nullopt;
  std::vector<std::string> links;
  for (const Link& link : ground.graph->links()) {
    links.push_back(link_name(link, ground.nodes));
  }
  return Problem{pointer, in_quotes(text) + " is no link of the network; expected one of " + listed(links),
                 listed(links)};
}

std::optional<Problem> check_place(const std::string& text, const Ground& ground, const std::string& pointer) {
  const auto place = parse_place(text);
  if (!place) return Problem{pointer, "on is " + in_quotes(text) + ", which is no place; expected " + kPlaces, kPlaces};
  if (place->kind == PlaceKind::every_link) return std::nullopt;
  if (place->kind == PlaceKind::link) return check_link(*place, ground, text, pointer);
  if (ground.index(place->node) >= 0) return std::nullopt;  // the channel is checked where the run is made
  return Problem{pointer,
                 in_quotes(text) + " names node " + in_quotes(place->node) +
                     ", which is not there; expected nodes of " + listed(ground.nodes),
                 listed(ground.nodes)};
}

Json places(Fields& fields, const Json& document, std::vector<Problem>& problems) {
  if (!fields.has("on")) {
    fields.missing("on", std::string("an array of places: ") + kPlaces);
    return Json::array();
  }
  Json result = fields.texts("on", Json::array());
  const Ground ground(document);
  for (std::size_t n = 0; n < result.size(); ++n) {
    auto problem = check_place(result[n].get<std::string>(), ground, child(fields.pointer("on"), n));
    if (problem) problems.push_back(std::move(*problem));
  }
  return result;
}

/// When within its time an attack acts.
Json schedule(const Json& given, const std::string& pointer, std::vector<Problem>& problems) {
  Fields fields(given, pointer, problems);
  if (!given.is_object()) return nullptr;
  fields.known({"every", "for", "budget"});
  Json result = {{"every", fields.integer("every", nullptr, 1, true)},
                 {"for", fields.integer("for", nullptr, 1, true)},
                 {"budget", fields.integer("budget", nullptr, 1, true)}};
  if (result["every"].is_null() != result["for"].is_null())
    fields.wrong(result["for"].is_null() ? "for" : "every", "a number of ticks, since the other one is given");
  if (result["every"].is_number() && result["for"].is_number() && result["for"] > result["every"])
    fields.wrong("for", "at most every (" + result["every"].dump() + ")");
  return result;
}

}  // namespace

Json complete_attack(const Json& given, const Json& document, const std::string& pointer,
                     std::vector<Problem>& problems) {
  Json result = Json::object();
  const std::size_t before = problems.size();
  check_structure(given, pointer, problems);
  if (problems.size() > before) return result;
  Fields fields(given, pointer, problems);
  if (!given.is_object()) return result;
  fields.known({"type", "on", "from", "to", "schedule", "enabled", "params"});
  Json typed = Json::object();
  section::complete_typed<AttackMake>(fields, "type", "attack", typed, problems);
  result["type"] = typed.value("type", Json(""));
  result["on"] = places(fields, document, problems);
  result["from"] = fields.integer("from", 1, 0, false);
  result["to"] = fields.integer("to", nullptr, 0, true);
  if (result["to"].is_number() && result["to"] < result["from"]) {
    fields.wrong("to", "a tick not before from (" + result["from"].dump() + ") or null");
  }
  if (fields.has("schedule") && !fields.at("schedule").is_null())
    result["schedule"] = schedule(fields.at("schedule"), fields.pointer("schedule"), problems);
  result["enabled"] = fields.boolean("enabled", true);
  result["params"] = typed.value("params", Json::object());
  return result;
}

namespace section {

Json adversary(const Json& given, const Json& document, std::vector<Problem>& problems) {
  Json result = Json::object();
  if (!given.contains("adversary")) return result;
  const Json& list = given["adversary"];
  if (!list.is_object() || list.size() > kMostAttacks) {
    const std::string expected = "an object of up to " + std::to_string(kMostAttacks) + " attacks keyed by their ids";
    const std::string found =
        list.is_object() ? "has " + std::to_string(list.size()) + " members" : "is " + shown(list);
    problems.push_back({"/adversary", "adversary " + found + "; expected " + expected, expected});
    return result;
  }
  for (const auto& [key, value] : list.items()) {
    const std::string pointer = child("/adversary", key);
    if (is_member_id(key)) {
      result[key] = complete_attack(value, document, pointer, problems);
    } else {
      problems.push_back({pointer, in_quotes(key) + " is no attack id; expected 1 to 32 small letters, digits and '_'",
                          "[a-z0-9_]{1,32}"});
    }
  }
  return result;
}

}  // namespace section
}  // namespace vigil
