/// Small matrices whose size is known only at run time but never exceeds a bound: stored in place, so that no product
/// of a tick allocates. Plants of more states, or sensors of more channels, than kMaxSmall are refused when a run is
/// made.
#pragma once

#include <Eigen/Core>

namespace vigil {

inline constexpr int kMaxSmall = 12;

template <int Rows, int Cols>
using SmallMatrix =
    Eigen::Matrix<double, Rows, Cols, Cols == 1 ? Eigen::ColMajor : (Rows == 1 ? Eigen::RowMajor : Eigen::ColMajor),
                  Rows == Eigen::Dynamic ? kMaxSmall : Rows, Cols == Eigen::Dynamic ? kMaxSmall : Cols>;

using BoundedVector = SmallMatrix<Eigen::Dynamic, 1>;
using BoundedMatrix = SmallMatrix<Eigen::Dynamic, Eigen::Dynamic>;

/// (A + A')/2, in place.
template <class Derived>
void symmetrise(Eigen::MatrixBase<Derived>& a) {
  for (Eigen::Index c = 0; c < a.cols(); ++c) {
    for (Eigen::Index r = c + 1; r < a.rows(); ++r) {
      const double mean = 0.5 * (a(r, c) + a(c, r));
      a(r, c) = mean;
      a(c, r) = mean;
    }
  }
}

}  // namespace vigil
