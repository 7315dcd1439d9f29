#include "engine/linalg/covariance.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "engine/core/params.hpp"

namespace vigil {

void check_covariance(const Eigen::MatrixXd& matrix, const std::string& pointer, Definiteness kind) {
  const double size = matrix.cwiseAbs().maxCoeff();
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size) {
    throw InputError(pointer, "the matrix is not symmetric; a covariance is");
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix, Eigen::EigenvaluesOnly);
  const double smallest = eigen.eigenvalues()[0];
  if (kind == Definiteness::definite && smallest <= 0) {
    throw InputError(pointer,
                     fmt::format("the smallest eigenvalue is {:.6g}; the matrix must be positive definite", smallest),
                     "> 0");
  }
  if (smallest < -1e-12 * size) {
    throw InputError(
        pointer, fmt::format("the smallest eigenvalue is {:.6g}; a covariance has none below zero", smallest), ">= 0");
  }
}

Eigen::MatrixXd read_covariance(const Json& value, int n, const std::string& pointer, Definiteness kind) {
  Eigen::MatrixXd matrix = square_matrix(value, n, pointer);
  check_covariance(matrix, pointer, kind);
  return 0.5 * (matrix + matrix.transpose());
}

Eigen::MatrixXd symmetric_root(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  const Eigen::VectorXd roots = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  return eigen.eigenvectors() * roots.asDiagonal() * eigen.eigenvectors().transpose();
}

Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& matrix) {
  const Eigen::Index n = matrix.rows();
  const double least = 1e-14 * matrix.cwiseAbs().maxCoeff();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index c = 0; c < n; ++c) {
    const double pivot = matrix(c, c) - L.row(c).head(c).squaredNorm();
    if (pivot <= least) continue;
    L(c, c) = std::sqrt(pivot);
    for (Eigen::Index r = c + 1; r < n; ++r)
      L(r, c) = (matrix(r, c) - L.row(r).head(c).dot(L.row(c).head(c))) / L(c, c);
  }
  return L;
}

}  // namespace vigil
