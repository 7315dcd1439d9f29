/// The plant: what moves, and the model of it that every node knows.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/params.hpp"
#include "engine/core/registry.hpp"

namespace vigil {

/// One scalar of a state, input or reading.
struct Component {
  std::string name;
  std::string unit;
  double period = 0;  ///< of an angle, in its unit; 0: not an angle
};

/// A group of state components whose error is scored together: "position" is (x, y), "heading" is theta.
struct ErrorGroup {
  std::string name;
  std::vector<int> components;
  std::string unit;
};

class ContinuousPlant;

/// x+ = A x + B u, or x' = A x + B u in continuous time.
struct LinearModel {
  Eigen::MatrixXd A;  ///< states x states
  Eigen::MatrixXd B;  ///< states x inputs
};

/// x(k) = f(x(k-1), u(k)) + w, w ~ N(0, Q). Immutable and shared.
class Plant {
 public:
  virtual ~Plant() = default;
  virtual const std::vector<Component>& state() const = 0;
  virtual const std::vector<Component>& input() const = 0;  ///< known inputs, may be empty
  virtual const std::vector<ErrorGroup>& errors()
      const = 0;  ///< the first is the "position-like" one of the signal `error`
  /// next = f(x, u), without noise. x, next: states; u: inputs (row k: what acted from tick k-1 to k).
  virtual void advance(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& u,
                       Eigen::Ref<Eigen::VectorXd> next) const = 0;
  /// F = df/dx at (x, u), states x states.
  virtual void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& u,
                        Eigen::Ref<Eigen::MatrixXd> F) const = 0;

  /// True where advance() is x -> F x with a constant F: what windowed regressions need.
  virtual bool linear() const { return false; }

  /// Null: its time goes in ticks.
  virtual const ContinuousPlant* continuous() const { return nullptr; }

  int states() const { return static_cast<int>(state().size()); }
  int inputs() const { return static_cast<int>(input().size()); }
};

using PlantMake = std::shared_ptr<const Plant> (*)(const Params& params, double dt);

/// The value mapped to [-period/2, period/2); unchanged where period is 0.
double wrap(double value, double period);

}  // namespace vigil
