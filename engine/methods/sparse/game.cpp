#include "engine/methods/sparse/game.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/missing.hpp"

namespace vigil::sparse {
PotentialGame::PotentialGame(const Params& params, const Draws& draws, const Graph& graph)
    : draws_(draws),
      graph_(graph),
      largest_(static_cast<std::size_t>(graph.nodes())),
      differing_(Eigen::MatrixXi::Zero(graph.nodes(), graph.nodes())),
      utility_(Eigen::MatrixXd::Constant(graph.nodes(), graph.nodes(), kMissing)),
      probability_(utility_),
      choices_(static_cast<std::size_t>(graph.nodes()), -1) {
  retune(params);
}

void PotentialGame::retune(const Params& params) {
  split_ = params.text("form") == "split";
  greedy_ = params.boolean("greedy");
  r_ = params.real("r");
  beta_ = params.real("beta");
  u_floor_ = params.real("u_floor");
}

void PotentialGame::compare(const Eigen::MatrixXd& E) {
  for (Eigen::Index j = 0; j < E.cols(); ++j) {
    largest_[static_cast<std::size_t>(j)] = E.col(j).cwiseAbs().maxCoeff();
    for (Eigen::Index l = 0; l <= j; ++l) {
      int count = 0;
      for (Eigen::Index c = 0; c < E.rows(); ++c) count += (E(c, j) != 0) != (E(c, l) != 0) ? 1 : 0;
      differing_(j, l) = differing_(l, j) = count;
    }
  }
}

/// Utilities (7) and probabilities (9) of node i over Theta_i = N_i + {i}.
void PotentialGame::weigh(int i, const std::vector<char>& ready, const std::vector<char>& heard) {
  const int first = graph_.first_in(i), end = first + graph_.degree(i);
  const auto is_heard = [&](int link) {
    const int from = graph_.links()[static_cast<std::size_t>(link)].from;
    return heard[static_cast<std::size_t>(link)] != 0 && ready[static_cast<std::size_t>(from)] != 0;
  };
  const auto value = [&](int j) {
    double apart = 0;
    for (int link = first; link < end; ++link) {
      if (is_heard(link)) apart += differing_(j, graph_.links()[static_cast<std::size_t>(link)].from);
    }
    const double size = std::max(largest_[static_cast<std::size_t>(j)], u_floor_);
    return split_ ? -r_ * std::log(size) - apart : -r_ * std::log(size + apart);
  };
  utility_(i, i) = value(i);
  double most = utility_(i, i);
  for (int link = first; link < end; ++link) {
    if (!is_heard(link)) continue;
    const int j = graph_.links()[static_cast<std::size_t>(link)].from;
    utility_(i, j) = value(j);
    most = std::max(most, utility_(i, j));
  }
  double total = 0;
  for (Eigen::Index j = 0; j < utility_.cols(); ++j) {
    if (std::isnan(utility_(i, j))) continue;
    probability_(i, j) = std::exp(beta_ * (utility_(i, j) - most));
    total += probability_(i, j);
  }
  probability_.row(i) /= total;
}

/// The first candidate whose cumulative probability exceeds u; greedy: the first of the most probable.
int PotentialGame::draw(int i, double u) const {
  int chosen = i;
  double sum = 0, best = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < static_cast<int>(probability_.cols()); ++j) {
    if (std::isnan(probability_(i, j))) continue;
    if (greedy_) {
      if (utility_(i, j) > best) {
        best = utility_(i, j);
        chosen = j;
      }
      continue;
    }
    sum += probability_(i, j);
    chosen = j;
    if (sum > u) break;
  }
  return chosen;
}

void PotentialGame::play(std::int64_t k, const Eigen::MatrixXd& E, const std::vector<char>& ready,
                         const std::vector<char>& heard) {
  utility_.setConstant(kMissing);
  probability_.setConstant(kMissing);
  compare(E);
  for (int i = 0; i < graph_.nodes(); ++i) {
    choices_[static_cast<std::size_t>(i)] = -1;
    if (ready[static_cast<std::size_t>(i)] == 0) continue;
    weigh(i, ready, heard);
    choices_[static_cast<std::size_t>(i)] = draw(i, draws_.uniform(k, static_cast<std::uint32_t>(i)));
  }
}

}  // namespace vigil::sparse
