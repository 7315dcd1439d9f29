#include "engine/linalg/modes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double kDecays = 1e-8;
constexpr double kSame =
    1e-7;  // of the larger: a double eigenvalue comes out as two that differ by the root of rounding

double norm_of(const MatrixXd& A) {
  const double norm = A.stableNorm();
  return norm > 0 ? norm : 1;
}

bool same(const std::complex<double>& one, const std::complex<double>& other) {
  return std::abs(one - other) <= kSame * std::max({std::abs(one), std::abs(other), kSame});
}

std::vector<Mode> grouped(const Eigen::VectorXcd& eigenvalues, TimeKind time) {
  std::vector<Mode> modes;
  for (const std::complex<double>& value : eigenvalues) {
    const double turning = std::abs(value.imag());
    const std::complex<double> upper(value.real(), turning > kSame * std::abs(value) ? turning : 0);
    const auto known =
        std::find_if(modes.begin(), modes.end(), [&](const Mode& mode) { return same(mode.value, upper); });
    if (known == modes.end())
      modes.push_back({upper, 1});
    else
      ++known->count;
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [&](const Mode& one, const Mode& other) { return size_of(one, time) > size_of(other, time); });
  return modes;
}

std::optional<Eigen::VectorXcd> eigenvalues_of(const MatrixXd& A) {
  if (!std::isfinite(norm_of(A))) return std::nullopt;
  const Eigen::EigenSolver<MatrixXd> solver(A, false);
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) return std::nullopt;
  return solver.eigenvalues();
}

/// Every row of length 1, whatever its unit, and no more rows than columns.
MatrixXd unit_rows(MatrixXd C) {
  for (auto row : C.rowwise()) {
    const double length = row.stableNorm();
    if (length > 0) row /= length;
  }
  const auto n = C.cols();
  if (C.rows() <= n) return C;
  return Eigen::HouseholderQR<MatrixXd>(C).matrixQR().topRows(n).triangularView<Eigen::Upper>();
}

/// An orthonormal basis of what M (r x k) maps to nothing, k x d.
MatrixXd null_space(const MatrixXd& M) {
  if (M.rows() == 0) return MatrixXd::Identity(M.cols(), M.cols());
  const Eigen::JacobiSVD<MatrixXd> svd(M, Eigen::ComputeFullV);
  const auto rank = (svd.singularValues().array() > kHidden).count();
  return svd.matrixV().rightCols(M.cols() - rank);
}

/// An orthonormal basis of the largest subspace of C's null space that A maps into itself.
MatrixXd unseen(const MatrixXd& A, const MatrixXd& C) {
  MatrixXd V = null_space(C);
  while (V.cols() > 0) {
    const MatrixXd moved = A * V;
    const MatrixXd kept = null_space(moved - V * (V.transpose() * moved));
    if (kept.cols() == V.cols()) break;
    V = (V * kept).eval();
  }
  return V;
}

double least_singular_value(const MatrixXd& A, const MatrixXd& C, const std::complex<double>& mode) {
  const auto n = A.rows();
  MatrixXcd pencil(n + C.rows(), n);
  pencil << A.cast<std::complex<double>>() - mode * MatrixXcd::Identity(n, n), C.cast<std::complex<double>>();
  return Eigen::JacobiSVD<MatrixXcd>(pencil).singularValues()[n - 1];
}

}  // namespace

double size_of(const Mode& mode, TimeKind time) {
  return time == TimeKind::ticks ? std::abs(mode.value) : mode.value.real();
}

std::optional<Modes> Modes::of(const MatrixXd& A, TimeKind time) {
  const auto eigenvalues = eigenvalues_of(A);
  if (!eigenvalues) return std::nullopt;
  Modes modes;
  modes.time_ = time;
  modes.norm_ = norm_of(A);
  modes.all_ = grouped(*eigenvalues, time);
  return modes;
}

Fate Modes::fate(const Mode& mode) const {
  const double excess = time_ == TimeKind::ticks ? size_of(mode, time_) - 1 : size_of(mode, time_) / norm_;
  return excess < -kDecays ? Fate::decays : (excess > kDecays ? Fate::grows : Fate::stays);
}

bool Modes::stable() const {
  return std::all_of(all_.begin(), all_.end(), [this](const Mode& mode) { return fate(mode) == Fate::decays; });
}

std::optional<Visibility> visibility(const MatrixXd& A, const MatrixXd& C, TimeKind time) {
  const auto eigenvalues = eigenvalues_of(A);
  if (!eigenvalues || !C.allFinite()) return std::nullopt;
  const double norm = norm_of(A);
  const MatrixXd unit = A / norm, rows = unit_rows(C);
  Visibility seen;
  const MatrixXd V = unseen(unit, rows);
  if (V.cols() > 0) {
    const auto hidden = eigenvalues_of(V.transpose() * A * V);
    if (!hidden) return std::nullopt;
    seen.hidden = grouped(*hidden, time);
  }
  seen.margin = std::numeric_limits<double>::infinity();
  for (const Mode& mode : grouped(*eigenvalues, time)) {
    const double margin = least_singular_value(unit, rows, mode.value / norm);
    if (margin < seen.margin) {
      seen.weakest = mode;
      seen.margin = margin;
    }
    const auto is_mode = [&](const Mode& other) { return same(other.value, mode.value); };
    if (margin <= kHidden && std::none_of(seen.hidden.begin(), seen.hidden.end(), is_mode))
      seen.hidden.push_back({mode.value, mode.value.imag() > 0 ? 2 : 1});
  }
  seen.rank = static_cast<int>(A.rows());
  for (const Mode& mode : seen.hidden) seen.rank = std::max(0, seen.rank - mode.count);
  return seen;
}

}  // namespace vigil
