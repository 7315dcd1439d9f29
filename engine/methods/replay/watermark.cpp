#include "engine/methods/replay/watermark.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace vigil::replay {
namespace {

/// Uniform over the rotations of p >= 3 dimensions: Gram-Schmidt on a matrix of normals, the last column turned so that
/// nothing is mirrored.
BoundedMatrix random_rotation(const Draws& draws, std::int64_t k, Eigen::Index p) {
  BoundedMatrix E(p, p);
  std::uint32_t index = 0;
  for (Eigen::Index j = 0; j < p; ++j) {
    auto column = E.col(j);
    do {
      for (Eigen::Index i = 0; i < p; ++i) column[i] = draws.normal(k, index++);
      for (int pass = 0; pass < 2; ++pass) {  // once loses orthogonality
        for (Eigen::Index i = 0; i < j; ++i) column -= E.col(i).dot(column) * E.col(i);
      }
    } while (!(column.norm() > 1e-6));
    column.normalize();
  }
  if (E.determinant() < 0) E.col(p - 1) *= -1;
  return E;
}

BoundedMatrix rotation(const Draws& draws, std::int64_t k, Eigen::Index p) {
  if (p > 2) return random_rotation(draws, k, p);
  const double u = draws.uniform(k, 0);
  if (p == 1) return BoundedMatrix::Constant(1, 1, u < 0.5 ? -1 : 1);
  const double angle = 2 * std::numbers::pi * u;
  BoundedMatrix E(2, 2);
  E << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return E;
}

constexpr std::uint32_t kOffsets = 1u << 16;  // where the draws of m begin, far behind those of any E

}  // namespace

Mark draw_mark(const Draws& draws, std::int64_t k, const Eigen::Ref<const Eigen::VectorXd>& size) {
  Mark mark{rotation(draws, k, size.size()), BoundedVector(size.size())};
  for (Eigen::Index i = 0; i < size.size(); ++i) {
    mark.m[i] = size[i] * (2 * draws.uniform(k, kOffsets + static_cast<std::uint32_t>(i)) - 1);
  }
  return mark;
}

}  // namespace vigil::replay
