/// A node's last T readings, and the regression they give for the deviation of its prior. Seed 001, eq. (4), Theorem 1;
/// specification, section 7.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/linalg/small.hpp"
#include "engine/world/sensor.hpp"

namespace vigil::sparse {

/// Where the window is linearised: along the trajectory through the present prior, all of it at the present prior, or
/// each reading at the prior it met.
enum class Linearisation { prior, current, frozen };

/// The plant's constant transition with what a window needs of it. Abar = F.
class Transition {
 public:
  Transition() = default;
  /// Throws InputError ("/T") where F cannot be inverted.
  Transition(const Eigen::MatrixXd& F, int window);
  const BoundedMatrix& inverse() const { return inverse_; }
  const BoundedMatrix& power(int j) const { return powers_[static_cast<std::size_t>(j)]; }  ///< F^j, j < window

 private:
  BoundedMatrix inverse_;
  std::vector<BoundedMatrix> powers_;
};

/// r = Phi dx + E + noise, with what is left when the state is projected out. Sample-major: p rows a reading, oldest
/// first. One is shared by all nodes of a lane.
struct Regression {
  Regression() = default;
  Regression(int channels, int window, int states);

  Eigen::VectorXd r;       ///< p T, wrapped innovations
  Eigen::MatrixXd Phi;     ///< p T x n
  BoundedMatrix whiten;    ///< W, p x p: the identity where R is sigma^2 I, else L^-1 of R = L L'
  double sigma = 1;        ///< std of a whitened channel
  Eigen::MatrixXd Q1;      ///< p T x n, orthonormal basis of W Phi
  Eigen::VectorXd left;    ///< M W r, M = I - Q1 Q1'
  double statistic = 0;    ///< ||M W r||
  bool observable = true;  ///< W Phi has full column rank; where not, Q1 and left mean nothing
};

/// The readings of one node.
class Window {
 public:
  Window(std::shared_ptr<const Sensor> sensor, int length, Linearisation where, bool as_printed);

  /// Takes a complete finite reading; `prior` is the node's prediction at its tick (states).
  void push(const Eigen::VectorXd& reading, const BoundedVector& prior);
  void clear() { count_ = 0; }
  bool full() const { return count_ == length_; }

  /// Fills `regression` at the present prior. Only where full(). Allocates nothing.
  void regress(const BoundedVector& prior, const Transition& transition, Regression& regression);

  /// Innovation and derivative of the newest reading at the present prior.
  void newest(const BoundedVector& prior, BoundedVector& innovation, BoundedMatrix& C) const;

 private:
  BoundedVector innovation(int slot, const BoundedVector& point) const;
  void jacobian(const BoundedVector& x, BoundedMatrix& C) const;
  void linearise(int slot, const BoundedVector& z, const BoundedMatrix& current, BoundedVector& r,
                 BoundedMatrix& C) const;
  int slot_of(int j) const { return (next_ + j) % length_; }  ///< of the j-th oldest

  std::shared_ptr<const Sensor> sensor_;
  int length_;
  Linearisation where_;
  bool as_printed_;
  Eigen::MatrixXd readings_;  ///< p x T, a ring
  Eigen::MatrixXd met_;       ///< n x T: the priors the readings met
  int next_ = 0, count_ = 0;
  BoundedMatrix whiten_;
  double sigma_ = 1;
};

/// Splits the columns of A (rows x n) off an orthonormal basis Q1 by Gram-Schmidt, each column twice. False where the
/// rank is deficient: a pivot below 1e-10 of the largest.
bool orthonormalise(const Eigen::MatrixXd& A, Eigen::MatrixXd& Q1);

}  // namespace vigil::sparse
