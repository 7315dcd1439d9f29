/// The consensus filter under mixed DoS and FDI attacks as free functions over plain structs: seed 000, (3), (7),
/// (26)-(30), with the guards and bound modes of the specification, sections 5 to 7. Sizes are template arguments so
/// that the common ones are fixed.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/linalg/small.hpp"

namespace vigil::consensus {

enum class Guard { clip, strict, none, adapt };
enum class Bound { paper, corrected, tight };

/// Constants of the filter, the same at every node.
struct Constants {
  double tau = 0.01;   ///< consensus strength: C = tau * Pp
  double sigma = 0.1;  ///< (28)
  double beta = 0.1;   ///< (29)
  double eps = 0.3;    ///< Young's parameter, 0 < eps < 1/d_max
  double rho = 0.9;    ///< clip at this share of the limits
  Guard guard = Guard::clip;
  Bound bound = Bound::paper;

  double limit28() const { return 1 / ((1 + eps) * sigma); }
  double limit29() const { return 1 / beta; }
};

/// One node: its estimate and bound, and what the running step holds. N states, M channels (Eigen::Dynamic: bounded).
template <int N, int M>
struct Node {
  using VecN = SmallMatrix<N, 1>;
  using MatN = SmallMatrix<N, N>;
  using VecM = SmallMatrix<M, 1>;
  using MatM = SmallMatrix<M, M>;
  using MatMN = SmallMatrix<M, N>;
  using MatNM = SmallMatrix<N, M>;

  VecN x;           ///< estimate, x(k|k)
  MatN Phi;         ///< bound, Phi(k|k), raw as (27) gives it
  VecN phi_values;  ///< eigenvalues of Phi, ascending
  MatN phi_vectors;

  VecN xp;            ///< prediction, x(k+1|k)
  MatN Pp;            ///< bound of the prediction, Phi(k+1|k), guarded
  MatN M1;            ///< (Pp^-1 - beta I)^-1
  MatN C;             ///< consensus gain
  double c_norm = 0;  ///< ||C||_2
  double beta = 0;    ///< as used here (guard adapt changes it)
  bool feasible28 = true, feasible29 = true;
  double lambda_predicted = 0;  ///< largest eigenvalue of Phi(k+1|k) before the guard
  double least_predicted = 0;   ///< smallest

  VecM innovation;
  MatM innovation_bound;  ///< upper bound of the innovation's covariance: H M H' + V V'/beta + R
  bool measured = false;

  MatN UU, Q;  ///< U U', process noise
  MatM VV, R;  ///< V V', measurement noise

  void resize(int n, int m) {
    if constexpr (N == Eigen::Dynamic) {
      for (auto* v : {&x, &phi_values, &xp}) v->resize(n);
      for (auto* a : {&Phi, &phi_vectors, &Pp, &M1, &C, &UU, &Q}) a->resize(n, n);
    }
    if constexpr (M == Eigen::Dynamic) {
      innovation.resize(m);
      for (auto* a : {&innovation_bound, &VV, &R}) a->resize(m, m);
    }
    static_cast<void>(n);
    static_cast<void>(m);
  }
};

/// Eigenvalues and vectors of Phi(k|k), which the conditions and the guards need. False where it is not finite.
template <int N, int M>
bool decompose(Node<N, M>& node) {
  if (!node.Phi.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<typename Node<N, M>::MatN> eigen(node.Phi);
  if (eigen.info() != Eigen::Success) return false;
  node.phi_values = eigen.eigenvalues();
  node.phi_vectors = eigen.eigenvectors();
  return true;
}

/// The multipliers of the own, neighbour and attack terms of (27): section 7. Valid if 1/m0 + d/mn + d/ma <= 1.
struct Multipliers {
  double own = 1, neighbour = 0, attack = 0;
};

inline Multipliers multipliers(Bound bound, int degree, double c_norm) {
  if (degree == 0) return {};
  const double grown = 1.0 + 2.0 * degree;
  switch (bound) {
    case Bound::paper:
      return {grown, 3, 3};
    case Bound::corrected:
      return {grown, grown, grown};
    case Bound::tight:
      break;
  }
  const double w = std::max(1e-6, std::min(c_norm, 1 / grown));
  return {1 / (1 - 2 * degree * w), 1 / w, 1 / w};
}

/// True where theorem 1's bound holds in this mode for this degree: (24) and (35), (36) are wrong for two neighbours
/// and more.
inline bool bound_is_valid(Bound bound, int degree) { return bound != Bound::paper || degree <= 1; }

/// Steps 2 to 5: from Phi(k|k) and F to the guarded prediction bound (26), the gain C and M. The conditions (28), (29)
/// are judged before the guard. Returns false where the result is not finite.
template <int N, int M>
bool predict_bound(Node<N, M>& node, const typename Node<N, M>::MatN& F, const Constants& constants, int degree) {
  using VecN = typename Node<N, M>::VecN;
  using MatN = typename Node<N, M>::MatN;
  const auto last = node.phi_values.size() - 1;
  constexpr double floor = 1e-12;

  VecN lambda = node.phi_values;
  node.feasible28 = lambda[0] > 0 && lambda[last] < constants.limit28();
  node.feasible29 = true;  // judged below, unless there is nothing finite to judge
  double sigma = constants.sigma;
  if (constants.guard == Guard::clip) lambda = lambda.cwiseMax(floor).cwiseMin(constants.rho * constants.limit28());
  if (constants.guard == Guard::adapt) sigma = std::min(sigma, constants.rho / ((1 + constants.eps) * lambda[last]));
  const double a = (1 + constants.eps) * sigma;
  lambda = lambda.array() / (1 - a * lambda.array());  // eigenvalues of (A^-1 - a I)^-1
  const MatN FV = F * node.phi_vectors;
  node.Pp.noalias() = FV * lambda.asDiagonal() * FV.transpose();
  node.Pp += node.UU * (1 / (constants.eps * sigma)) + node.Q;  // (26)
  symmetrise(node.Pp);
  if (!node.Pp.allFinite()) return false;

  const Eigen::SelfAdjointEigenSolver<MatN> eigen(node.Pp);
  if (eigen.info() != Eigen::Success) return false;
  VecN mu = eigen.eigenvalues();
  const MatN& W = eigen.eigenvectors();
  node.lambda_predicted = mu[last];
  node.least_predicted = mu[0];
  node.feasible29 = mu[0] > 0 && mu[last] < constants.limit29();
  node.beta = constants.beta;
  if (constants.guard == Guard::adapt) node.beta = std::min(node.beta, constants.rho / mu[last]);
  const double top = constants.rho * constants.limit29();
  if (constants.guard == Guard::clip && (mu[0] < floor || mu[last] > top)) {
    mu = mu.cwiseMax(floor).cwiseMin(top);
    node.Pp.noalias() = W * mu.asDiagonal() * W.transpose();
    symmetrise(node.Pp);
  }
  if (constants.guard == Guard::adapt) {
    const VecN limited = (constants.tau * mu).cwiseMin(1.0 / (1 + degree));
    node.C.noalias() = W * limited.asDiagonal() * W.transpose();
    node.c_norm = limited.cwiseAbs().maxCoeff();
  } else {
    node.C = constants.tau * node.Pp;
    node.c_norm = constants.tau * mu.cwiseAbs().maxCoeff();
  }
  const VecN inflated = mu.array() / (1 - node.beta * mu.array());
  node.M1.noalias() = W * inflated.asDiagonal() * W.transpose();
  symmetrise(node.M1);
  return node.M1.allFinite();
}

/// What a node got from its neighbours in this step.
template <int N>
struct Received {
  SmallMatrix<N, 1> pull;        ///< sum over links that delivered of (received - own prediction), heading wrapped: (7)
  SmallMatrix<N, N> neighbours;  ///< sum over all links of (1 - phi-bar) Pp_j
  double attack = 0;             ///< sum over all links of gamma-bar delta^2
  int delivered = 0;             ///< n_i
};

/// Steps 8 to 16: gain (30), estimate (7), bound (27). `node.innovation` holds z - h(xp) where `node.measured`; H is
/// the Jacobian there. Returns false where S cannot be inverted or the bound is not finite.
template <int N, int M>
bool update(Node<N, M>& node, const typename Node<N, M>::MatMN& H, const Received<N>& received,
            const Constants& constants, int degree) {
  using Types = Node<N, M>;
  const Multipliers m = multipliers(constants.bound, degree, node.c_norm);
  const auto n = node.x.size();
  typename Types::MatN B = -received.delivered * node.C;
  B.diagonal().array() += 1;

  typename Types::MatN G = B;
  node.x = node.xp;
  node.x.noalias() += node.C * received.pull;
  if (node.measured) {
    typename Types::MatNM MHt;
    MHt.noalias() = node.M1 * H.transpose();
    typename Types::MatM S;
    S.noalias() = H * MHt;
    S += node.VV / node.beta;
    node.innovation_bound = S + node.R;
    S += node.R / m.own;
    typename Types::MatNM BMHt;
    BMHt.noalias() = B * MHt;
    typename Types::MatNM K;
    const Eigen::LLT<typename Types::MatM> cholesky(S);
    if (cholesky.info() == Eigen::Success) {
      K = cholesky.solve(BMHt.transpose()).transpose();
    } else if (constants.guard == Guard::none) {  // S may be indefinite without a guard
      K = S.partialPivLu().solve(BMHt.transpose()).transpose();
    } else {
      return false;
    }
    node.x.noalias() += K * node.innovation;
    G.noalias() -= K * H;
    typename Types::MatM noise = node.VV * (m.own / node.beta) + node.R;
    node.Phi.noalias() = K * noise * K.transpose();
  } else {
    node.Phi.setZero(n, n);
  }
  typename Types::MatN GM;
  GM.noalias() = G * node.M1;
  node.Phi.noalias() += m.own * (GM * G.transpose());
  typename Types::MatN around = m.neighbour * received.neighbours;
  around.diagonal().array() += m.attack * received.attack;
  typename Types::MatN CA;
  CA.noalias() = node.C * around;
  node.Phi.noalias() += CA * node.C.transpose();
  symmetrise(node.Phi);
  return node.x.allFinite() && decompose(node);
}

}  // namespace vigil::consensus
