/// A network of nodes with sensors of one or two channels on a linear plant.
#pragma once

#include "tests/engine/methods/linear_plant.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::rig {

inline constexpr int kStates = 3;

Eigen::MatrixXd drawn(int rows, int columns, std::int64_t tick);

/// Initial estimates are `spread` apart.
Knowledge network(int nodes, const std::vector<std::pair<int, int>>& edges, double spread = 1);

Eigen::VectorXd truth_at(int k);

}  // namespace vigil::rig
