/// Noise of a plant or a sensor: a random part with a law, and a bounded part that stays in an ellipsoid. Seed 003,
/// section 4; specification of seed 003, section 3.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/params.hpp"
#include "engine/random/draws.hpp"

namespace vigil {

/// Laws of the random part, each with mean 0 and variance 1 before the covariance's factor.
enum class Law { gauss, gmix, skewmix, laplace, gamma, student };
/// How the bounded part is drawn: uniform in the ellipsoid, uniform on its surface, or turning on its surface.
enum class BoundedLaw { uniform, surface, sine };

const std::vector<std::string>& law_names();          ///< in the order of Law
const std::vector<std::string>& bounded_law_names();  ///< in the order of BoundedLaw
Words law_words(Law law);                             ///< what it is, for people
Law law_of(std::string_view name);                    ///< gauss where the name is unknown
BoundedLaw bounded_law_of(std::string_view name);     ///< uniform where the name is unknown

/// Draws one vector a tick. Immutable.
class NoiseSource {
 public:
  NoiseSource() = default;
  /// covariance, shape: n x n, positive semidefinite; the bounded part w has w' shape^-1 w <= 1. `stream` names the
  /// draws; the two parts have streams of their own.
  NoiseSource(const Eigen::MatrixXd& covariance, Law law, const Eigen::MatrixXd& shape, BoundedLaw bounded,
              std::uint64_t seed, const std::string& stream);
  /// out: n. No allocation.
  void draw(std::int64_t k, Eigen::Ref<Eigen::VectorXd> out) const;

 private:
  double standard(std::int64_t k, std::uint32_t index) const;
  void add_bounded(std::int64_t k, Eigen::Ref<Eigen::VectorXd> out) const;

  Eigen::MatrixXd factor_, shape_factor_;
  Law law_ = Law::gauss;
  BoundedLaw bounded_ = BoundedLaw::uniform;
  bool random_ = false, has_bounded_ = false;
  double phase_ = 0;  ///< of the turning one
  Draws draws_, branches_, directions_;
};

}  // namespace vigil
