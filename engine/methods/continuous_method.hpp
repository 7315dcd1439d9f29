/// A method in continuous time: observers whose state flows along with the plant.
#pragma once

#include <Eigen/Core>

#include "engine/methods/method.hpp"

namespace vigil {

/// z' = slope(z, y, u), y: the readings of all nodes one after the other, u: the known inputs.
class ContinuousMethod : public Method {
 public:
  ContinuousMethod* continuous() final { return this; }
  const ContinuousMethod* continuous() const final { return this; }
  void predict(const Eigen::VectorXd& /*input*/, FaultReport& /*report*/) final {}

  virtual Eigen::VectorXd& flow_state() = 0;
  virtual const Eigen::VectorXd& flow_state() const = 0;
  virtual double fastest() const = 0;  ///< largest modulus of its poles, 1/s
  /// dz: as long as z. Allocates nothing.
  virtual void slope(const Eigen::Ref<const Eigen::VectorXd>& z, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                     Eigen::Ref<Eigen::VectorXd> dz) = 0;
  /// What it says at a tick, from its state and the readings then.
  virtual void settle(const Eigen::VectorXd& y, const Eigen::VectorXd& u) = 0;
};

}  // namespace vigil
