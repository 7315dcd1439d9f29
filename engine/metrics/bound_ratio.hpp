/// Does the bound bound? The ratio of the errors' covariance over runs to the mean bound: specification of seed 000,
/// section 10.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/bytes.hpp"

namespace vigil {

/// Of one lane and one run: e e' and Phi at every tick and output. Filled while the run is stepped.
struct BoundRecord {
  std::string lane;
  int states = 0;
  std::vector<double> errors;  ///< ticks x outputs x states
  std::vector<double> bounds;  ///< ticks x outputs x states^2, column-major
};

/// Sums over runs. Runs that ended early count where they got to.
class BoundRatio {
 public:
  void add(const BoundRecord& record);
  /// The largest over ticks and outputs of lambda_max(L^-1 P L^-T), L L' = mean bound, P = mean of e e' (no mean
  /// removed). Infinity where a mean bound is not positive definite: never passed.
  double max() const;

  void save(ByteWriter& out) const;
  void load(ByteReader& in);

 private:
  int states_ = 0;
  std::vector<std::int64_t> counts_;
  std::vector<Eigen::MatrixXd> outer_, bounds_;
};

}  // namespace vigil
