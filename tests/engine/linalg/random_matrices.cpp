#include "tests/engine/linalg/random_matrices.hpp"

namespace vigil {

Eigen::MatrixXd RandomMatrices::gaussian(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(); });
}

Eigen::VectorXd RandomMatrices::vector(Eigen::Index size) { return gaussian(size, 1); }

Eigen::MatrixXd RandomMatrices::orthogonal(Eigen::Index n) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(gaussian(n, n)).householderQ();
}

Eigen::MatrixXd RandomMatrices::semidefinite(Eigen::Index n, Eigen::Index rank) {
  const Eigen::MatrixXd V = orthogonal(n).leftCols(rank);
  const Eigen::VectorXd sizes = Eigen::VectorXd::NullaryExpr(rank, [&] { return log_uniform(0.1, 10); });
  const Eigen::MatrixXd M = V * sizes.asDiagonal() * V.transpose();
  return 0.5 * (M + M.transpose());
}

Eigen::MatrixXd RandomMatrices::definite(Eigen::Index n) { return semidefinite(n, n); }

}  // namespace vigil
