#include "engine/methods/replay/batch.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <vector>

#include "engine/linalg/ellipsoid.hpp"

namespace vigil::replay {
namespace {

constexpr double kRank = 1e-12;  // of the largest pivot

/// Bx of the section: block (i, j) = A^(i-j) B for i >= j, `blocks` of them each way.
Eigen::MatrixXd carried(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Eigen::Index blocks) {
  const auto n = A.rows(), m = B.cols();
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n * blocks, m * blocks);
  Eigen::MatrixXd power = B;
  for (Eigen::Index lag = 0; lag < blocks; ++lag) {
    for (Eigen::Index j = 0; j + lag < blocks; ++j) whole.block((j + lag) * n, j * m, n, m) = power;
    power = (A * power).eval();
  }
  return whole;
}

/// blkdiag(C, .., C) X.
Eigen::MatrixXd seen(const Eigen::MatrixXd& C, const Eigen::MatrixXd& X) {
  const auto p = C.rows(), n = C.cols(), blocks = X.rows() / n;
  Eigen::MatrixXd rows(p * blocks, X.cols());
  for (Eigen::Index i = 0; i < blocks; ++i) rows.middleRows(i * p, p) = C * X.middleRows(i * n, n);
  return rows;
}

}  // namespace

std::optional<Batch> Batch::make(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C) {
  const auto n = A.rows(), p = C.rows();
  if (!A.allFinite() || !B.allFinite() || !C.allFinite()) return std::nullopt;
  Eigen::FullPivLU<Eigen::MatrixXd> of_a(A);
  of_a.setThreshold(kRank);
  if (!of_a.isInvertible()) return std::nullopt;
  const Eigen::MatrixXd back = of_a.inverse();
  Eigen::MatrixXd H(n * p, n);
  H.bottomRows(p) = C;
  for (auto i = n - 2; i >= 0; --i) H.middleRows(i * p, p) = H.middleRows((i + 1) * p, p) * back;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(n * p, n);
  qr.setThreshold(kRank);
  qr.compute(H);
  if (!H.allFinite() || qr.rank() < n) return std::nullopt;

  Batch batch;
  batch.GH_ = qr.solve(Eigen::MatrixXd::Identity(n * p, n * p));
  batch.G_ = batch.GH_ * batch.GH_.transpose();
  const Eigen::MatrixXd of_input = carried(A, B, n);
  const Eigen::MatrixXd of_process = carried(A, Eigen::MatrixXd::Identity(n, n), n);
  batch.of_input_ = of_input.bottomRows(n) - batch.GH_ * seen(C, of_input);
  batch.of_process_ = of_process.bottomRows(n) - batch.GH_ * seen(C, of_process);
  return batch;
}

BoundedVector Batch::estimate(const Eigen::Ref<const Eigen::MatrixXd>& Y,
                              const Eigen::Ref<const Eigen::MatrixXd>& U) const {
  const auto m = U.rows(), p = Y.rows();
  BoundedVector estimate = BoundedVector::Zero(G_.rows());
  for (Eigen::Index i = 0; i < G_.rows(); ++i) {
    estimate.noalias() += GH_.middleCols(i * p, p) * Y.col(i);
    estimate.noalias() += of_input_.middleCols(i * m, m) * U.col(i);
  }
  return estimate;
}

Bounds Batch::error(const Eigen::MatrixXd& P, const Eigen::MatrixXd& R, const Eigen::MatrixXd& Mw,
                    const Eigen::MatrixXd& Mv) const {
  const auto n = G_.rows(), p = GH_.cols() / n;
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(n, n);
  std::vector<Eigen::MatrixXd> ellipsoids;
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto T = of_process_.middleCols(j * n, n);
    const auto V = GH_.middleCols(j * p, p);
    Q += T * P * T.transpose() + V * R * V.transpose();
    ellipsoids.push_back(T * Mw * T.transpose());
    ellipsoids.push_back(V * Mv * V.transpose());
  }
  Bounds bounds{Q, minimum_trace_sum(ellipsoids)};
  symmetrise(bounds.Q);
  symmetrise(bounds.M);
  return bounds;
}

}  // namespace vigil::replay
