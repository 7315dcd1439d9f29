#include "engine/linalg/basis_pursuit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil {
namespace {

constexpr double kTolerance = 1e-9;
constexpr double kIndependent = 1e-12;     // squared, of a row beside the rows before it
constexpr double kStepShare = 0.9995;      // of the largest step that stays feasible
constexpr double kRegularisation = 1e-14;  // of the normal matrix's mean diagonal
constexpr double kGap = 1e-7;              // of ||e||_1
constexpr double kInfeasible = 1e-10;      // of ||e||_1; the rows have unit length

/// The largest step up to 1 that keeps x + step dx > 0.
double feasible_step(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
  double step = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (dx[i] < 0) step = std::min(step, -x[i] / dx[i]);
  }
  return std::min(1.0, kStepShare * step);
}

}  // namespace

BasisPursuit::BasisPursuit(int rows, int columns, int max_iterations)
    : entries_(Eigen::VectorXd::Zero(columns)),
      dual_(Eigen::VectorXd::Zero(rows)),
      rows_(rows, columns),
      gram_(rows),
      weighted_(rows, columns),
      normal_(rows, rows),
      cholesky_(rows),
      simplex_(rows, columns),
      max_iterations_(max_iterations) {
  for (auto* v : {&z_, &s_, &dz_, &ds_, &dual_gap_, &complementarity_, &ratio_}) v->resize(2 * columns);
  for (auto* v : {&lengths_, &right_, &y_, &dy_, &primal_, &row_scratch_}) v->resize(rows);
  for (auto* v : {&least_squares_, &column_scratch_}) v->resize(columns);
}

bool BasisPursuit::solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b) {
  by_simplex_ = false;
  iterations_ = 0;
  entries_.setZero();
  dual_.setZero();
  const bool fits = D.rows() == rows_.rows() && D.cols() == rows_.cols() && b.size() == D.rows() && b.size() > 0;
  if (!fits || !D.allFinite() || !b.allFinite() || !normalise(D, b)) return fail();
  if (size_ == 0) return true;
  const bool optimal = interior_point() && take_iterate();
  if (!optimal) {
    by_simplex_ = true;
    column_scratch_ = z_.head(rows_.cols()) - z_.tail(rows_.cols());
    const bool usable = column_scratch_.allFinite();
    if (!simplex_.solve(rows_, right_, usable ? column_scratch_ : least_squares_)) return fail();
    entries_ = simplex_.entries();
    dual_ = simplex_.dual();
    if (!certified()) return fail();
  }
  entries_ *= size_;
  dual_ = dual_.cwiseQuotient(lengths_);
  return entries_.allFinite() && dual_.allFinite() ? true : fail();
}

bool BasisPursuit::fail() {
  entries_.setZero();
  dual_.setZero();
  return false;
}

/// Rows of unit length, and b such that the least-squares solution's largest entry is 1 (size_ is 0 where b is). False
/// where the rows are dependent.
bool BasisPursuit::normalise(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b) {
  lengths_ = D.rowwise().norm();
  if (!(lengths_.minCoeff() > 0)) return false;
  rows_ = lengths_.asDiagonal().inverse() * D;
  right_ = b.cwiseQuotient(lengths_);
  normal_.noalias() = rows_ * rows_.transpose();
  gram_.compute(normal_);
  if (gram_.info() != Eigen::Success || gram_.matrixLLT().diagonal().cwiseAbs2().minCoeff() < kIndependent) {
    return false;
  }
  row_scratch_ = right_;
  gram_.solveInPlace(row_scratch_);
  least_squares_.noalias() = rows_.transpose() * row_scratch_;
  size_ = least_squares_.cwiseAbs().maxCoeff();
  if (size_ == 0) return true;
  right_ /= size_;
  least_squares_ /= size_;
  return std::isfinite(size_) && right_.allFinite() && least_squares_.allFinite();
}

void BasisPursuit::start() {
  const Eigen::Index n = rows_.cols();
  const double lift = std::max(0.1 * least_squares_.cwiseAbs().maxCoeff(), 1e-6);
  z_.head(n) = least_squares_.cwiseMax(0).array() + lift;
  z_.tail(n) = (-least_squares_).cwiseMax(0).array() + lift;
  y_.setZero();
  s_.setOnes();
}

bool BasisPursuit::interior_point() {
  start();
  for (; iterations_ < max_iterations_; ++iterations_) {
    if (converged()) return true;
    if (!factorise() || !advance()) return false;
  }
  return false;
}

/// Updates the residuals.
bool BasisPursuit::converged() {
  const Eigen::Index n = rows_.cols();
  column_scratch_ = z_.head(n) - z_.tail(n);
  primal_ = right_;
  primal_.noalias() -= rows_ * column_scratch_;
  column_scratch_.noalias() = rows_.transpose() * y_;
  dual_gap_.head(n) = 1 - column_scratch_.array() - s_.head(n).array();
  dual_gap_.tail(n) = 1 + column_scratch_.array() - s_.tail(n).array();
  complementarity_ = -z_.cwiseProduct(s_);
  return primal_.norm() <= kTolerance * (1 + right_.norm()) &&
         dual_gap_.norm() <= static_cast<double>(n) * kTolerance &&
         -complementarity_.sum() <= kTolerance * (1 + z_.sum());
}

/// The normal matrix D diag(u/s_u + v/s_v) D'.
bool BasisPursuit::factorise() {
  const Eigen::Index n = rows_.cols();
  ratio_ = z_.cwiseQuotient(s_);
  weighted_ = rows_ * (ratio_.head(n) + ratio_.tail(n)).asDiagonal();
  normal_.noalias() = weighted_ * rows_.transpose();
  const double mean = normal_.trace() / static_cast<double>(normal_.rows());
  normal_.diagonal().array() += kRegularisation * mean;
  cholesky_.compute(normal_);
  return cholesky_.info() == Eigen::Success;
}

/// The step that takes away the residuals, complementarity_ among them, to first order.
bool BasisPursuit::newton() {
  const Eigen::Index n = rows_.cols();
  dz_ = complementarity_.cwiseQuotient(s_) - ratio_.cwiseProduct(dual_gap_);  // but for the share of dy
  column_scratch_ = dz_.head(n) - dz_.tail(n);
  dy_ = primal_;
  dy_.noalias() -= rows_ * column_scratch_;
  cholesky_.solveInPlace(dy_);
  column_scratch_.noalias() = rows_.transpose() * dy_;
  dz_.head(n) += ratio_.head(n).cwiseProduct(column_scratch_);
  dz_.tail(n) -= ratio_.tail(n).cwiseProduct(column_scratch_);
  ds_.head(n) = dual_gap_.head(n) - column_scratch_;
  ds_.tail(n) = dual_gap_.tail(n) + column_scratch_;
  return dz_.allFinite() && ds_.allFinite();
}

/// The affine step, then Mehrotra's centring and second-order corrector in its light.
bool BasisPursuit::advance() {
  if (!newton()) return false;
  const double gap = z_.dot(s_);
  const double affine_primal = feasible_step(z_, dz_), affine_dual = feasible_step(s_, ds_);
  const double affine_gap = (z_ + affine_primal * dz_).dot(s_ + affine_dual * ds_);
  const double target = std::pow(affine_gap / gap, 3) * gap / static_cast<double>(z_.size());
  complementarity_ = target - z_.array() * s_.array() - dz_.array() * ds_.array();
  if (!newton()) return false;
  z_ += feasible_step(z_, dz_) * dz_;
  const double dual_step = feasible_step(s_, ds_);
  y_ += dual_step * dy_;
  s_ += dual_step * ds_;
  return true;
}

/// The last iterate as the answer: what the tolerance left of D e = b goes by the shortest way.
bool BasisPursuit::take_iterate() {
  const Eigen::Index n = rows_.cols();
  entries_ = z_.head(n) - z_.tail(n);
  dual_ = y_;
  row_scratch_ = right_;
  row_scratch_.noalias() -= rows_ * entries_;
  gram_.solveInPlace(row_scratch_);
  entries_.noalias() += rows_.transpose() * row_scratch_;
  return certified();
}

/// Weak duality: for any y with |D' y| <= 1, b' y is below the optimum. Brings dual_ within these bounds.
bool BasisPursuit::certified() {
  const double norm = entries_.lpNorm<1>();
  row_scratch_ = right_;
  row_scratch_.noalias() -= rows_ * entries_;
  column_scratch_.noalias() = rows_.transpose() * dual_;
  dual_ /= std::max(1.0, column_scratch_.cwiseAbs().maxCoeff());
  return row_scratch_.lpNorm<Eigen::Infinity>() <= kInfeasible * norm && norm - right_.dot(dual_) <= kGap * norm;
}

}  // namespace vigil
