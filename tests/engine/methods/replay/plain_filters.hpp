/// The estimators of the replay family again, from the specification (replay), sections 4 and 8: dense, in extended
/// precision, no shortcut of ours.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "engine/methods/replay/system.hpp"

namespace vigil::replay::plain {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

struct Model {
  Matrix A, B, C, P, R, Mw, Mv;
  explicit Model(const System& s)
      : A(s.A.cast<Real>()),
        B(s.B.cast<Real>()),
        C(s.C.cast<Real>()),
        P(s.P.cast<Real>()),
        R(s.R.cast<Real>()),
        Mw(s.Mw.cast<Real>()),
        Mv(s.Mv.cast<Real>()) {}
  Eigen::Index n() const { return A.rows(); }
  Eigen::Index p() const { return C.rows(); }
};

inline Matrix least_trace(const std::vector<Matrix>& operands) {
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
    const Matrix back = model.A.inverse();
    H.resize(model.p() * count, model.n());
    for (int j = 1; j <= count; ++j) {
      Matrix power = Matrix::Identity(model.n(), model.n());
      for (int i = 0; i < count - j; ++i) power = back * power;
      H.middleRows((j - 1) * model.p(), model.p()) = model.C * power;
      // x_j = A^-(N-j) x_N - sum_{i > j} A^(j-i) f_i
      Matrix row = Matrix::Zero(model.p(), model.n() * count);
      Matrix lag = Matrix::Identity(model.n(), model.n());
      for (int i = j + 1; i <= count; ++i) {
        lag = back * lag;
        row.middleCols((i - 1) * model.n(), model.n()) = -model.C * lag;
      }
      forced.push_back(row);
    }
  }
  /// G H': from stacked readings to the state.
  Matrix fit() const { return (H.transpose() * H).inverse() * H.transpose(); }
};

/// The state that fits the last readings best, all weighed alike. y, u: oldest first, u_i acted before y_i.
inline Vector fitted(const Model& model, const std::vector<Vector>& y, const std::vector<Vector>& u) {
  const auto count = static_cast<int>(y.size());
  const Stack stack(model, count);
  Vector Y(model.p() * count), f(model.n() * count);
  for (int i = 0; i < count; ++i) f.segment(i * model.n(), model.n()) = model.B * u[static_cast<std::size_t>(i)];
  for (int j = 0; j < count; ++j) {
    const auto place = static_cast<std::size_t>(j);
    Y.segment(j * model.p(), model.p()) = y[place] - stack.forced[place] * f;
  }
  return stack.H.colPivHouseholderQr().solve(Y);
}

struct Sets {
  Matrix Q, M;
};

/// Section 4.3: covariance and ellipsoid of the first estimate's error.
inline Sets first_sets(const Model& model) {
  const auto count = static_cast<int>(model.n());
  const Stack stack(model, count);
  const Matrix fit = stack.fit();
  Sets sets{Matrix::Zero(model.n(), model.n()), {}};
  std::vector<Matrix> bounded;
  for (int i = 0; i < count; ++i) {
    Matrix T = Matrix::Zero(model.n(), model.n());
    for (int j = 0; j < count; ++j)
      T += fit.middleCols(j * model.p(), model.p()) *
           stack.forced[static_cast<std::size_t>(j)].middleCols(i * model.n(), model.n());
    const Matrix V = fit.middleCols(i * model.p(), model.p());
    sets.Q += T * model.P * T.transpose() + V * model.R * V.transpose();
    bounded.push_back(T * model.Mw * T.transpose());
    bounded.push_back(V * model.Mv * V.transpose());
  }
  sets.M = least_trace(bounded);
  return sets;
}

/// One step of the mixed estimator with the optimum of sigma inside its range, by halving on the slope's sign.
struct Mixed {
  Vector x, predicted;
  Sets sets;
  Real zeta = 1;

  void step(const Model& model, Real mu, const Vector& u, const Vector& y) {
    predicted = model.A * x + model.B * u;
    const Matrix Qp = model.A * sets.Q * model.A.transpose() + model.P;
    const Matrix Mp = least_trace({model.A * sets.M * model.A.transpose(), model.Mw});
    Real low = 1e-9L, high = 1 - 1e-9L;
    for (int halving = 0; halving < 200; ++halving) {
      const Real sigma = (low + high) / 2;
      const auto [prediction, sensor] = traces(model, gain(model, mu, sigma, Qp, Mp), Mp);
      (sensor / ((1 - sigma) * (1 - sigma)) < prediction / (sigma * sigma) ? low : high) = sigma;
    }
    const Real sigma = (low + high) / 2;
    const Matrix K = gain(model, mu, sigma, Qp, Mp), X = Matrix::Identity(model.n(), model.n()) - K * model.C;
    zeta = (1 - sigma) / sigma;
    x = predicted + K * (y - model.C * predicted);
    sets.Q = X * Qp * X.transpose() + K * model.R * K.transpose();
    sets.M = X * Mp * X.transpose() / sigma + K * model.Mv * K.transpose() / (1 - sigma);
  }

 private:
  static Matrix gain(const Model& model, Real mu, Real sigma, const Matrix& Qp, const Matrix& Mp) {
    const Matrix W = mu * Qp + (1 - mu) / sigma * Mp, S = mu * model.R + (1 - mu) / (1 - sigma) * model.Mv;
    return W * model.C.transpose() * (model.C * W * model.C.transpose() + S).inverse();
  }
  static std::pair<Real, Real> traces(const Model& model, const Matrix& K, const Matrix& Mp) {
    const Matrix X = Matrix::Identity(model.n(), model.n()) - K * model.C;
    return {(X * Mp * X.transpose()).trace(), (K * model.Mv * K.transpose()).trace()};
  }
};

/// Section 8.1.
struct Gmee {
  Vector x;
  Matrix P;

  void step(const Model& model, Real alpha, Real beta, bool square, const Vector& u, const Vector& y) {
    const auto n = model.n(), p = model.p();
    const Vector predicted = model.A * x + model.B * u;
    const Matrix Pp = model.A * P * model.A.transpose() + model.P;
    Matrix theta = Matrix::Zero(n + p, n + p), both(n + p, n);
    theta.topLeftCorner(n, n) = Matrix(Pp.llt().matrixL());
    theta.bottomRightCorner(p, p) = Matrix(model.R.llt().matrixL());
    both << Matrix::Identity(n, n), model.C;
    Vector stacked(n + p);
    stacked << predicted, y;
    const Vector d = theta.inverse() * stacked;
    const Matrix Wt = theta.inverse() * both;
    x = predicted;
    Matrix K;
    for (int iteration = 0; iteration < 50; ++iteration) {
      const Matrix weights = kernel(d - Wt * x, alpha, beta, square);
      Matrix Om = Wt.transpose() * weights * Wt;
      Om += 1e-12L * Om.trace() * Matrix::Identity(n, n);
      K = Om.inverse() * (Wt.transpose() * weights).rightCols(p) * Matrix(model.R.llt().matrixL()).inverse();
      const Vector next = predicted + K * (y - model.C * predicted);
      const Real moved = (next - x).norm();
      const Real size = std::max(x.norm(), Real(1e-12L));
      x = next;
      if (moved <= 1e-6L * size) break;
    }
    const Matrix X = Matrix::Identity(n, n) - K * model.C;
    P = X * Pp * X.transpose() + K * model.R * K.transpose();
  }

 private:
  static Matrix kernel(const Vector& e, Real alpha, Real beta, bool square) {
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
    return square ? Matrix(psi.transpose() * psi + phi.transpose() * phi) : Matrix(psi - phi);
  }
};

}  // namespace vigil::replay::plain
