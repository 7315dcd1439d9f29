/// Random dictionaries and signals for the sparse solvers' tests.
#pragma once

#include <Eigen/QR>
#include <cmath>
#include <cstdint>

#include "engine/random/draws.hpp"

namespace vigil::dictionaries {

/// Everything of a trial from one number.
class Trial {
 public:
  explicit Trial(std::int64_t number) : draws_(1, "dictionaries"), number_(number) {}

  double uniform() { return draws_.uniform(number_, next_++); }
  double normal() { return draws_.normal(number_, next_++); }
  int below(int count) { return static_cast<int>(uniform() * count); }

  Eigen::MatrixXd gaussian(int rows, int columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(); });
  }

  /// `count` entries that are not zero, of either sign, between `least` and `most` in size (log-uniform).
  Eigen::VectorXd sparse(int columns, int count, double least, double most) {
    Eigen::VectorXd e = Eigen::VectorXd::Zero(columns);
    for (int placed = 0; placed < count;) {
      double& entry = e[below(columns)];
      if (entry != 0) continue;
      entry = (uniform() < 0.5 ? -1 : 1) * least * std::pow(most / least, uniform());
      ++placed;
    }
    return e;
  }

  /// Q2' of a random regression of `columns` readings on `states` unknowns: rows are orthonormal. Specification,
  /// section 7.
  Eigen::MatrixXd orthonormal(int columns, int states) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(gaussian(columns, states));
    const Eigen::MatrixXd Q = qr.householderQ();
    return Q.rightCols(columns - states).transpose();
  }

 private:
  Draws draws_;
  std::int64_t number_;
  std::uint32_t next_ = 0;
};

/// Sylvester's matrix of the order 2^power, its columns of unit length.
inline Eigen::MatrixXd hadamard(int power) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Ones(1, 1);
  for (int i = 0; i < power; ++i) {
    Eigen::MatrixXd twice(2 * H.rows(), 2 * H.rows());
    twice << H, H, H, -H;
    H = twice / std::sqrt(2.0);
  }
  return H;
}

/// The largest |cosine| between two columns.
inline double coherence(const Eigen::MatrixXd& D) {
  Eigen::MatrixXd gram = D.colwise().normalized().transpose() * D.colwise().normalized();
  gram.diagonal().setZero();
  return gram.cwiseAbs().maxCoeff();
}

}  // namespace vigil::dictionaries
