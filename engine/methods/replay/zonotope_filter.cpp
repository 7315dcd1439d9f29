#include "engine/methods/replay/zonotope_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

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
  const auto n = A.rows(), p = C.rows(), most = std::max<Eigen::Index>(order, n);
  ZonotopeSchedule schedule;
  schedule.A_ = A;
  schedule.C_ = C;
  schedule.Hw_ = box(Mw);
  schedule.Hv_ = box(Mv);
  schedule.order_ = order;
  schedule.H_ = Eigen::MatrixXd::Zero(n, most);
  schedule.H_.leftCols(n) = schedule.Hw_;
  schedule.generators_ = n;
  schedule.predicted_ = Eigen::MatrixXd::Zero(n, most + n);
  schedule.corrected_ = Eigen::MatrixXd::Zero(n, most + n + p);
  schedule.Z_ = Eigen::MatrixXd::Zero(p, most + n + p);
  schedule.places_.resize(static_cast<std::size_t>(most + n + p));
  schedule.half_widths_ = Eigen::VectorXd::Zero(p);
  ZonotopeSchedule ahead = schedule;
  for (int step = 0; step < steps; ++step) {
    if (!ahead.advance()) return std::nullopt;
  }
  if (steps > 0) schedule.half_widths_ = vigil::half_widths(ahead.Z());
  return schedule;
}

/// [A H, Hw], Z and K of the step. Where it fails neither Z nor K is new.
bool ZonotopeSchedule::predict() {
  const auto n = A_.rows(), p = C_.rows(), count = generators_ + n;
  auto predicted = predicted_.leftCols(count);
  predicted.leftCols(generators_).noalias() = A_ * H_.leftCols(generators_);
  predicted.rightCols(n) = Hw_;
  BoundedMatrix Pz(n, n), CPz(p, n), S(p, p);
  Pz.noalias() = predicted * predicted.transpose();
  CPz.noalias() = C_ * Pz;
  S.noalias() = CPz * C_.transpose();
  S.diagonal() += Hv_.diagonal().cwiseAbs2();
  const Eigen::LLT<BoundedMatrix> factor(S);
  if (factor.info() != Eigen::Success) return false;
  for (Eigen::Index i = 0; i < p; ++i) {
    const double pivot = factor.matrixLLT()(i, i);
    if (!(pivot * pivot > kSingular * S(i, i))) return false;
  }
  K_ = factor.solve(CPz).transpose();
  healthy_ = count + p;
  Z_.leftCols(count).noalias() = C_ * predicted;
  Z_.middleCols(count, p) = Hv_;
  return true;
}

bool ZonotopeSchedule::advance() {
  if (!predict()) return false;
  const auto n = A_.rows(), p = C_.rows(), count = generators_ + n;
  const BoundedMatrix X = BoundedMatrix::Identity(n, n) - K_ * C_;
  corrected_.leftCols(count).noalias() = X * predicted_.leftCols(count);
  corrected_.middleCols(count, p).noalias() = K_ * Hv_;
  generators_ = reduce(corrected_.leftCols(count + p), order_, H_, places_);
  return true;
}

bool ZonotopeSchedule::advance_unheard() {
  if (!predict()) return false;
  generators_ = reduce(predicted_.leftCols(generators_ + A_.rows()), order_, H_, places_);
  return true;
}

}  // namespace vigil::replay
