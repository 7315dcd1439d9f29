#include "engine/linalg/basis_pursuit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vigil {
namespace {

constexpr double kTolerance = 1e-9;
constexpr int kMaxPivots = 500;
constexpr double kStepShare = 0.9995;  // of the largest step that stays feasible

/// The largest step in (0, 1] that keeps x + step dx >= 0, with a margin.
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
      normal_(rows, rows),
      scaled_(rows, columns),
      cholesky_(rows),
      basis_matrix_(rows, rows),
      reduced_(rows, columns),
      lu_(rows),
      basis_(static_cast<std::size_t>(rows)),
      order_(static_cast<std::size_t>(columns)),
      in_basis_(static_cast<std::size_t>(columns)),
      max_iterations_(max_iterations) {
  for (auto* v : {&z_, &s_, &dz_, &ds_, &rd_, &corrector_}) v->resize(2 * columns);
  for (auto* v : {&y_, &dy_, &rp_, &right_, &basic_, &dual_, &direction_, &sign_}) v->resize(rows);
  weight_.resize(columns);
  scratch_.resize(columns);
}

bool BasisPursuit::solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b) {
  by_simplex_ = false;
  const Eigen::Index n = entries_.size();
  if (b.squaredNorm() == 0) {
    entries_.setZero();
    return true;
  }
  const bool converged = interior_point(D, b);
  if (z_.allFinite()) {
    entries_ = z_.head(n) - z_.tail(n);
  } else {
    entries_.noalias() = D.transpose() * b;
  }
  if (converged) return true;
  by_simplex_ = true;
  if (simplex(D, b)) return true;
  entries_.setZero();
  return false;
}

/// Solves the Newton system for residuals rp_, rd_ and the complementarity right-hand side `corrector` into dz_, dy_,
/// ds_.
bool BasisPursuit::newton(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::VectorXd& corrector) {
  const Eigen::Index n = entries_.size();
  // dz = w (A' dy - rd) + corrector / s with w = z/s; A = [D -D].
  for (Eigen::Index i = 0; i < 2 * n; ++i) corrector_[i] = corrector[i] / s_[i] - z_[i] / s_[i] * rd_[i];
  scratch_ = corrector_.head(n) - corrector_.tail(n);
  right_ = rp_;
  right_.noalias() -= D * scratch_;
  dy_ = right_;
  cholesky_.solveInPlace(dy_);
  scratch_.noalias() = D.transpose() * dy_;
  for (Eigen::Index i = 0; i < n; ++i) {
    dz_[i] = z_[i] / s_[i] * scratch_[i] + corrector_[i];
    dz_[n + i] = -z_[n + i] / s_[n + i] * scratch_[i] + corrector_[n + i];
  }
  ds_.head(n) = rd_.head(n) - scratch_;
  ds_.tail(n) = rd_.tail(n) + scratch_;
  return dz_.allFinite() && ds_.allFinite();
}

bool BasisPursuit::interior_point(const Eigen::Ref<const Eigen::MatrixXd>& D,
                                  const Eigen::Ref<const Eigen::VectorXd>& b) {
  const Eigen::Index n = entries_.size();
  scratch_.noalias() = D.transpose() * b;
  const double lift = std::max(0.1 * scratch_.cwiseAbs().maxCoeff(), 1e-6);
  z_.head(n) = scratch_.cwiseMax(0).array() + lift;
  z_.tail(n) = (-scratch_).cwiseMax(0).array() + lift;
  y_.setZero();
  s_.setOnes();
  for (iterations_ = 0; iterations_ < max_iterations_; ++iterations_) {
    scratch_ = z_.head(n) - z_.tail(n);
    rp_ = b;
    rp_.noalias() -= D * scratch_;
    scratch_.noalias() = D.transpose() * y_;
    rd_.head(n) = 1 - scratch_.array() - s_.head(n).array();
    rd_.tail(n) = 1 + scratch_.array() - s_.tail(n).array();
    const double gap = z_.dot(s_);
    if (rp_.norm() <= kTolerance * (1 + b.norm()) && rd_.norm() <= static_cast<double>(n) * kTolerance &&
        gap <= kTolerance * (1 + z_.sum())) {
      return true;
    }
    for (Eigen::Index i = 0; i < n; ++i) weight_[i] = z_[i] / s_[i] + z_[n + i] / s_[n + i];
    scaled_ = D * weight_.asDiagonal();
    normal_.noalias() = scaled_ * D.transpose();
    normal_.diagonal().array() += 1e-14 * normal_.trace() / static_cast<double>(normal_.rows());
    cholesky_.compute(normal_);
    if (cholesky_.info() != Eigen::Success) return false;

    const double mu = gap / static_cast<double>(2 * n);
    ds_ = -z_.cwiseProduct(s_);  // the affine direction first, then Mehrotra's centring and corrector
    if (!newton(D, ds_)) return false;
    const double affine_primal = feasible_step(z_, dz_), affine_dual = feasible_step(s_, ds_);
    const double affine_mu = (z_ + affine_primal * dz_).dot(s_ + affine_dual * ds_) / static_cast<double>(2 * n);
    const double centring = std::pow(affine_mu / mu, 3) * mu;
    ds_ = centring - z_.array() * s_.array() - dz_.array() * ds_.array();
    if (!newton(D, ds_)) return false;
    z_ += feasible_step(z_, dz_) * dz_;
    const double dual_step = feasible_step(s_, ds_);
    y_ += dual_step * dy_;
    s_ += dual_step * ds_;
  }
  return false;
}

/// The columns with the largest entries that are independent: the vertex nearest to the last iterate.
bool BasisPursuit::choose_basis(const Eigen::Ref<const Eigen::MatrixXd>& D) {
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int c) {
    const double left = std::abs(entries_[a]), right = std::abs(entries_[c]);
    return left != right ? left > right : a < c;
  });
  std::fill(in_basis_.begin(), in_basis_.end(), 0);
  const Eigen::Index m = D.rows();
  Eigen::Index chosen = 0;
  for (const int column : order_) {  // Gram-Schmidt, twice: reduced_ holds an orthonormal basis of the chosen columns
    if (chosen == m) break;
    auto candidate = reduced_.col(chosen);
    candidate = D.col(column);
    const double size = candidate.norm();
    for (int pass = 0; pass < 2; ++pass) {
      for (Eigen::Index c = 0; c < chosen; ++c) candidate -= reduced_.col(c).dot(candidate) * reduced_.col(c);
    }
    if (!(candidate.norm() > 1e-9 * size)) continue;
    candidate.normalize();
    basis_[static_cast<std::size_t>(chosen++)] = column;
    in_basis_[static_cast<std::size_t>(column)] = 1;
  }
  return chosen == m;
}

/// Simplex for min ||e||_1, D e = b: a basis holds m entries, the rest are zero; a basic entry that is driven to zero
/// leaves.
bool BasisPursuit::simplex(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b) {
  if (!entries_.allFinite() || !choose_basis(D)) return false;
  const Eigen::Index m = D.rows();
  sign_.setZero();
  for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
    for (Eigen::Index i = 0; i < m; ++i) basis_matrix_.col(i) = D.col(basis_[static_cast<std::size_t>(i)]);
    lu_.compute(basis_matrix_);
    basic_ = lu_.solve(b);
    if (!basic_.allFinite()) return false;
    // A basic entry at zero keeps the sign it was driven with: that is what makes a degenerate pivot change anything.
    for (Eigen::Index i = 0; i < m; ++i)
      sign_[i] = basic_[i] > 0 ? 1 : (basic_[i] < 0 ? -1 : (sign_[i] == 0 ? 1 : sign_[i]));
    dual_ = lu_.transpose().solve(sign_);
    int entering = -1;
    double most = 1 + 1e-9;
    for (int j = 0; j < static_cast<int>(entries_.size()); ++j) {
      const double price = in_basis_[static_cast<std::size_t>(j)] != 0 ? 0 : std::abs(D.col(j).dot(dual_));
      // Bland's rule after a while: it cannot cycle.
      if (price > most) {
        entering = j;
        if (pivot > kMaxPivots / 2) break;
        most = price;
      }
    }
    if (entering < 0) {
      entries_.setZero();
      for (Eigen::Index i = 0; i < m; ++i) entries_[basis_[static_cast<std::size_t>(i)]] = basic_[i];
      return true;
    }
    const double way = D.col(entering).dot(dual_) > 0 ? 1 : -1;
    direction_ = lu_.solve(way * D.col(entering));
    Eigen::Index leaving = -1;
    double step = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < m; ++i) {
      const double toward_zero = sign_[i] * direction_[i];
      if (toward_zero <= 1e-12) continue;
      const double ratio = std::abs(basic_[i]) / toward_zero;
      if (ratio < step) {
        step = ratio;
        leaving = i;
      }
    }
    if (leaving < 0) return false;
    in_basis_[static_cast<std::size_t>(basis_[static_cast<std::size_t>(leaving)])] = 0;
    in_basis_[static_cast<std::size_t>(entering)] = 1;
    basis_[static_cast<std::size_t>(leaving)] = entering;
    sign_[leaving] = way;
  }
  return false;
}

}  // namespace vigil
