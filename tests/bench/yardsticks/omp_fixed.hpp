/// The bare loop that orthogonal matching pursuit is measured against: 36 columns, at most 12 picks, the Gram form with
/// one Cholesky row a pick, everything of fixed size on the stack, no check of any input, no records.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <vector>

namespace yardstick {

constexpr int kOmpRows = 30, kOmpColumns = 36, kOmpPicks = 12, kOmpRing = 64;

struct OmpProblems {
  Eigen::Matrix<double, kOmpColumns, kOmpColumns> gram;
  std::vector<Eigen::Matrix<double, kOmpColumns, 1>> right;  ///< D' y
  std::vector<double> norm;                                  ///< ||y||
};

/// Windows of the specification's section 7: the dictionary has orthonormal rows; `entries(k)` readings of window k are
/// falsified, all bear noise of 0.01.
template <class Entries>
OmpProblems omp_problems(std::uint64_t state, Entries&& entries) {
  const auto uniform = [&] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1.0p-53;
  };
  const auto normal = [&] {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * 3.14159265358979323846 * uniform());
  };
  using Column = Eigen::Matrix<double, kOmpColumns, 1>;
  OmpProblems problems;
  Eigen::Matrix<double, kOmpColumns, kOmpColumns - kOmpRows> regression;
  for (double& entry : regression.reshaped()) entry = normal();
  const Eigen::Matrix<double, kOmpColumns, kOmpColumns> Q = regression.householderQr().householderQ();
  problems.gram = Q.rightCols<kOmpRows>() * Q.rightCols<kOmpRows>().transpose();
  for (int k = 0; k < kOmpRing; ++k) {
    Column reading;
    for (double& entry : reading) entry = 0.01 * normal();
    for (int i = 0; i < entries(k); ++i) reading[static_cast<int>(uniform() * kOmpColumns)] += 10 * uniform() - 5;
    problems.right.push_back(problems.gram * reading);
    problems.norm.push_back(problems.right.back().norm());
  }
  return problems;
}

class FixedOmp {
 public:
  explicit FixedOmp(const OmpProblems& problems) : problems_(problems), G_(problems.gram) {
    for (int j = 0; j < kOmpColumns; ++j) per_length_[j] = 1 / std::sqrt(G_(j, j));
  }

  /// The residual's norm.
  double solve(int k, double tolerance) {
    const auto& b = problems_.right[static_cast<std::size_t>(k)];
    const double norm = problems_.norm[static_cast<std::size_t>(k)];
    double energy = norm * norm;
    bool used[kOmpColumns] = {};
    correlation_ = b;
    for (picked_ = 0; picked_ < kOmpPicks && energy > tolerance * tolerance; ++picked_) {
      const int column = best(used);
      used[column] = true;
      support_[picked_] = column;
      energy -= grow(column, b[column]);
      refit(b);
    }
    return std::sqrt(std::max(0.0, energy));
  }

  int picked() const { return picked_; }

 private:
  int best(const bool* used) const {
    int found = -1;
    double most = 0;
    for (int j = 0; j < kOmpColumns; ++j) {
      const double gain = std::abs(correlation_[j]) * per_length_[j];
      if (used[j] || gain <= most) continue;
      most = gain;
      found = j;
    }
    return found;
  }

  /// One more row of the Cholesky factor and of its forward solution; by how much the squared residual falls.
  double grow(int column, double right) {
    const int n = picked_;
    double square = G_(column, column);
    for (int r = 0; r < n; ++r) {
      double entry = G_(support_[r], column);
      for (int c = 0; c < r; ++c) entry -= L_[n][c] * L_[r][c];
      L_[n][r] = entry / L_[r][r];
      square -= L_[n][r] * L_[n][r];
      right -= L_[n][r] * forward_[r];
    }
    L_[n][n] = std::sqrt(square);
    forward_[n] = right / L_[n][n];
    return forward_[n] * forward_[n];
  }

  void refit(const Eigen::Matrix<double, kOmpColumns, 1>& b) {
    correlation_ = b;
    for (int r = picked_; r >= 0; --r) {
      double entry = forward_[r];
      for (int c = r + 1; c <= picked_; ++c) entry -= L_[c][r] * coefficient_[c];
      coefficient_[r] = entry / L_[r][r];
    }
    for (int r = 0; r <= picked_; ++r) correlation_.noalias() -= coefficient_[r] * G_.col(support_[r]);
  }

  const OmpProblems& problems_;
  const Eigen::Matrix<double, kOmpColumns, kOmpColumns> G_;
  Eigen::Matrix<double, kOmpColumns, 1> correlation_;
  double per_length_[kOmpColumns];
  double L_[kOmpPicks][kOmpPicks], forward_[kOmpPicks], coefficient_[kOmpPicks];
  int support_[kOmpPicks];
  int picked_ = 0;
};

}  // namespace yardstick
