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
  /// Every node has one channel, to a fusion centre that is no node: links()[i] is {i, nodes}.
  static Graph to_centre(int nodes);

  int nodes() const { return nodes_; }
  /// Where links to the fusion centre end, -1 where there is none.
  int centre() const { return centre_; }
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
  int centre_ = -1;
  std::vector<Link> links_;
  std::vector<int> first_in_;
};

/// What the fusion centre is called among the ends of links.
inline constexpr const char* kCentre = "fused";
/// "2-5", "2-fused": a link by the ids of its ends.
std::string link_name(const Link& link, const std::vector<std::string>& nodes);
/// The index of a link's end by its id, the centre's included; -1 where there is no such end.
int end_index(const std::string& id, const std::vector<std::string>& nodes, const Graph& graph);

/// Builds a named graph over node positions (one column a node, the profile's length unit): "none", "ring", "ladder" (8
/// nodes), "path", "complete", "centre", "knn<k>", "radius<r>". Throws InputError at /network/graph for an unknown name
/// or one that does not fit.
Graph make_graph(std::string_view name, const Eigen::Matrix2Xd& positions);

/// True where make_graph knows the name.
bool is_graph_name(std::string_view name);

}  // namespace vigil
