/// Plants in continuous time: x' = slope(x, v), y = output(x, v), where v is all that drives them. A tick of dt seconds
/// integrates; see run/flow.hpp.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {

/// Where one node's drives stand in v, and how many of each there are: known inputs u, attacks on actuators w,
/// disturbances d, sensor faults f, in this order.
struct DrivePorts {
  int first = 0;
  int u = 0, w = 0, d = 0, f = 0;
  int at_w() const { return first + u; }
  int at_d() const { return at_w() + w; }
  int at_f() const { return at_d() + d; }
  int end() const { return at_f() + f; }
};

/// Immutable and shared between threads, as every plant.
class ContinuousPlant : public Plant {
 public:
  const ContinuousPlant* continuous() const final { return this; }

  virtual const std::vector<DrivePorts>& ports() const = 0;  ///< one a node
  int drives() const { return ports().empty() ? 0 : ports().back().end(); }
  virtual int outputs() const = 0;  ///< of all nodes' sensors together
  /// x: states; v: drives; dx: states. Allocates nothing.
  virtual void slope(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& v,
                     Eigen::Ref<Eigen::VectorXd> dx) const = 0;
  /// y: outputs, node after node. Allocates nothing.
  virtual void output(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& v,
                      Eigen::Ref<Eigen::VectorXd> y) const = 0;
  /// Of the slope, by states and known inputs; what is not linear is left out.
  virtual LinearModel linear_part() const = 0;
  virtual double fastest() const = 0;  ///< largest modulus of its poles, 1/s
  /// Throws InputError under /nodes where these are not the nodes that the plant is made of.
  virtual void check_nodes(const std::vector<std::string>& nodes,
                           const std::vector<std::shared_ptr<const Sensor>>& sensors) const = 0;
};

}  // namespace vigil
