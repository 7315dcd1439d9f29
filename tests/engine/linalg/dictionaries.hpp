/// Random dictionaries and signals for the sparse solvers' tests.
#pragma once

#include <Eigen/QR>
#include <cmath>
#include <cstdint>

#include "engine/random/draws.hpp"

namespace vigil::dictionaries {

/// Everything of a trial from one number.
class Trial {
 public:
  explicit Trial(std::int64_t number) : draws_(1, "dictionaries"), number_(number) {}

  double uniform() { return draws_.uniform(number_, next_++); }
  double normal() { return draws_.normal(number_, next_++); }
  int below(int count) { return static_cast<int>(uniform() * count); }

  Eigen::MatrixXd gaussian(int rows, int columns);

  /// `count` entries that are not zero, of either sign, between `least` and `most` in size (log-uniform).
  Eigen::VectorXd sparse(int columns, int count, double least, double most);

  /// Q2' of a random regression of `columns` readings on `states` unknowns: rows are orthonormal. Specification,
  /// section 7.
  Eigen::MatrixXd orthonormal(int columns, int states);

 private:
  Draws draws_;
  std::int64_t number_;
  std::uint32_t next_ = 0;
};

/// Sylvester's matrix of the order 2^power, its columns of unit length.
Eigen::MatrixXd hadamard(int power);

/// The largest |cosine| between two columns.
double coherence(const Eigen::MatrixXd& D);

}  // namespace vigil::dictionaries
