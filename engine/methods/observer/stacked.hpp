/// The observers of all subsystems as one linear map with nonlinearities on top. Specification (observer), sections 3
/// and 8.2.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/methods/observer/augment.hpp"

namespace vigil::observer {

/// z: the states of every subsystem's observer, one after the other; y: the outputs, u: the known inputs, likewise.
class StackedObserver {
 public:
  StackedObserver() = default;
  /// Seed 002, (9)-(13), by gains L = [L1; L2].
  static StackedObserver intermediate(const Network& network, const Gains& gains);
  /// The matched unknown-input observer; L: n x p. It knows no nonlinearity: for plants without one.
  static StackedObserver matched(const Network& network, const Gains& gains);

  int size() const { return static_cast<int>(slope_.rows()); }                          ///< of z
  int outputs() const { return outputs_y_; }                                            ///< of y
  int inputs() const { return static_cast<int>(slope_.cols()) - size() - outputs_y_; }  ///< of u
  /// The fastest pole of the errors, 1/s.
  double fastest() const { return fastest_; }

  /// dz: size(). Allocates nothing.
  void slope(const Eigen::Ref<const Eigen::VectorXd>& z, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
             Eigen::Ref<Eigen::VectorXd> dz);

  /// What one subsystem's observer says.
  struct Said {
    Eigen::VectorXd xhat, what, fhat;  ///< fhat is empty where the observer has none
    Eigen::VectorXd innovation;        ///< y - C xhat - G fhat
  };
  /// Sizes `said`, of every subsystem, at the first call; allocates nothing after that.
  void say(const Eigen::Ref<const Eigen::VectorXd>& z, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
           std::vector<Said>& said);

 private:
  friend class ObserverBuilder;
  struct Rows {
    Eigen::MatrixXd xhat, what, fhat, innovation;
  };
  void stack(const Eigen::Ref<const Eigen::VectorXd>& z, const Eigen::VectorXd& y, const Eigen::VectorXd& u);

  std::vector<Subsystem> subsystems_;
  Eigen::MatrixXd slope_;       ///< over [z; y; u]
  std::vector<Rows> rows_;      ///< over the same
  Eigen::MatrixXd arguments_;   ///< xhat of the subsystems with a nonlinearity
  Eigen::MatrixXd entrances_;   ///< where their Phi(xhat) enter dz
  std::vector<int> nonlinear_;  ///< those subsystems
  int outputs_y_ = 0;
  double fastest_ = 0;
  Eigen::VectorXd stacked_, argument_, phi_;
};

}  // namespace vigil::observer
