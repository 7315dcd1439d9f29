/// The network between nodes: an undirected graph whose every edge is two directed channels. Seed 000, section 3 of the
/// specification.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vigil {

/// One directed channel: what node `from` says to node `to`. Indices into the scenario's nodes.
struct Link {
  int from = 0;
  int to = 0;
  bool operator==(const Link&) const = default;
};

/// Links are grouped by their receiver and within it ordered by sender, so that the links into a node are one
/// contiguous range.
class Graph {
 public:
  Graph() = default;
  /// Edges as pairs of distinct node indices below `nodes`; an edge given twice counts once. Throws InputError at
  /// /network/edges.
  Graph(int nodes, const std::vector<std::pair<int, int>>& edges);

  int nodes() const { return nodes_; }
  const std::vector<Link>& links() const { return links_; }
  int first_in(int node) const {
    return first_in_[static_cast<std::size_t>(node)];
  }  ///< index of the first link into node
  int degree(int node) const;
  int max_degree() const;
  bool connected() const;
  int find(int from, int to) const;  ///< index of a link, -1

 private:
  int nodes_ = 0;
  std::vector<Link> links_;
  std::vector<int> first_in_;
};

/// Builds a named graph over node positions (one column a node, the profile's length unit): "none", "ring", "ladder" (8
/// nodes), "path", "complete", "knn<k>", "radius<r>". Throws InputError at /network/graph for an unknown name or one
/// that does not fit.
Graph make_graph(std::string_view name, const Eigen::Matrix2Xd& positions);

/// True where make_graph knows the name.
bool is_graph_name(std::string_view name);

}  // namespace vigil
