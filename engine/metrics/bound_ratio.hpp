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

/// Sums of outer products and bounds over runs, by tick and output. Runs that ended early count where they got to.
class BoundSums {
 public:
  void add(const BoundRecord& record);
  void add(const BoundSums& other);
  bool empty() const { return counts_.empty(); }
  /// As BoundRatio::max().
  double max() const;

  void save(ByteWriter& out) const;
  void load(ByteReader& in);

 private:
  void grow(std::size_t cells);

  int states_ = 0;
  std::vector<std::int64_t> counts_;
  std::vector<Eigen::MatrixXd> outer_, bounds_;
};

/// Runs are summed in blocks, and the blocks' sums in turn: who makes a whole block elsewhere sends its sums instead of
/// every run's records, and the bits are the same.
class BoundRatio {
 public:
  void add(const BoundRecord& record) { block_.add(record); }
  void add(const BoundSums& sums) { block_.add(sums); }
  /// The next run begins a new block.
  void close_block();
  /// The largest over ticks and outputs of lambda_max(L^-1 P L^-T), L L' = mean bound, P = mean of e e' (no mean
  /// removed). Infinity where a mean bound is not positive definite: never passed.
  double max() const;

  void save(ByteWriter& out) const;
  void load(ByteReader& in);

 private:
  BoundSums whole_, block_;
};

}  // namespace vigil
