#include "engine/methods/observer/fallback.hpp"

#include "engine/linalg/care.hpp"

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

/// Of the errors in the coordinates (e_xi, e_w), where Abar is [A2 D2; 0 0]; the answer is turned back to (e_xi,
/// e_theta).
std::optional<Matrix> gain(const Subsystem& s, const RiccatiWeights& weights) {
  const Augmented a = augment(s);
  const int xi = s.n() + s.g(), q = s.q(), p = s.p();
  Matrix A = Matrix::Zero(xi + q, xi + q), C = Matrix::Zero(p, xi + q), Q = Matrix::Zero(xi + q, xi + q);
  A.topLeftCorner(xi, xi) = a.A2;
  A.topRightCorner(xi, q) = a.D2;
  C.leftCols(xi) = a.C1;
  Q.topLeftCorner(xi, xi) = weights.qd * a.Dd2 * a.Dd2.transpose() + weights.qf * a.F2 * a.F2.transpose();
  Q.bottomRightCorner(q, q).diagonal().setConstant(weights.qw);
  const auto X = solve_care(A, C, Q, Matrix::Identity(p, p));
  if (!X) return std::nullopt;
  Matrix L = *X * C.transpose();
  L.bottomRows(q) -= a.N * L.topRows(xi);
  return L / s.mu;
}

}  // namespace

std::optional<Gains> riccati_gains(const Network& network, const RiccatiWeights& weights) {
  Gains gains;
  for (const Subsystem& s : network.subsystems) {
    auto L = gain(s, weights);
    if (!L) return std::nullopt;
    gains.push_back(std::move(*L));
  }
  return gains;
}

}  // namespace vigil::observer
