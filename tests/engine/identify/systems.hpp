/// Synthetic systems whose model is known.
#pragma once

#include "engine/identify/arx.hpp"
#include "engine/random/draws.hpp"

namespace vigil::test {

/// y(k) = sum A_i y(k-i) + B u(k-lag) + c + deviation e, u switching at random between 0 and 1, e ~ N(0, I).
inline identify::Records recorded(const identify::Arx& truth, Eigen::Index rows, double deviation, std::uint64_t seed) {
  const Eigen::Index n = truth.c.size(), m = truth.B.cols();
  identify::Records records{Eigen::MatrixXd::Zero(rows, n), Eigen::MatrixXd::Zero(rows, m)};
  const Draws noise(seed, "test.noise"), switches(seed, "test.input");
  Eigen::VectorXd e(n), s(m);
  for (Eigen::Index k = 0; k < rows; ++k) {
    if (m > 0) {
      switches.normals(k, s);
      records.inputs.row(k) = (s.array() > 0).cast<double>().transpose();
    }
    if (k < truth.order()) continue;
    noise.normals(k, e);
    Eigen::VectorXd y = truth.c + deviation * e;
    if (m > 0) y += truth.B * records.inputs.row(k - truth.lag).transpose();
    for (int i = 0; i < truth.order(); ++i)
      y += truth.A[static_cast<std::size_t>(i)] * records.outputs.row(k - 1 - i).transpose();
    records.outputs.row(k) = y.transpose();
  }
  return records;
}

/// Two tanks that leak into each other, two pumps.
inline identify::Arx two_tanks(int lag = 0) {
  identify::Arx truth;
  truth.lag = lag;
  truth.A = {(Eigen::MatrixXd(2, 2) << 0.9, 0.05, -0.1, 0.8).finished()};
  truth.B = (Eigen::MatrixXd(2, 2) << 0.5, 0, 0.1, -0.4).finished();
  truth.c = Eigen::Vector2d(0.3, 1.2);
  return truth;
}

}  // namespace vigil::test
