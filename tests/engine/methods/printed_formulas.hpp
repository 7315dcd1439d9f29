/// The filter of seed 000 as its specification prints it (section 5), with plain inverses and run-time sizes: slow, and
/// a second reading of the same page. No guard: valid while (28), (29) hold.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "tests/engine/methods/rig.hpp"

namespace vigil::printed {

struct Constants {
  double tau = 0.01, sigma = 0.1, beta = 0.1, eps = 0.3;
  double phibar = 0, gammabar = 0, delta = 0;
  double u = 0.005, v = 0.02;
  std::string bound = "paper";
};

struct NodeState {
  Eigen::VectorXd x, xp;
  Eigen::MatrixXd Phi, Pp, C, M;
};

inline Eigen::MatrixXd identity(Eigen::Index n) { return Eigen::MatrixXd::Identity(n, n); }

/// m0, mn, ma of section 7.
inline Eigen::Vector3d multipliers(const Constants& c, int d, const Eigen::MatrixXd& C) {
  if (d == 0) return {1, 0, 0};
  if (c.bound == "paper") return {1.0 + 2 * d, 3, 3};
  if (c.bound == "corrected") return Eigen::Vector3d::Constant(1.0 + 2 * d);
  const double norm = Eigen::JacobiSVD<Eigen::MatrixXd>(C).singularValues()[0];
  const double w = std::max(1e-6, std::min(norm, 1 / (1.0 + 2 * d)));
  return {1 / (1 - 2 * d * w), 1 / w, 1 / w};
}

/// Lines 1 to 5.
inline void predict(NodeState& node, const Knowledge& known, const Constants& c) {
  const auto n = node.x.size();
  const Eigen::VectorXd input(0);
  Eigen::MatrixXd F(n, n);
  known.plant->jacobian(node.x, input, F);
  node.xp.resize(n);
  known.plant->advance(node.x, input, node.xp);
  const Eigen::MatrixXd inner = (node.Phi.inverse() - (1 + c.eps) * c.sigma * identity(n)).inverse();
  node.Pp = F * inner * F.transpose() + 1 / (c.eps * c.sigma) * c.u * c.u * identity(n) + known.Q;  // (26)
  node.C = c.tau * node.Pp;
  node.M = (node.Pp.inverse() - c.beta * identity(n)).inverse();
}

/// (27) as a function of the gain, for the test that perturbs it.
inline Eigen::MatrixXd bound_of(const Eigen::MatrixXd& K, const NodeState& node, const Eigen::MatrixXd& H,
                                const Eigen::MatrixXd& R, const Eigen::MatrixXd& neighbours, int delivered, int d,
                                const Constants& c) {
  const auto n = node.x.size();
  const Eigen::Vector3d m = multipliers(c, d, node.C);
  const Eigen::MatrixXd VV = c.v * c.v * identity(R.rows());
  const Eigen::MatrixXd G = identity(n) - delivered * node.C - K * H;
  return m[0] * G * node.M * G.transpose() + m[1] * (1 - c.phibar) * node.C * neighbours * node.C.transpose() +
         m[2] * d * c.delta * c.delta * c.gammabar * node.C * node.C.transpose() +
         K * (m[0] / c.beta * VV + R) * K.transpose();
}

/// (30).
inline Eigen::MatrixXd gain(const NodeState& node, const Eigen::MatrixXd& H, const Eigen::MatrixXd& R, int delivered,
                            int d, const Constants& c) {
  const Eigen::Vector3d m = multipliers(c, d, node.C);
  const Eigen::MatrixXd VV = c.v * c.v * identity(R.rows());
  const Eigen::MatrixXd S = H * node.M * H.transpose() + VV / c.beta + R / m[0];
  return (identity(node.x.size()) - delivered * node.C) * node.M * H.transpose() * S.inverse();
}

/// What node i hears: line 7, the sum of line 12 and that of line 15.
struct Heard {
  int delivered = 0;
  Eigen::VectorXd pull;
  Eigen::MatrixXd neighbours;
};

inline Heard hear(const std::vector<NodeState>& nodes, int i, const Knowledge& known, const rig::Links& links) {
  const NodeState& node = nodes[static_cast<std::size_t>(i)];
  Heard heard{0, Eigen::VectorXd::Zero(node.x.size()), Eigen::MatrixXd::Zero(node.x.size(), node.x.size())};
  for (std::size_t l = 0; l < known.graph.links().size(); ++l) {
    const Link& link = known.graph.links()[l];
    if (link.to != i) continue;
    const NodeState& from = nodes[static_cast<std::size_t>(link.from)];
    heard.neighbours += from.Pp;
    if (links.state[l] == LinkState::dos) continue;
    ++heard.delivered;
    Eigen::VectorXd difference = from.xp - node.xp;
    if (links.state[l] == LinkState::fdi) difference += links.injected.col(static_cast<Eigen::Index>(l));
    for (Eigen::Index s = 0; s < difference.size(); ++s) {
      const double period = known.plant->state()[static_cast<std::size_t>(s)].period;
      if (period > 0) difference[s] -= period * std::floor(difference[s] / period + 0.5);
    }
    heard.pull += difference;
  }
  return heard;
}

/// Lines 6 to 16 at every node; a reading with a NaN is none.
inline void update(std::vector<NodeState>& nodes, const Knowledge& known, const Readings& readings,
                   const rig::Links& links, const Constants& c) {
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    NodeState& node = nodes[static_cast<std::size_t>(i)];
    const Sensor& sensor = *known.sensors[static_cast<std::size_t>(i)];
    const Heard heard = hear(nodes, i, known, links);
    const int d = known.graph.degree(i);
    Eigen::MatrixXd H(sensor.size(), node.x.size());
    Eigen::VectorXd r(sensor.size());
    sensor.jacobian(node.xp, H);
    sensor.measure(node.xp, r);
    r = readings[static_cast<std::size_t>(i)] - r;
    for (Eigen::Index s = 0; s < r.size(); ++s) {
      const double period = sensor.channels()[static_cast<std::size_t>(s)].period;
      if (period > 0) r[s] -= period * std::floor(r[s] / period + 0.5);
    }
    const bool measured = r.allFinite();
    const Eigen::MatrixXd K = measured ? gain(node, H, sensor.noise(), heard.delivered, d, c)
                                       : Eigen::MatrixXd::Zero(node.x.size(), r.size());
    node.x = node.xp + node.C * heard.pull;
    if (measured) node.x += K * r;
    node.Phi = bound_of(K, node, H, sensor.noise(), heard.neighbours, heard.delivered, d, c);
  }
}

}  // namespace vigil::printed
