/// What differential privacy at the sensors costs over its parameters: figures 3-4 and 3-5 of seed 004.
#pragma once

#include "engine/core/json.hpp"
#include "engine/methods/privacy/dp_fusion.hpp"

namespace vigil::privacy {

/// Traces of the public (pdfe) and of the legitimate (cdfe) fused estimate, all else as in the design:
/// {"kappa": {values, pdfe, cdfe}, "epsilon_delta": {epsilon, delta, pdfe, cdfe}}, the latter with one row an epsilon.
/// q_total must be above 0.
Json dp_surfaces(const DpFusion& design, const DpSettings& settings);

}  // namespace vigil::privacy
