#include "engine/linalg/omp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil {
namespace {

constexpr double kDependent = 1e-12;  // a column of which less is left beside the chosen (squared, relative) is none
constexpr double kRounding = 1e-14;   // of ||y||: a correlation below this is no reason to pick

/// True where no number is infinite or NaN; one pass that vectorises, unlike allFinite.
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
      shares_(picks) {
  support_.reserve(static_cast<std::size_t>(picks));
}

/// squares: of the columns' norms. False where they are not finite.
bool Omp::begin(const Eigen::Ref<const Eigen::VectorXd>& squares) {
  entries_.setZero();
  support_.clear();
  residual_ = 0;
  const double largest = squares.size() > 0 ? squares.maxCoeff() : 0;
  smallest_pivot_ = std::max(kDependent * largest, std::numeric_limits<double>::min());
  per_norm_ = squares.cwiseMax(smallest_pivot_).cwiseSqrt().cwiseInverse();
  return finite(per_norm_);
}

/// -1 where no column says more than `least`.
int Omp::best_column(double least) {
  gain_ = correlation_.cwiseAbs().cwiseProduct(per_norm_);
  const double most = gain_.size() > 0 ? gain_.maxCoeff() : 0;
  if (!(most > least)) return -1;
  int column = 0;
  while (gain_[column] != most) ++column;
  return column;
}

bool Omp::solve_gram(const Eigen::Ref<const Eigen::MatrixXd>& G, const Eigen::Ref<const Eigen::VectorXd>& b,
                     double norm_y, int picks, double tolerance) {
  const bool fits = G.rows() == entries_.size() && G.cols() == G.rows() && b.size() == G.rows();
  if (!fits || !finite(G) || !finite(b) || !std::isfinite(norm_y) || !begin(G.diagonal())) return fail();
  correlation_ = b;
  residual_ = norm_y;
  double energy = norm_y * norm_y;
  const Eigen::Index most = std::min<Eigen::Index>(picks, shares_.size());
  Eigen::Index n = 0;
  while (n < most && residual_ > tolerance) {
    const int column = best_column(kRounding * norm_y);
    if (column < 0) break;
    per_norm_[column] = 0;
    const auto along = directions_.row(column).head(n);  // Q' d: what the chosen ones already say of this column
    const double pivot = G(column, column) - along.squaredNorm();
    if (!(pivot >= smallest_pivot_)) continue;
    const double length = std::sqrt(pivot);
    factor_.col(n).head(n) = along.transpose();
    factor_(n, n) = length;
    auto direction = directions_.col(n);
    direction = G.col(column);
    for (Eigen::Index r = 0; r < n; ++r) direction -= factor_(r, n) * directions_.col(r);
    direction /= length;
    shares_[n] = correlation_[column] / length;
    correlation_ -= shares_[n] * direction;
    energy -= shares_[n] * shares_[n];
    residual_ = std::sqrt(std::max(energy, 0.0));
    support_.push_back(column);
    ++n;
  }
  return finish();
}

bool Omp::solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& y, int picks,
                double tolerance) {
  gain_ = D.colwise().squaredNorm().transpose();
  if (D.cols() != entries_.size() || y.size() != D.rows() || !finite(D) || !finite(y) || !begin(gain_)) return fail();
  orthonormal_.resize(D.rows(), shares_.size());
  remainder_ = y;
  residual_ = y.norm();
  const double least = kRounding * residual_;
  const Eigen::Index most = std::min<Eigen::Index>(picks, shares_.size());
  Eigen::Index n = 0;
  while (n < most && residual_ > tolerance) {
    correlation_.noalias() = D.transpose() * remainder_;
    const int column = best_column(least);
    if (column < 0) break;
    per_norm_[column] = 0;
    auto direction = orthonormal_.col(n);
    direction = D.col(column);
    factor_.col(n).head(n).setZero();
    for (int pass = 0; pass < 2; ++pass) {  // Gram-Schmidt, twice is enough
      for (Eigen::Index r = 0; r < n; ++r) {
        const double along = orthonormal_.col(r).dot(direction);
        factor_(r, n) += along;
        direction -= along * orthonormal_.col(r);
      }
    }
    const double length = direction.norm();
    if (!(length * length >= smallest_pivot_)) continue;
    factor_(n, n) = length;
    direction /= length;
    shares_[n] = direction.dot(remainder_);
    remainder_ -= shares_[n] * direction;
    residual_ = remainder_.norm();
    support_.push_back(column);
    ++n;
  }
  return finish();
}

/// The coefficients of the chosen columns from those of their orthonormal basis: R e = Q' y.
bool Omp::finish() {
  const auto n = static_cast<Eigen::Index>(support_.size());
  auto coefficients = shares_.head(n);
  factor_.topLeftCorner(n, n).triangularView<Eigen::Upper>().solveInPlace(coefficients);
  if (!finite(coefficients) || !std::isfinite(residual_)) return fail();
  for (Eigen::Index i = 0; i < n; ++i) entries_[support_[static_cast<std::size_t>(i)]] = coefficients[i];
  return true;
}

bool Omp::fail() {
  entries_.setZero();
  support_.clear();
  residual_ = 0;
  return false;
}

}  // namespace vigil
