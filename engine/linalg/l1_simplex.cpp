#include "engine/linalg/l1_simplex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vigil {
namespace {

constexpr int kPivotsPerRow = 100;
constexpr double kPivot = 1e-9;        // of a column: what must be left of it beside the chosen ones
constexpr double kPriceMargin = 1e-9;  // a reduced cost above this is an improvement
constexpr double kSmallPivot = 1e-10;  // an entry that moves slower towards zero does not block
constexpr double kZero = 1e-11;        // of the largest basic entry: no sign below this

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

}  // namespace

L1Simplex::L1Simplex(int rows, int columns)
    : entries_(Eigen::VectorXd::Zero(columns)),
      dual_(Eigen::VectorXd::Zero(rows)),
      basis_matrix_(rows, rows),
      orthonormal_(rows, rows),
      lu_(rows),
      basic_(rows),
      sign_(rows),
      direction_(rows),
      price_(columns),
      scratch_(rows),
      basis_(static_cast<std::size_t>(rows)),
      order_(static_cast<std::size_t>(columns)),
      in_basis_(static_cast<std::size_t>(columns)) {}

/// The columns with the largest entries that are independent: the vertex nearest to the guess.
bool L1Simplex::choose_basis(const Eigen::Ref<const Eigen::MatrixXd>& D,
                             const Eigen::Ref<const Eigen::VectorXd>& guess) {
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    const double left = std::abs(guess[a]), right = std::abs(guess[b]);
    return left != right ? left > right : a < b;
  });
  std::fill(in_basis_.begin(), in_basis_.end(), 0);
  Eigen::Index chosen = 0;
  for (const int column : order_) {
    if (chosen == D.rows()) break;
    auto candidate = orthonormal_.col(chosen);
    candidate = D.col(column);
    const double length = candidate.norm();
    for (int pass = 0; pass < 2; ++pass) {  // Gram-Schmidt, twice: once loses orthogonality
      for (Eigen::Index c = 0; c < chosen; ++c) candidate -= orthonormal_.col(c).dot(candidate) * orthonormal_.col(c);
    }
    if (!(candidate.norm() > kPivot * length)) continue;
    candidate.normalize();
    basis_[at(chosen++)] = column;
    in_basis_[at(column)] = 1;
  }
  return chosen == D.rows();
}

/// The entries, signs and prices of the basis. An entry at zero keeps the sign it came with: that is what makes a
/// degenerate pivot change anything.
bool L1Simplex::evaluate(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b) {
  for (Eigen::Index i = 0; i < D.rows(); ++i) basis_matrix_.col(i) = D.col(basis_[at(i)]);
  lu_.compute(basis_matrix_);
  basic_ = lu_.solve(b);
  const double zero = kZero * basic_.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < D.rows(); ++i) {
    if (std::abs(basic_[i]) > zero) sign_[i] = basic_[i] > 0 ? 1 : -1;
  }
  scratch_ = sign_;  // B' dual = sign, by parts: the solver's own transpose allocates
  lu_.matrixLU().triangularView<Eigen::Upper>().transpose().solveInPlace(scratch_);
  lu_.matrixLU().triangularView<Eigen::UnitLower>().transpose().solveInPlace(scratch_);
  dual_.noalias() = lu_.permutationP().transpose() * scratch_;
  price_.noalias() = D.transpose() * dual_;
  return basic_.allFinite() && dual_.allFinite();
}

/// The column whose entry, moved in the direction of its price, lowers the norm most; by Bland's rule the first
/// variable (all u, then all v) that lowers it. -1 at the optimum.
int L1Simplex::entering(const Eigen::Ref<const Eigen::MatrixXd>& D, bool bland) {
  int best = -1;
  double most = 1 + kPriceMargin;
  for (const double half : {1.0, -1.0}) {
    for (int j = 0; j < static_cast<int>(D.cols()); ++j) {
      if (in_basis_[at(j)] != 0 || half * price_[j] <= most) continue;
      if (bland) return j;
      most = half * price_[j];
      best = j;
    }
  }
  return best;
}

int L1Simplex::variable(Eigen::Index position) const {
  return basis_[at(position)] + (sign_[position] < 0 ? static_cast<int>(order_.size()) : 0);
}

/// The basic entry that is driven to zero first; among equals the fastest one, or the first variable by Bland's rule.
/// Sets the step. -1 where none is.
Eigen::Index L1Simplex::leaving(bool bland) {
  step_ = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < basic_.size(); ++i) {
    const double speed = sign_[i] * direction_[i];
    if (speed > kSmallPivot) step_ = std::min(step_, std::max(0.0, sign_[i] * basic_[i]) / speed);
  }
  Eigen::Index best = -1;
  const double margin = step_ + 1e-12;
  for (Eigen::Index i = 0; i < basic_.size(); ++i) {
    const double speed = sign_[i] * direction_[i];
    if (speed <= kSmallPivot || std::max(0.0, sign_[i] * basic_[i]) / speed > margin) continue;
    const bool better = best < 0 || (bland ? variable(i) < variable(best) : speed > sign_[best] * direction_[best]);
    if (better) best = i;
  }
  return best;
}

bool L1Simplex::solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b,
                      const Eigen::Ref<const Eigen::VectorXd>& guess) {
  entries_.setZero();
  dual_.setZero();
  pivots_ = 0;
  if (!guess.allFinite() || !choose_basis(D, guess)) return false;
  sign_.setOnes();
  const int most = kPivotsPerRow * static_cast<int>(D.rows());
  Eigen::Index standing = 0;  // pivots in a row without a step; Bland's rule ends them
  for (; pivots_ <= most; ++pivots_) {
    if (!evaluate(D, b)) return false;
    const bool bland = standing > D.rows();
    const int column = entering(D, bland);
    if (column < 0) {
      for (Eigen::Index i = 0; i < D.rows(); ++i) entries_[basis_[at(i)]] = basic_[i];
      return true;
    }
    const double way = price_[column] > 0 ? 1 : -1;
    direction_ = lu_.solve(D.col(column));
    direction_ *= way;
    const Eigen::Index out = leaving(bland);
    if (out < 0) return false;
    standing = step_ > 1e-12 ? 0 : standing + 1;
    in_basis_[at(basis_[at(out)])] = 0;
    in_basis_[at(column)] = 1;
    basis_[at(out)] = column;
    sign_[out] = way;
  }
  return false;
}

}  // namespace vigil
