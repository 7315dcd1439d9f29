/// A sensor: what one node measures of the plant.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/params.hpp"
#include "engine/core/registry.hpp"
#include "engine/world/plant.hpp"

namespace vigil {

/// z = h(x) + v, v random with covariance R and, where there is one, a bounded part in an ellipsoid. Immutable and
/// shared.
class Sensor {
 public:
  virtual ~Sensor() = default;
  virtual const std::vector<Component>& channels() const = 0;
  virtual const Eigen::MatrixXd& noise() const = 0;  ///< R, channels x channels, positive definite
  /// True where R may be singular, even zero.
  virtual bool may_be_exact() const { return false; }
  /// Shape of the ellipsoid of the bounded noise, channels x channels; zero: none.
  virtual Eigen::MatrixXd bounded_noise() const { return Eigen::MatrixXd::Zero(size(), size()); }
  virtual bool linear() const { return false; }  ///< measure() is x -> H x with a constant H
  virtual std::optional<Eigen::Vector2d> position() const {
    return std::nullopt;
  }  ///< in the plant's plane, its length unit
  /// z = h(x), without noise.
  virtual void measure(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const = 0;
  /// H = dh/dx at x, channels x states.
  virtual void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> H) const = 0;
  /// The derivative as its source prints it, where that differs from the true one.
  virtual void jacobian_as_printed(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> H) const {
    jacobian(x, H);
  }
  /// True where the derivative at x was limited so as to stay finite: the reading teaches nothing reliable there.
  virtual bool limited(const Eigen::Ref<const Eigen::VectorXd>& /*x*/) const { return false; }

  int size() const { return static_cast<int>(channels().size()); }
};

/// Throws InputError (pointers relative to the params) for what the table cannot check.
using SensorMake = std::shared_ptr<const Sensor> (*)(const Params& params, const Plant& plant);

}  // namespace vigil
