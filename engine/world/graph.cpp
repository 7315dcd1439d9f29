#include "engine/world/graph.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"

namespace vigil {
namespace {

using Edges = std::vector<std::pair<int, int>>;

constexpr int kLadder = 8;
constexpr const char* kNames = "none, ring, ladder (8 nodes), path, complete, centre, knn<k>, radius<r>, edges";
/// Distances that differ by less are the same: positions come in decimal, and 1.8 - 1.2 is not 0.6 in binary.
constexpr double kSame = 1e-9;

[[noreturn]] void refuse(std::string detail, std::string allowed) {
  throw InputError("/network/graph", std::move(detail), std::move(allowed));
}

/// The number behind a prefix ("knn3", "radius0.85"); nothing where there is no such prefix or no finite number > 0.
std::optional<double> suffix(std::string_view name, std::string_view prefix) {
  if (name.size() <= prefix.size() || name.substr(0, prefix.size()) != prefix) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(name.data() + prefix.size(), name.data() + name.size(), value);
  if (error != std::errc() || end != name.data() + name.size() || !std::isfinite(value) || value <= 0)
    return std::nullopt;
  return value;
}

std::optional<int> neighbours_wanted(std::string_view name) {
  const auto value = suffix(name, "knn");
  if (!value || *value != std::floor(*value) || *value > 1e6) return std::nullopt;
  return static_cast<int>(*value);
}

Edges path(int nodes) {
  Edges edges;
  for (int i = 0; i + 1 < nodes; ++i) edges.emplace_back(i, i + 1);
  return edges;
}

Edges ring(int nodes) {
  Edges edges = path(nodes);
  if (nodes > 2) edges.emplace_back(nodes - 1, 0);
  return edges;
}

Edges ladder(int nodes) {
  if (nodes != kLadder)
    refuse("the ladder is a graph of 8 nodes; the scenario has " + std::to_string(nodes), "8 nodes");
  Edges edges = ring(nodes);
  edges.emplace_back(2, 7);
  edges.emplace_back(3, 6);
  return edges;
}

Edges complete(int nodes) {
  Edges edges;
  for (int i = 0; i < nodes; ++i) {
    for (int j = i + 1; j < nodes; ++j) edges.emplace_back(i, j);
  }
  return edges;
}

void need_positions(std::string_view name, const Eigen::Matrix2Xd& positions) {
  if (!positions.allFinite())
    refuse(in_quotes(name) + " needs the position of every node", "a graph without distances");
}

Edges nearest_neighbours(int wanted, const Eigen::Matrix2Xd& positions) {
  const auto nodes = static_cast<int>(positions.cols());
  if (wanted >= nodes) {
    const std::string most = "knn1 to knn" + std::to_string(std::max(1, nodes - 1));
    refuse("knn" + std::to_string(wanted) + " needs " + std::to_string(wanted) + " other nodes; the scenario has " +
               std::to_string(nodes) + " nodes, expected " + most,
           most);
  }
  Edges edges;
  for (int i = 0; i < nodes; ++i) {
    std::vector<int> others;
    for (int j = 0; j < nodes; ++j) {
      if (j != i) others.push_back(j);
    }
    for (int taken = 0; taken < wanted; ++taken) {
      const auto apart = [&](int j) { return (positions.col(i) - positions.col(j)).norm(); };
      double least = apart(others.front());
      for (const int j : others) least = std::min(least, apart(j));
      const auto chosen =
          std::find_if(others.begin(), others.end(), [&](int j) { return apart(j) <= least * (1 + kSame); });
      edges.emplace_back(i, *chosen);
      others.erase(chosen);
    }
  }
  return edges;
}

Edges within(double radius, const Eigen::Matrix2Xd& positions) {
  Edges edges;
  for (const auto& [i, j] : complete(static_cast<int>(positions.cols()))) {
    if ((positions.col(i) - positions.col(j)).norm() <= radius * (1 + kSame)) edges.emplace_back(i, j);
  }
  return edges;
}

std::optional<Edges> plain(std::string_view name, int nodes) {
  if (name == "none") return Edges{};
  if (name == "ring") return ring(nodes);
  if (name == "ladder") return ladder(nodes);
  if (name == "path") return path(nodes);
  if (name == "complete") return complete(nodes);
  return std::nullopt;
}

}  // namespace

Graph::Graph(int nodes, const std::vector<std::pair<int, int>>& edges) : nodes_(nodes) {
  for (std::size_t n = 0; n < edges.size(); ++n) {
    const auto [a, b] = edges[n];
    const std::string both = "[" + std::to_string(a) + "," + std::to_string(b) + "]";
    const auto outside = [&](int node) { return node < 0 || node >= nodes; };
    if (outside(a) || outside(b)) {
      throw InputError(
          child("/network/edges", n),
          "edge " + both + " names a node that is not there; expected indices below " + std::to_string(nodes),
          "0 to " + std::to_string(nodes - 1));
    }
    if (a == b) {
      throw InputError(child("/network/edges", n),
                       "edge " + both + " joins a node to itself; expected two distinct nodes", "two distinct nodes");
    }
    links_.push_back({a, b});
    links_.push_back({b, a});
  }
  const auto order = [](const Link& l, const Link& r) { return std::tie(l.to, l.from) < std::tie(r.to, r.from); };
  std::sort(links_.begin(), links_.end(), order);
  links_.erase(std::unique(links_.begin(), links_.end()), links_.end());
  first_in_.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (const Link& link : links_) ++first_in_[static_cast<std::size_t>(link.to) + 1];
  for (std::size_t i = 1; i < first_in_.size(); ++i) first_in_[i] += first_in_[i - 1];
}

Graph Graph::to_centre(int nodes) {
  Graph graph(nodes, {});
  graph.centre_ = nodes;
  for (int i = 0; i < nodes; ++i) graph.links_.push_back({i, nodes});
  graph.first_in_.push_back(nodes);
  return graph;
}

int Graph::degree(int node) const { return first_in(node + 1) - first_in(node); }

int Graph::max_degree() const {
  int most = 0;
  for (int node = 0; node < nodes_; ++node) most = std::max(most, degree(node));
  return most;
}

bool Graph::connected() const {
  if (nodes_ == 0 || centre_ >= 0) return true;
  std::vector<bool> seen(static_cast<std::size_t>(nodes_), false);
  std::vector<int> open{0};
  seen[0] = true;
  int reached = 0;
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    ++reached;
    for (int n = first_in(node); n < first_in(node + 1); ++n) {
      const int other = links_[static_cast<std::size_t>(n)].from;
      if (seen[static_cast<std::size_t>(other)]) continue;
      seen[static_cast<std::size_t>(other)] = true;
      open.push_back(other);
    }
  }
  return reached == nodes_;
}

int Graph::find(int from, int to) const {
  if (to < 0 || (to >= nodes_ && to != centre_)) return -1;
  for (int n = first_in(to); n < first_in(to + 1); ++n) {
    if (links_[static_cast<std::size_t>(n)].from == from) return n;
  }
  return -1;
}

std::string link_name(const Link& link, const std::vector<std::string>& nodes) {
  const auto name = [&](int end) {
    const auto place = static_cast<std::size_t>(end);
    return place < nodes.size() ? nodes[place] : std::string(kCentre);
  };
  return name(link.from) + "-" + name(link.to);
}

int end_index(const std::string& id, const std::vector<std::string>& nodes, const Graph& graph) {
  if (id == kCentre) return graph.centre();
  const auto found = std::find(nodes.begin(), nodes.end(), id);
  return found == nodes.end() ? -1 : static_cast<int>(found - nodes.begin());
}

Graph make_graph(std::string_view name, const Eigen::Matrix2Xd& positions) {
  const auto nodes = static_cast<int>(positions.cols());
  if (const auto edges = plain(name, nodes)) return {nodes, *edges};
  if (name == "centre") return Graph::to_centre(nodes);
  if (const auto wanted = neighbours_wanted(name)) {
    need_positions(name, positions);
    return {nodes, nearest_neighbours(*wanted, positions)};
  }
  if (const auto radius = suffix(name, "radius")) {
    need_positions(name, positions);
    return {nodes, within(*radius, positions)};
  }
  refuse("graph is " + in_quotes(name) + "; expected one of " + kNames, kNames);
}

bool is_graph_name(std::string_view name) {
  const bool by_word =
      name == "none" || name == "ring" || name == "ladder" || name == "path" || name == "complete" || name == "centre";
  return by_word || neighbours_wanted(name).has_value() || suffix(name, "radius").has_value();
}

}  // namespace vigil
