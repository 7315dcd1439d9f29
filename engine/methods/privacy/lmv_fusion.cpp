#include "engine/methods/privacy/lmv_fusion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "engine/linalg/small.hpp"
#include "engine/methods/privacy/model.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr double kSingular = 1e-10;  // of the largest eigenvalue

bool regular(const MatrixXd& P) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(P, Eigen::EigenvaluesOnly);
  const auto& values = eigen.eigenvalues();
  return values[0] > kSingular * values[values.size() - 1];
}

}  // namespace

MatrixXd symmetric_pseudo_inverse(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(matrix);
  const double least = kSingular * eigen.eigenvalues().cwiseAbs().maxCoeff();
  const Eigen::VectorXd inverse =
      eigen.eigenvalues().unaryExpr([least](double value) { return value > least ? 1 / value : 0.0; });
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

Fusion fuse(const MatrixXd& P, int n) {
  const MatrixXd e = stack(n, static_cast<int>(P.rows()) / n);
  Fusion fusion;
  fusion.by_rule = !regular(P);
  MatrixXd information;  // e' P^-1, or e' M^+
  if (fusion.by_rule) {
    const double trace = P.trace();
    const double weight = trace > 0 ? trace / static_cast<double>(P.rows()) : 1;
    information = e.transpose() * symmetric_pseudo_inverse(P + weight * e * e.transpose());
  } else {
    information = P.llt().solve(e).transpose();
  }
  fusion.W = (information * e).llt().solve(information);
  fusion.P = fusion.W * P * fusion.W.transpose();
  symmetrise(fusion.P);
  return fusion;
}

}  // namespace vigil::privacy
