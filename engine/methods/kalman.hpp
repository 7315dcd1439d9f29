/// The extended Kalman filter as free functions: what the baselines of every family share. Bounded matrices, no
/// allocation.
#pragma once

#include <Eigen/Dense>

#include "engine/linalg/small.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {

/// Estimate and covariance.
struct Gaussian {
  BoundedVector mean;
  BoundedMatrix covariance;
};

/// One sensor's innovation at a given point: r = z - h(x) (angles wrapped), its Jacobian and covariance. A channel that
/// is NaN is left out.
struct Innovation {
  BoundedVector r;
  BoundedMatrix H;
  BoundedMatrix R;
  bool empty() const { return r.size() == 0; }
};

/// x+ = f(x, u), P+ = F P F' + Q.
void kalman_predict(Gaussian& state, const Plant& plant, const Eigen::VectorXd& input, const Eigen::MatrixXd& Q);

/// The innovation of `reading` at `point`; empty where no channel was read. `as_printed`: with the derivative as its
/// source prints it.
Innovation innovate(const Sensor& sensor, const Eigen::VectorXd& reading, const BoundedVector& point,
                    bool as_printed = false);

/// S = H P H' + R.
BoundedMatrix innovation_covariance(const Innovation& innovation, const BoundedMatrix& P);

/// K = P H' S^-1, x += K r, Joseph's form of P. False where S is not positive definite or the result not finite.
bool kalman_update(Gaussian& state, const Innovation& innovation);

/// r' S^-1 r with S of P; NaN where S is not positive definite.
double mahalanobis(const Innovation& innovation, const BoundedMatrix& P);

}  // namespace vigil
