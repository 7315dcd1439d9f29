/// Gains without a semidefinite program: one Riccati equation a subsystem. Specification (observer), section 6.
#pragma once

#include <optional>

#include "engine/methods/observer/augment.hpp"

namespace vigil::observer {

/// Weights of d and Phi (qd, qf) and of w' (qw).
struct RiccatiWeights {
  double qd = 1e4, qf = 1e4, qw = 1e6;
};
/// Nothing where some subsystem's equation has no stabilising answer. The coupling plays no part: only a certificate
/// tells whether the whole network is stable.
std::optional<Gains> riccati_gains(const Network& network, const RiccatiWeights& weights);

}  // namespace vigil::observer
