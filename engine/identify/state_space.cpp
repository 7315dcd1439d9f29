#include "engine/identify/state_space.hpp"

#include <Eigen/Eigenvalues>
#include <vector>

namespace vigil::identify {
namespace {

/// Rows without a missing cell.
Eigen::MatrixXd complete_rows(const Eigen::MatrixXd& rows) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    if (rows.row(k).allFinite()) kept.push_back(k);
  }
  return rows(kept, Eigen::all);
}

Eigen::MatrixXd second_moment(const Eigen::MatrixXd& rows) {
  return rows.transpose() * rows / static_cast<double>(rows.rows());
}

/// The nearest semidefinite matrix in Frobenius norm.
Eigen::MatrixXd semidefinite(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(symmetric);
  const Eigen::VectorXd kept = spectrum.eigenvalues().cwiseMax(0);
  const Eigen::MatrixXd result = spectrum.eigenvectors() * kept.asDiagonal() * spectrum.eigenvectors().transpose();
  return 0.5 * (result + result.transpose());
}

}  // namespace

StateSpace state_space(const Arx& model, const Records& records, const Eigen::MatrixXd& residuals,
                       double reading_share) {
  const Eigen::Index n = records.outputs.cols(), order = model.order(), states = n * order;
  StateSpace result;
  result.A = companion(model.A);
  result.B = Eigen::MatrixXd::Zero(states, model.B.cols() + 1);
  result.B.topLeftCorner(n, model.B.cols()) = model.B;
  result.B.topRightCorner(n, 1) = model.c;
  result.C = Eigen::MatrixXd::Identity(n, states);
  const Eigen::MatrixXd S = second_moment(complete_rows(residuals));
  const double least = 1e-12 * S.diagonal().maxCoeff();
  result.R = (reading_share * S.diagonal().array()).max(least > 0 ? least : 1e-12);
  Eigen::MatrixXd noise = S;
  noise.diagonal() -= result.R;
  for (const Eigen::MatrixXd& A : model.A) noise -= A * result.R.asDiagonal() * A.transpose();
  result.Q = Eigen::MatrixXd::Zero(states, states);
  result.Q.topLeftCorner(n, n) = semidefinite(noise);
  const Eigen::Index rows = records.outputs.rows() - order + 1;
  Eigen::MatrixXd past(rows, states);
  for (Eigen::Index i = 0; i < order; ++i) past.middleCols(i * n, n) = records.outputs.middleRows(order - 1 - i, rows);
  past = complete_rows(past);
  result.mean = past.colwise().mean().transpose();
  result.P0 = semidefinite(second_moment(past.rowwise() - result.mean.transpose()));
  return result;
}

}  // namespace vigil::identify
