#include "tests/engine/methods/linear_network.hpp"

namespace vigil::rig {

Eigen::MatrixXd drawn(int rows, int columns, std::int64_t tick) {
  Eigen::VectorXd draw(rows * columns);
  Draws(77, "consensus").normals(tick, draw);
  return draw.reshaped(rows, columns);
}

Knowledge network(int nodes, const std::vector<std::pair<int, int>>& edges, double spread) {
  Knowledge known;
  known.plant = std::make_shared<LinearPlant>(0.9 * Eigen::MatrixXd::Identity(kStates, kStates) +
                                              0.1 * drawn(kStates, kStates, 1));
  for (int i = 0; i < nodes; ++i) {
    const int channels = 1 + i % 2;
    const Eigen::MatrixXd half =
        Eigen::MatrixXd::Identity(channels, channels) + 0.3 * drawn(channels, channels, 20 + i);
    known.sensors.push_back(
        std::make_shared<LinearSensor>(drawn(channels, kStates, 40 + i), 0.2 * half * half.transpose()));
    known.nodes.push_back("n" + std::to_string(i));
  }
  known.graph = Graph(nodes, edges);
  known.rates.resize(known.graph.links().size());
  const Eigen::MatrixXd half = drawn(kStates, kStates, 2);
  known.Q = 0.1 * half * half.transpose() + 0.01 * Eigen::MatrixXd::Identity(kStates, kStates);
  known.P0 = 0.5 * Eigen::MatrixXd::Identity(kStates, kStates);
  known.estimates = spread * drawn(kStates, nodes, 3);
  return known;
}

Eigen::VectorXd truth_at(int k) { return 2 * drawn(kStates, 1, 1000 + k); }

}  // namespace vigil::rig
