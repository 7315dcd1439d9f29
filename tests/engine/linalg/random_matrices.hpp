/// Random matrices for the tests of linear algebra: everything of a case from one number.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <cstdint>

#include "engine/random/draws.hpp"

namespace vigil {

class RandomMatrices {
 public:
  explicit RandomMatrices(std::int64_t number) : draws_(1, "matrices"), number_(number) {}

  double uniform() { return draws_.uniform(number_, next_++); }
  double normal() { return draws_.normal(number_, next_++); }
  int below(int count) { return static_cast<int>(uniform() * count); }
  double log_uniform(double least, double most) { return least * std::pow(most / least, uniform()); }

  Eigen::MatrixXd gaussian(Eigen::Index rows, Eigen::Index columns);
  Eigen::VectorXd vector(Eigen::Index size);
  Eigen::MatrixXd orthogonal(Eigen::Index n);
  /// Of the given rank, its other eigenvalues between 0.1 and 10.
  Eigen::MatrixXd semidefinite(Eigen::Index n, Eigen::Index rank);
  Eigen::MatrixXd definite(Eigen::Index n);

 private:
  Draws draws_;
  std::int64_t number_;
  std::uint32_t next_ = 0;
};

}  // namespace vigil
