/// The potential game: each node keeps its own estimate or copies a neighbour's, with a probability that rewards small
/// attacks and supports that agree with the neighbourhood's. Seed 001, eqs. (7)-(9); specification, section 9.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/core/params.hpp"
#include "engine/random/draws.hpp"
#include "engine/world/graph.hpp"

namespace vigil::sparse {

class PotentialGame {
 public:
  PotentialGame(const Params& params, const Draws& draws, const Graph& graph);
  void retune(const Params& params);
  void rewire(const Graph& graph) { graph_ = graph; }

  /// Plays tick k. E: entries x nodes, each node's own attack; ready: nodes whose E is of this tick, the others neither
  /// play nor are copied; heard: one a link, false where the message was lost. No allocation.
  void play(std::int64_t k, const Eigen::MatrixXd& E, const std::vector<char>& ready, const std::vector<char>& heard);

  int choice(int node) const { return choices_[static_cast<std::size_t>(node)]; }  ///< -1: did not play
  /// U_i(j) and pi_i(j) of the last play; NaN where j was no candidate of i.
  double utility(int i, int j) const { return utility_(i, j); }
  double probability(int i, int j) const { return probability_(i, j); }

 private:
  void compare(const Eigen::MatrixXd& E);
  void weigh(int i, const std::vector<char>& ready, const std::vector<char>& heard);
  int draw(int i, double u) const;

  bool split_ = true, greedy_ = false;
  double r_ = 2, beta_ = 10, u_floor_ = 0.01;
  Draws draws_;
  Graph graph_;
  std::vector<double> largest_;  ///< max |E_j|
  Eigen::MatrixXi differing_;    ///< ||[E_j != 0] xor [E_l != 0]||_1
  Eigen::MatrixXd utility_, probability_;
  std::vector<int> choices_;
};

}  // namespace vigil::sparse
