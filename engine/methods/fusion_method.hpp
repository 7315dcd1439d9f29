/// A lane whose sensors send what they know to a fusion centre: what the run needs to know of it beyond a Method.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "engine/methods/privacy/protection.hpp"

namespace vigil {

/// Found by Method::fusion(). Its outputs are the nodes (their local estimates) and then "fused" (the legitimate
/// user's). Its messages are states long and go over the links to the centre.
class FusionMethod {
 public:
  virtual ~FusionMethod() = default;
  virtual const privacy::Protection& protection() const = 0;
  virtual const privacy::PublicTick& public_tick() const = 0;
  /// What one would have who fused the local estimates themselves, states; its covariance's trace.
  virtual const Eigen::VectorXd& optimal() const = 0;
  virtual double optimal_trace() const = 0;
  /// Trace of the legitimate user's covariance, NaN where it is not known.
  virtual double legitimate_trace() const = 0;
  /// What the centre puts in place of a node's message, states; null where it takes the message as it is.
  virtual const double* compensated(int node) const = 0;
  /// Trace of its error covariance; NaN where compensated() is null or it is not known.
  virtual double compensated_trace(int node) const = 0;
};

}  // namespace vigil
