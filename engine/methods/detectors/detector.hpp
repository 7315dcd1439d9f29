/// A detector that can be attached to any lane with an innovation: it judges one output, and knows of it no more than
/// the innovation and its covariance.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "engine/core/params.hpp"
#include "engine/core/registry.hpp"
#include "engine/methods/method.hpp"

namespace vigil {

/// A value. Memory is taken at the first innovation, afterwards judging allocates nothing.
class Detector {
 public:
  virtual ~Detector() = default;
  virtual std::unique_ptr<Detector> clone() const = 0;
  /// Tick k = 1, 2, …. innovation: channels; covariance: channels x channels, of the innovation without attack; empty
  /// where the lane says none (then only detectors of its norm judge).
  virtual Detection judge(std::int64_t k, const Eigen::Ref<const Eigen::VectorXd>& innovation,
                          const Eigen::Ref<const Eigen::MatrixXd>& covariance) = 0;
  /// A tick without an innovation.
  virtual Detection hold() { return {}; }
  /// Ticks after an attack whose statistic still holds innovations of it.
  virtual int tail() const { return 0; }
  /// Takes the live values of complete parameters; what it has gathered stays. Throws like its making.
  virtual void retune(const Params& params) = 0;
};

/// Throws InputError with pointers relative to the params.
using DetectorMake = std::unique_ptr<Detector> (*)(const Params& params);

/// r' S^-1 r. A value with room for the decomposition.
class NormalisedSquare {
 public:
  /// NaN where S is empty or not positive definite.
  double operator()(const Eigen::Ref<const Eigen::VectorXd>& r, const Eigen::Ref<const Eigen::MatrixXd>& S);

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_{Eigen::MatrixXd::Identity(1, 1)};  ///< one that never was made must not be copied
  Eigen::VectorXd whitened_;
};

}  // namespace vigil
