/// The measurement update of the generalised minimum-error-entropy Kalman filter. Specification (replay), section 8.1.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "engine/linalg/small.hpp"

namespace vigil::replay {

enum class GmeeForm : std::uint8_t { square, diff };

struct GmeeSettings {
  double alpha = 2;  ///< > 0, shape of the kernel
  double beta = 2;   ///< > 0, its width
  GmeeForm form = GmeeForm::square;
};

struct GmeeStep {
  BoundedVector x;         ///< n
  BoundedMatrix P, K;      ///< n x n, n x p
  int iterations = 0;      ///< 1..50
  bool converged = false;  ///< false: the last of 50 iterates is kept
};

class GmeeUpdate {
 public:
  /// C: p x n; R: p x p, positive definite.
  GmeeUpdate(const Eigen::MatrixXd& C, const Eigen::MatrixXd& R, const GmeeSettings& settings);

  /// From the prediction xp (n), Pp (n x n, positive definite) and the reading y (p). Nothing where Pp or R is not
  /// positive definite or the iteration leaves the finite numbers. No allocation.
  std::optional<GmeeStep> update(const BoundedVector& xp, const BoundedMatrix& Pp, const BoundedVector& y) const;

 private:
  BoundedMatrix C_, R_, root_;  ///< root_: chol(R), lower; empty where there is none
  GmeeSettings settings_;
};

}  // namespace vigil::replay
