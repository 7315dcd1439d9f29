#include "engine/linalg/omp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil {
namespace {

constexpr double kDependent = 1e-12;  // squared, of the largest column
constexpr double kExplained = 1e-13;  // of ||y||

/// One pass that vectorises, unlike allFinite.
template <class Matrix>
bool finite(const Matrix& m) {
  return (m.array() * 0.0).sum() == 0.0;
}

}  // namespace

Omp::Omp(int columns, int picks)
    : entries_(Eigen::VectorXd::Zero(columns)),
      correlation_(columns),
      per_norm_(columns),
      gain_(columns),
      directions_(columns, picks),
      factor_(Eigen::MatrixXd::Zero(picks, picks)),
      shares_(picks),
      support_(static_cast<std::size_t>(picks)) {}

/// squares: of the columns' norms. False where one of them or the norm is not finite.
bool Omp::begin(const Eigen::Ref<const Eigen::VectorXd>& squares, double norm_y) {
  entries_.setZero();
  count_ = 0;
  residual_ = norm_y;
  least_gain_ = kExplained * norm_y;
  const double largest = squares.size() > 0 ? squares.maxCoeff() : 0;
  least_square_ = std::max(kDependent * largest, std::numeric_limits<double>::min());
  for (Eigen::Index j = 0; j < squares.size(); ++j) {
    per_norm_[j] = squares[j] >= least_square_ ? 1 / std::sqrt(squares[j]) : 0;
  }
  return std::isfinite(norm_y) && finite(squares);
}

bool Omp::wants_more(int picks, double tolerance) const {
  return count_ < shares_.size() && count_ < picks && residual_ > tolerance;
}

/// The next column, which is not offered again; -1 where none explains anything.
int Omp::best_column() {
  gain_ = correlation_.cwiseAbs().cwiseProduct(per_norm_);
  const double most = gain_.size() > 0 ? gain_.maxCoeff() : 0;
  if (!(most > least_gain_)) return -1;
  int column = 0;
  while (gain_[column] != most) ++column;
  per_norm_[column] = 0;
  return column;
}

/// A column of the pivoted Cholesky factor of G: what D says of one more direction of the orthonormal basis, without
/// the basis. The row of the chosen column in the directions so far is its row of R. False where
/// too little of it is left.
bool Omp::grow(int column, const Eigen::Ref<const Eigen::VectorXd>& of_gram) {
  const Eigen::Index n = count_;
  double square = of_gram[column];
  for (Eigen::Index r = 0; r < n; ++r) {
    factor_(r, n) = directions_(column, r);
    square -= factor_(r, n) * factor_(r, n);
  }
  if (!(square >= least_square_)) return false;
  factor_(n, n) = std::sqrt(square);
  auto direction = directions_.col(n);
  direction = of_gram;
  Eigen::Index r = 0;
  for (; r + 3 < n; r += 4) {  // four at a time: the sum is loaded and stored once for all
    direction -= factor_(r, n) * directions_.col(r) + factor_(r + 1, n) * directions_.col(r + 1) +
                 factor_(r + 2, n) * directions_.col(r + 2) + factor_(r + 3, n) * directions_.col(r + 3);
  }
  for (; r < n; ++r) direction -= factor_(r, n) * directions_.col(r);
  direction *= 1 / factor_(n, n);
  return true;
}

/// Modified Gram-Schmidt on the column itself, which solves least squares stably as long as y goes through it too.
/// False where too little of the column is left.
bool Omp::orthonormalise(const Eigen::Ref<const Eigen::VectorXd>& column) {
  const Eigen::Index n = count_;
  auto direction = orthonormal_.col(n);
  direction = column;
  for (Eigen::Index r = 0; r < n; ++r) {
    factor_(r, n) = orthonormal_.col(r).dot(direction);
    direction -= factor_(r, n) * orthonormal_.col(r);
  }
  const double square = direction.squaredNorm();
  if (!(square >= least_square_)) return false;
  factor_(n, n) = std::sqrt(square);
  direction /= factor_(n, n);
  return true;
}

void Omp::join(int column) { support_[static_cast<std::size_t>(count_++)] = column; }

bool Omp::solve_gram(const Eigen::Ref<const Eigen::MatrixXd>& G, const Eigen::Ref<const Eigen::VectorXd>& b,
                     double norm_y, int picks, double tolerance) {
  const bool fits = G.rows() == entries_.size() && G.cols() == G.rows() && b.size() == G.rows();
  if (!fits || !finite(b)) return fail();
  gain_ = G.diagonal();
  if (!begin(gain_, norm_y)) return fail();
  correlation_ = b;
  double energy = norm_y * norm_y;
  while (wants_more(picks, tolerance)) {
    const int column = best_column();
    if (column < 0) break;
    if (!grow(column, G.col(column))) continue;
    const double share = correlation_[column] / factor_(count_, count_);
    shares_[count_] = share;
    correlation_ -= share * directions_.col(count_);
    energy = std::max(0.0, energy - share * share);
    residual_ = std::sqrt(energy);
    join(column);
  }
  return finite(correlation_) ? finish() : fail();  // what the chosen columns hold has gone into it
}

bool Omp::solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& y, int picks,
                double tolerance) {
  if (D.cols() != entries_.size() || D.rows() != y.size() || !finite(D) || !finite(y)) return fail();
  gain_ = D.colwise().squaredNorm().transpose();
  if (!begin(gain_, y.norm())) return fail();
  orthonormal_.resize(D.rows(), shares_.size());
  remainder_ = y;
  while (wants_more(picks, tolerance)) {
    correlation_.noalias() = D.transpose() * remainder_;
    const int column = best_column();
    if (column < 0) break;
    if (!orthonormalise(D.col(column))) continue;
    shares_[count_] = orthonormal_.col(count_).dot(remainder_);
    remainder_ -= shares_[count_] * orthonormal_.col(count_);
    residual_ = remainder_.norm();
    join(column);
  }
  return finish();
}

/// The coefficients of the chosen columns from those of their orthonormal basis: R e = Q' y.
bool Omp::finish() {
  auto coefficients = shares_.head(count_);
  for (Eigen::Index c = count_ - 1; c >= 0; --c) {
    coefficients[c] /= factor_(c, c);
    coefficients.head(c) -= coefficients[c] * factor_.col(c).head(c);
  }
  if (!finite(coefficients) || !std::isfinite(residual_)) return fail();
  for (Eigen::Index i = 0; i < count_; ++i) entries_[support_[static_cast<std::size_t>(i)]] = coefficients[i];
  return true;
}

bool Omp::fail() {
  entries_.setZero();
  count_ = 0;
  residual_ = 0;
  return false;
}

}  // namespace vigil
