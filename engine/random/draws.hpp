/// Addressable random numbers. A draw depends on its seed, the name of its stream, the tick and an index, and on
/// nothing else: not on threads, order, pauses, other lanes or other attacks. The laws are our own, since the standard
/// library's differ between builds.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "engine/random/philox.hpp"

namespace vigil {

/// One named stream of a seed. Cheap to copy; has no state.
/// Key = hash(seed); counter = (tick, hash(name), index, sub), where sub counts what one draw of a rejection law needs.
class Draws {
 public:
  Draws() = default;
  Draws(std::uint64_t seed, std::string_view stream);

  /// 128 random bits at an address. Ticks up to 2^47, sub below 2^16.
  PhiloxBlock block(std::int64_t tick, std::uint32_t index, std::uint32_t sub = 0) const;

  double uniform(std::int64_t tick, std::uint32_t index) const;                      ///< [0, 1), 53 bits
  bool bernoulli(std::int64_t tick, std::uint32_t index, double probability) const;  ///< true with that probability
  double normal(std::int64_t tick, std::uint32_t index) const;                       ///< N(0, 1), Box-Muller
  void normals(std::int64_t tick, Eigen::Ref<Eigen::VectorXd> out) const;      ///< N(0, I): out[i] is normal(tick, i)
  double laplace(std::int64_t tick, std::uint32_t index, double scale) const;  ///< density exp(-|x|/scale)/(2 scale)
  /// Shape a > 0, mean a * scale (Marsaglia and Tsang, 2000; below 1 by the power of a uniform).
  double gamma(std::int64_t tick, std::uint32_t index, double shape, double scale) const;
  double student(std::int64_t tick, std::uint32_t index,
                 double degrees) const;  ///< Student's t, degrees of freedom > 0
  /// With probability `share` N(0, outlier^2), else N(0, nominal^2): the mixture that stands for outliers.
  double mixture(std::int64_t tick, std::uint32_t index, double share, double nominal, double outlier) const;
  /// Uniform in the unit ball of out.size() dimensions; an ellipsoid {L u} is its image under L.
  void unit_ball(std::int64_t tick, Eigen::Ref<Eigen::VectorXd> out) const;

 private:
  double normal_at(std::int64_t tick, std::uint32_t index, std::uint32_t sub) const;
  PhiloxKey key_{};
  std::uint32_t name_ = 0;
};

}  // namespace vigil
