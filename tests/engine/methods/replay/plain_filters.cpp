#include "tests/engine/methods/replay/plain_filters.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace vigil::replay::plain {
namespace {

// Few kinds of expression: each costs seconds to compile in this precision.

Matrix product(const Matrix& X, const Matrix& Y) { return X * Y; }

/// X M X'.
Matrix sandwich(const Matrix& X, const Matrix& M) { return product(product(X, M), X.transpose()); }

Matrix inverse(const Matrix& M) { return M.inverse(); }

/// The lower Cholesky factor.
Matrix root(const Matrix& M) { return M.llt().matrixL(); }

Vector applied(const Matrix& X, const Vector& v) { return X * v; }

/// A x + B u.
Vector ahead(const Model& model, const Vector& x, const Vector& u) { return applied(model.A, x) + applied(model.B, u); }

/// I - K C.
Matrix remaining(const Matrix& K, const Matrix& C) { return Matrix::Identity(K.rows(), K.rows()) - product(K, C); }

Matrix least_trace(const std::vector<Matrix>& operands) {
  Matrix sum = Matrix::Zero(operands[0].rows(), operands[0].cols());
  Real reach = 0;
  for (const Matrix& E : operands) {
    if (!(E.trace() > 1e-30L)) continue;
    reach += std::sqrt(E.trace());
    sum += E / std::sqrt(E.trace());
  }
  return reach * sum;
}

/// The readings y_1..y_N as linear in the last state: y_j = C A^-(N-j) (x_N - what acted after j).
struct Stack {
  Matrix H;                    ///< pN x n
  std::vector<Matrix> forced;  ///< of each reading: what acted at i (column block i = 1..N) moved x_N by A^(N-i)

  Stack(const Model& model, int count) {
    const Matrix back = inverse(model.A);
    H.resize(model.p() * count, model.n());
    for (int j = 1; j <= count; ++j) {
      Matrix power = Matrix::Identity(model.n(), model.n());
      for (int i = 0; i < count - j; ++i) power = product(back, power);
      H.middleRows((j - 1) * model.p(), model.p()) = product(model.C, power);
      // x_j = A^-(N-j) x_N - sum_{i > j} A^(j-i) f_i
      Matrix row = Matrix::Zero(model.p(), model.n() * count);
      Matrix lag = Matrix::Identity(model.n(), model.n());
      for (int i = j + 1; i <= count; ++i) {
        lag = product(back, lag);
        row.middleCols((i - 1) * model.n(), model.n()) = -product(model.C, lag);
      }
      forced.push_back(row);
    }
  }
  /// G H': from stacked readings to the state.
  Matrix fit() const { return product(inverse(product(H.transpose(), H)), H.transpose()); }
};

}  // namespace

Model::Model(const System& s)
    : A(s.A.cast<Real>()),
      B(s.B.cast<Real>()),
      C(s.C.cast<Real>()),
      P(s.P.cast<Real>()),
      R(s.R.cast<Real>()),
      Mw(s.Mw.cast<Real>()),
      Mv(s.Mv.cast<Real>()) {}

Vector real(const Eigen::VectorXd& v) { return v.cast<Real>(); }

Eigen::MatrixXd rounded(const Matrix& M) { return M.cast<double>(); }

Vector residual(const Model& model, const Vector& y, const Vector& x) { return y - applied(model.C, x); }

Vector fitted(const Model& model, const std::vector<Vector>& y, const std::vector<Vector>& u) {
  const auto count = static_cast<int>(y.size());
  const Stack stack(model, count);
  Vector Y(model.p() * count), f(model.n() * count);
  for (int i = 0; i < count; ++i)
    f.segment(i * model.n(), model.n()) = applied(model.B, u[static_cast<std::size_t>(i)]);
  for (int j = 0; j < count; ++j) {
    const auto place = static_cast<std::size_t>(j);
    Y.segment(j * model.p(), model.p()) = y[place] - applied(stack.forced[place], f);
  }
  return stack.H.colPivHouseholderQr().solve(Y);
}

void Mixed::coast(const Model& model, const Vector& u) {
  x = ahead(model, x, u);
  sets.Q = sandwich(model.A, sets.Q) + model.P;
  sets.M = least_trace({sandwich(model.A, sets.M), model.Mw});
}

void Mixed::step(const Model& model, Real mu, const Vector& u, const Vector& y) {
  predicted = ahead(model, x, u);
  const Matrix Qp = sandwich(model.A, sets.Q) + model.P;
  const Matrix Mp = least_trace({sandwich(model.A, sets.M), model.Mw});
  Real low = 1e-9L, high = 1 - 1e-9L;
  for (int halving = 0; halving < 200; ++halving) {
    const Real sigma = (low + high) / 2;
    const auto [prediction, sensor] = traces(model, gain(model, mu, sigma, Qp, Mp), Mp);
    (sensor / ((1 - sigma) * (1 - sigma)) < prediction / (sigma * sigma) ? low : high) = sigma;
  }
  const Real sigma = (low + high) / 2;
  const Matrix K = gain(model, mu, sigma, Qp, Mp), X = remaining(K, model.C);
  zeta = (1 - sigma) / sigma;
  x = predicted + applied(K, residual(model, y, predicted));
  sets.Q = sandwich(X, Qp) + sandwich(K, model.R);
  sets.M = sandwich(X, Mp) / sigma + sandwich(K, model.Mv) / (1 - sigma);
}

Matrix Mixed::gain(const Model& model, Real mu, Real sigma, const Matrix& Qp, const Matrix& Mp) {
  const Matrix W = mu * Qp + (1 - mu) / sigma * Mp, S = mu * model.R + (1 - mu) / (1 - sigma) * model.Mv;
  return product(product(W, model.C.transpose()), inverse(sandwich(model.C, W) + S));
}

std::pair<Real, Real> Mixed::traces(const Model& model, const Matrix& K, const Matrix& Mp) {
  const Matrix X = remaining(K, model.C);
  return {sandwich(X, Mp).trace(), sandwich(K, model.Mv).trace()};
}

Sets first_sets(const Model& model) {
  const auto count = static_cast<int>(model.n());
  const Stack stack(model, count);
  const Matrix fit = stack.fit();
  Sets sets{Matrix::Zero(model.n(), model.n()), {}};
  std::vector<Matrix> bounded;
  for (int i = 0; i < count; ++i) {
    Matrix T = Matrix::Zero(model.n(), model.n());
    for (int j = 0; j < count; ++j)
      T += product(fit.middleCols(j * model.p(), model.p()),
                   stack.forced[static_cast<std::size_t>(j)].middleCols(i * model.n(), model.n()));
    const Matrix V = fit.middleCols(i * model.p(), model.p());
    sets.Q += sandwich(T, model.P) + sandwich(V, model.R);
    bounded.push_back(sandwich(T, model.Mw));
    bounded.push_back(sandwich(V, model.Mv));
  }
  sets.M = least_trace(bounded);
  return sets;
}

void Gmee::coast(const Model& model, const Vector& u) {
  x = ahead(model, x, u);
  P = sandwich(model.A, P) + model.P;
}

void Gmee::step(const Model& model, Real alpha, Real beta, bool square, const Vector& u, const Vector& y) {
  const auto n = model.n(), p = model.p();
  const Vector predicted = ahead(model, x, u);
  const Matrix Pp = sandwich(model.A, P) + model.P;
  Matrix theta = Matrix::Zero(n + p, n + p), both(n + p, n);
  theta.topLeftCorner(n, n) = root(Pp);
  theta.bottomRightCorner(p, p) = root(model.R);
  both << Matrix::Identity(n, n), model.C;
  Vector stacked(n + p);
  stacked << predicted, y;
  const Vector d = applied(inverse(theta), stacked);
  const Matrix Wt = product(inverse(theta), both);
  x = predicted;
  Matrix K;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Matrix weights = kernel(d - applied(Wt, x), alpha, beta, square);
    const Matrix weighted = product(Wt.transpose(), weights);
    Matrix Om = product(weighted, Wt);
    Om += 1e-12L * Om.trace() * Matrix::Identity(n, n);
    K = product(product(inverse(Om), weighted.rightCols(p)), inverse(root(model.R)));
    const Vector next = predicted + applied(K, residual(model, y, predicted));
    const Real moved = (next - x).norm();
    const Real size = std::max(x.norm(), Real(1e-12L));
    x = next;
    if (moved <= 1e-6L * size) break;
  }
  const Matrix X = remaining(K, model.C);
  P = sandwich(X, Pp) + sandwich(K, model.R);
}

Matrix Gmee::kernel(const Vector& e, Real alpha, Real beta, bool square) {
  Matrix phi(e.size(), e.size());
  for (Eigen::Index i = 0; i < e.size(); ++i) {
    for (Eigen::Index j = 0; j < e.size(); ++j) {
      const Real apart = std::max(std::abs(e[i] - e[j]), alpha == 2 ? Real(0) : Real(1e-6L));
      phi(i, j) = std::pow(apart, alpha - 2) * std::exp(-std::pow(apart / beta, alpha));
      if (i == j) phi(i, j) = alpha == 2 ? 1 : 0;
    }
  }
  if (!square) phi.diagonal().setZero();
  const Matrix psi = phi.rowwise().sum().asDiagonal();
  return square ? Matrix(product(psi.transpose(), psi) + product(phi.transpose(), phi)) : Matrix(psi - phi);
}

}  // namespace vigil::replay::plain
