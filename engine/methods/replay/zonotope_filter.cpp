#include "engine/methods/replay/zonotope_filter.hpp"

#include <Eigen/Cholesky>

#include "engine/linalg/zonotope.hpp"

namespace vigil::replay {
namespace {

constexpr double kSingular = 4e-15;  // a pivot below this share of its diagonal entry is rounding

/// The tight box around {x' M^-1 x <= 1}.
Eigen::MatrixXd box(const Eigen::MatrixXd& M) { return M.diagonal().cwiseMax(0).cwiseSqrt().asDiagonal(); }

}  // namespace

std::optional<ZonotopeSchedule> ZonotopeSchedule::make(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                                                       const Eigen::MatrixXd& Mw, const Eigen::MatrixXd& Mv, int order,
                                                       int steps) {
  ZonotopeSchedule schedule;
  schedule.A_ = A;
  schedule.C_ = C;
  schedule.Hw_ = box(Mw);
  schedule.Hv_ = box(Mv);
  schedule.order_ = order;
  schedule.H_ = schedule.Hw_;
  schedule.half_widths_ = Eigen::VectorXd::Zero(C.rows());
  ZonotopeSchedule ahead = schedule;
  for (int step = 0; step < steps; ++step) {
    if (!ahead.advance()) return std::nullopt;
  }
  if (steps > 0) schedule.half_widths_ = vigil::half_widths(ahead.Z_);
  return schedule;
}

bool ZonotopeSchedule::predict() {
  const auto n = A_.rows(), p = C_.rows();
  Eigen::MatrixXd predicted(n, H_.cols() + n), healthy(p, H_.cols() + n + p);
  predicted << A_ * H_, Hw_;
  healthy << C_ * predicted, Hv_;
  const Eigen::LLT<Eigen::MatrixXd> factor(healthy * healthy.transpose());  // C Pz C' + Hv Hv'
  if (factor.info() != Eigen::Success) return false;
  for (Eigen::Index i = 0; i < p; ++i) {
    const double pivot = factor.matrixLLT()(i, i);
    if (!(pivot * pivot > kSingular * healthy.row(i).squaredNorm())) return false;
  }
  K_ = factor.solve(C_ * predicted * predicted.transpose()).transpose();
  predicted_ = std::move(predicted);
  Z_ = std::move(healthy);
  return true;
}

bool ZonotopeSchedule::advance() {
  if (!predict()) return false;
  const auto n = A_.rows(), p = C_.rows();
  Eigen::MatrixXd corrected(n, predicted_.cols() + p);
  corrected << (Eigen::MatrixXd::Identity(n, n) - K_ * C_) * predicted_, K_ * Hv_;
  H_ = reduce(corrected, order_);
  return true;
}

bool ZonotopeSchedule::advance_unheard() {
  if (!predict()) return false;
  H_ = reduce(predicted_, order_);
  return true;
}

}  // namespace vigil::replay
