#include "engine/linalg/covariance.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "engine/core/describe.hpp"
#include "engine/core/params.hpp"

namespace vigil {

namespace {

/// "R is [[..],..] and <why>; expected a symmetric positive … matrix", named as the pointer's end.
[[noreturn]] void refuse(const Eigen::MatrixXd& matrix, const std::string& pointer, const std::string& why,
                         Definiteness kind) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    rows.push_back(Json::array());
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) rows.back().push_back(matrix(r, c));
  }
  const std::string expected =
      std::string("a symmetric positive ") + (kind == Definiteness::definite ? "definite" : "semidefinite") + " matrix";
  throw InputError(
      pointer,
      fmt::format("{} is {} and {}; expected {}", pointer.substr(pointer.rfind('/') + 1), shown(rows), why, expected),
      expected);
}

}  // namespace

void check_covariance(const Eigen::MatrixXd& matrix, const std::string& pointer, Definiteness kind) {
  const double size = matrix.cwiseAbs().maxCoeff();
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size)
    refuse(matrix, pointer, "is not symmetric", kind);
  const double smallest = least_eigenvalue(matrix);
  if (smallest < -1e-12 * size)
    refuse(matrix, pointer, fmt::format("has the negative eigenvalue {:.6g}", smallest), kind);
  if (kind == Definiteness::definite && smallest <= 0) refuse(matrix, pointer, "is not positive definite", kind);
}

Eigen::MatrixXd read_covariance(const Json& value, int n, const std::string& pointer, Definiteness kind) {
  Eigen::MatrixXd matrix = square_matrix(value, n, pointer);
  check_covariance(matrix, pointer, kind);
  return 0.5 * (matrix + matrix.transpose());
}

double least_eigenvalue(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
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
