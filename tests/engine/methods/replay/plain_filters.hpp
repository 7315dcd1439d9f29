/// The estimators of the replay family again, from the specification (replay), sections 4 and 8: dense, in extended
/// precision, no shortcut of ours.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "engine/methods/replay/system.hpp"

namespace vigil::replay::plain {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

struct Model {
  Matrix A, B, C, P, R, Mw, Mv;
  explicit Model(const System& s);
  Eigen::Index n() const { return A.rows(); }
  Eigen::Index p() const { return C.rows(); }
};

/// From and to the precision of what is tested.
Vector real(const Eigen::VectorXd& v);
Eigen::MatrixXd rounded(const Matrix& M);

/// y - C x.
Vector residual(const Model& model, const Vector& y, const Vector& x);

/// The state that fits the last readings best, all weighed alike. y, u: oldest first, u_i acted before y_i.
Vector fitted(const Model& model, const std::vector<Vector>& y, const std::vector<Vector>& u);

struct Sets {
  Matrix Q, M;
};

/// Section 4.3: covariance and ellipsoid of the first estimate's error.
Sets first_sets(const Model& model);

/// One step of the mixed estimator with the optimum of sigma inside its range, by halving on the slope's sign.
struct Mixed {
  Vector x, predicted;
  Sets sets;
  Real zeta = 1;

  /// A tick without a reading.
  void coast(const Model& model, const Vector& u);
  void step(const Model& model, Real mu, const Vector& u, const Vector& y);

 private:
  static Matrix gain(const Model& model, Real mu, Real sigma, const Matrix& Qp, const Matrix& Mp);
  static std::pair<Real, Real> traces(const Model& model, const Matrix& K, const Matrix& Mp);
};

/// Section 8.1.
struct Gmee {
  Vector x;
  Matrix P;

  /// A tick without a reading.
  void coast(const Model& model, const Vector& u);
  void step(const Model& model, Real alpha, Real beta, bool square, const Vector& u, const Vector& y);

 private:
  static Matrix kernel(const Vector& e, Real alpha, Real beta, bool square);
};

}  // namespace vigil::replay::plain
