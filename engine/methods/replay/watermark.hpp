/// The zonotope method's secret coding of what a smart sensor sends: s = E z + m. Specification (replay), section 8.2,
/// items 3 and 4.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/linalg/small.hpp"
#include "engine/random/draws.hpp"

namespace vigil::replay {

struct Mark {
  BoundedMatrix E;  ///< p x p, orthogonal
  BoundedVector m;  ///< p

  BoundedVector apply(const BoundedVector& z) const { return E * z + m; }
  BoundedVector remove(const BoundedVector& s) const { return E.transpose() * (s - m); }
};

/// Tick k's mark. E: a random sign for p = 1, a rotation by a uniform angle for p = 2, a uniform random rotation
/// beyond. m: uniform in the box of half widths `size` (p; rho h). The same address gives the same mark. No allocation.
Mark draw_mark(const Draws& draws, std::int64_t k, const Eigen::Ref<const Eigen::VectorXd>& size);

}  // namespace vigil::replay
