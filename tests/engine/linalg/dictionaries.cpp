#include "tests/engine/linalg/dictionaries.hpp"

namespace vigil::dictionaries {

Eigen::MatrixXd Trial::gaussian(int rows, int columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(); });
}

Eigen::VectorXd Trial::sparse(int columns, int count, double least, double most) {
  Eigen::VectorXd e = Eigen::VectorXd::Zero(columns);
  for (int placed = 0; placed < count;) {
    double& entry = e[below(columns)];
    if (entry != 0) continue;
    entry = (uniform() < 0.5 ? -1 : 1) * least * std::pow(most / least, uniform());
    ++placed;
  }
  return e;
}

Eigen::MatrixXd Trial::orthonormal(int columns, int states) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(gaussian(columns, states));
  const Eigen::MatrixXd Q = qr.householderQ();
  return Q.rightCols(columns - states).transpose();
}

Eigen::MatrixXd hadamard(int power) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Ones(1, 1);
  for (int i = 0; i < power; ++i) {
    Eigen::MatrixXd twice(2 * H.rows(), 2 * H.rows());
    twice << H, H, H, -H;
    H = twice / std::sqrt(2.0);
  }
  return H;
}

double coherence(const Eigen::MatrixXd& D) {
  Eigen::MatrixXd gram = D.colwise().normalized().transpose() * D.colwise().normalized();
  gram.diagonal().setZero();
  return gram.cwiseAbs().maxCoeff();
}

}  // namespace vigil::dictionaries
