/// One step of the mixed estimator: covariance of the stochastic part and ellipsoid of the bounded part of the error
/// under one gain. Seed 003, Theorems 1 and 2, eqs. (5)-(24); specification (replay), sections 4.4 and 4.5. Bounded
/// matrices, no allocation. Nothing here depends on readings.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "engine/linalg/small.hpp"

namespace vigil::replay {

/// Of the error: covariance Q of its stochastic part, shape matrix M of the ellipsoid of its bounded part; n x n.
struct Bounds {
  BoundedMatrix Q, M;
};

/// Qp = A Q A' + P, Mp = minimum-trace sum of A M A' and Mw. A, P, Mw: n x n.
void time_update(const Eigen::MatrixXd& A, const Eigen::MatrixXd& P, const Eigen::MatrixXd& Mw, Bounds& bounds);

/// Where the optimum lies at the end of its range: `zero` K = 0, `infinite` K = C^-1 (the residual is zero).
enum class Corner : std::uint8_t { none, zero, infinite };

struct GainChoice {
  BoundedMatrix K;     ///< n x p
  double sigma = 0.5;  ///< 1 / (1 + zeta); 0 at the corner `infinite`, 1 at `zero`
  double zeta = 1;     ///< may be infinite: at that corner, and where the prediction has no bounded part
  Corner corner = Corner::none;
  BoundedMatrix Q, M;  ///< a posteriori, symmetric, n x n
};

/// The optimal gain for one sensor, seed 003, eqs. (12)-(24) as the specification resolves them.
class MixedUpdate {
 public:
  /// C: p x n, R, Mv: p x p, mu in [0, 1], zeta_max > 0 (infinity: as printed). Nothing is checked here.
  MixedUpdate(const Eigen::MatrixXd& C, const Eigen::MatrixXd& R, const Eigen::MatrixXd& Mv, double mu,
              double zeta_max = std::numeric_limits<double>::infinity());

  /// From Qp and Mp (n x n). Nothing where the innovation matrix C W C' + S is not invertible or a result not finite.
  std::optional<GainChoice> update(const BoundedMatrix& Qp, const BoundedMatrix& Mp) const;

  /// The gain of a given sigma in (0, 1).
  struct Point {
    double sigma = 0, rest = 0;               ///< rest: 1 - sigma, without its rounding
    BoundedMatrix K, X;                       ///< K(sigma) = W C' (C W C' + S)^-1, n x p; X = I - K C
    double of_sensor = 0, of_prediction = 0;  ///< tr K Mv K', tr X Mp X'
    /// g: the slope of the minimised cost over (1 - mu), nondecreasing in sigma.
    double slope() const { return of_sensor / (rest * rest) - of_prediction / (sigma * sigma); }
  };
  /// Nothing where C W C' + S is not invertible.
  std::optional<Point> at(double sigma, const BoundedMatrix& Qp, const BoundedMatrix& Mp) const;

 private:
  /// How the bounded part's two ellipsoids are added: by the zeta chosen, or with the least trace.
  struct Choice {
    Point point;
    double zeta = 1;
    Corner corner = Corner::none;
    bool least_trace = true;
  };
  std::optional<Point> at_zeta(double zeta, const BoundedMatrix& Qp, const BoundedMatrix& Mp) const;
  bool solve(Point& point, const BoundedMatrix& W, const BoundedMatrix& S) const;
  std::optional<Choice> choose(const BoundedMatrix& Qp, const BoundedMatrix& Mp) const;
  std::optional<Choice> choose_within(const BoundedMatrix& Qp, const BoundedMatrix& Mp) const;
  std::optional<Choice> search(const Point& low, const Point& high, const BoundedMatrix& Qp,
                               const BoundedMatrix& Mp) const;

  BoundedMatrix C_, R_, Mv_;
  BoundedMatrix inverse_;   ///< C^-1; empty where there is none
  bool injective_ = false;  ///< C has rank n
  double mu_ = 1, zeta_max_;
};

}  // namespace vigil::replay
