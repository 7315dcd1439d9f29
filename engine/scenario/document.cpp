#include "engine/scenario/document.hpp"

#include <algorithm>

#include "engine/adversary/attack.hpp"
#include "engine/core/describe.hpp"
#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/method.hpp"
#include "engine/scenario/fields.hpp"

namespace vigil {
namespace {

/// The text behind `prefix`, nothing where it does not begin so.
std::optional<std::string_view> behind(std::string_view text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return std::nullopt;
  return text.substr(prefix.size());
}

std::optional<Place> parse_link(std::string_view rest) {
  if (rest == "*") return Place{};
  const std::size_t dash = rest.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const std::string_view from = rest.substr(0, dash), to = rest.substr(dash + 1);
  if (!is_node_id(from) || !is_node_id(to)) return std::nullopt;
  Place place;
  place.kind = PlaceKind::link;
  place.from = from;
  place.to = to;
  return place;
}

std::optional<Place> parse_sensor(std::string_view rest) {
  const std::size_t dot = rest.find('.');
  const bool has_channel = dot != std::string_view::npos;
  const std::string_view channel = has_channel ? rest.substr(dot + 1) : std::string_view();
  if (!is_node_id(rest.substr(0, dot)) || (has_channel && !is_node_id(channel))) return std::nullopt;
  Place place;
  place.kind = PlaceKind::sensor;
  place.node = rest.substr(0, dot);
  place.channel = channel;
  return place;
}

/// Node positions in the plane as the sensors' params give them; NaN where one does not.
Eigen::Matrix2Xd positions(const Json& nodes) {
  Eigen::Matrix2Xd result = Eigen::Matrix2Xd::Constant(2, static_cast<Eigen::Index>(nodes.size()), std::nan(""));
  Eigen::Index column = 0;
  for (const auto& [id, node] : nodes.items()) {
    const Json params = node["sensor"].value("params", Json::object());
    const Json place = params.value("position", Json(nullptr));
    const bool in_plane_or_space = place.is_array() && (place.size() == 2 || place.size() == 3);
    if (in_plane_or_space && place[0].is_number() && place[1].is_number()) {
      result.col(column) << place[0].get<double>(), place[1].get<double>();
    }
    ++column;
  }
  return result;
}

template <class Make>
void add_live(const Json& member, const char* key, const std::string& path, std::vector<std::string>& paths) {
  const auto* entry = Registry<Make>::find(member.value(key, ""));
  if (entry == nullptr) return;
  for (const auto& param : entry->params.all()) {
    if (param.live) paths.push_back(path + ".params." + param.name);
  }
}

}  // namespace

std::optional<Place> parse_place(std::string_view text) {
  if (const auto rest = behind(text, "link:")) return parse_link(*rest);
  if (const auto rest = behind(text, "sensor:")) return parse_sensor(*rest);
  const auto rest = behind(text, "actuator:");
  if (!rest) return std::nullopt;
  auto place = parse_sensor(*rest);
  if (place) place->kind = PlaceKind::actuator;
  return place;
}

std::vector<std::pair<int, int>> edge_indices(const Json& document) {
  std::vector<std::string> ids;
  for (const auto& [id, node] : document["nodes"].items()) ids.push_back(id);
  const auto index = [&ids](const Json& id) {
    return static_cast<int>(std::find(ids.begin(), ids.end(), id.get<std::string>()) - ids.begin());
  };
  std::vector<std::pair<int, int>> result;
  const Json edges = document["network"].value("edges", Json::array());
  for (const auto& edge : edges) result.emplace_back(index(edge[0]), index(edge[1]));
  return result;
}

std::optional<Graph> document_graph(const Json& document) {
  const auto name = document["network"]["graph"].get<std::string>();
  const auto nodes = static_cast<int>(document["nodes"].size());
  if (name == "edges") return Graph(nodes, edge_indices(document));
  const Eigen::Matrix2Xd places = positions(document["nodes"]);
  const bool by_distance = name.starts_with("knn") || name.starts_with("radius");
  if (by_distance && !places.allFinite()) return std::nullopt;
  return make_graph(name, places);
}

std::vector<std::string> live_paths(const Json& document) {
  std::vector<std::string> paths{"network.graph"};
  for (const auto& [id, attack] : document["adversary"].items()) {
    const std::string path = "adversary." + id;
    paths.push_back(path + ".enabled");
    add_live<AttackMake>(attack, "type", path, paths);
  }
  for (const auto& [id, lane] : document["lanes"].items()) {
    add_live<MethodMake>(lane, "method", "lanes." + id, paths);
    add_live<DetectorMake>(lane.value("detector", Json::object()), "type", "lanes." + id + ".detector", paths);
  }
  return paths;
}

}  // namespace vigil
