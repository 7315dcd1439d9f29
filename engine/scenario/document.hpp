/// The parts of a scenario document that a run, too, has to read: places, attacks started by hand, what may change
/// live.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/core/json.hpp"
#include "engine/world/graph.hpp"

namespace vigil {

enum class PlaceKind { link, every_link, sensor, actuator };

/// Where an attack acts: "link:2-5", "link:*", "sensor:3", "sensor:3.range", "actuator:1", "actuator:1.w1".
struct Place {
  PlaceKind kind = PlaceKind::every_link;
  std::string from;     ///< sender's node id, of a link
  std::string to;       ///< receiver's node id, of a link
  std::string node;     ///< of a sensor or actuator
  std::string channel;  ///< of a sensor or actuator; empty: all
};

/// Reads the text alone; whether its nodes are there is the document's to say. Nothing where it is no place.
std::optional<Place> parse_place(std::string_view text);

/// Completes one member of "adversary" ({"type","on",…}) with defaults and checks it against a document whose nodes and
/// network are complete. Problems are appended with pointers under `pointer`; the result is usable only if none were.
/// Links are checked where the document alone tells the graph (not for knn and radius without positions).
Json complete_attack(const Json& given, const Json& document, const std::string& pointer,
                     std::vector<Problem>& problems);

/// "network.edges" of a complete document (pairs of node ids) as pairs of node indices in document order; empty where
/// there are none.
std::vector<std::pair<int, int>> edge_indices(const Json& document);

/// The graph of a complete document, where the document alone tells it: nothing for knn and radius over nodes without
/// positions. Throws InputError at /network/… where the name does not fit the nodes.
std::optional<Graph> document_graph(const Json& document);

/// The dotted paths of a complete document that may be changed while a run goes on: the parameters declared live,
/// "network.graph" and "adversary.<id>.enabled". In document order.
std::vector<std::string> live_paths(const Json& document);

}  // namespace vigil
