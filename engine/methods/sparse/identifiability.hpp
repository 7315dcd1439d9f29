/// Can the attack be told from the state at all? Seed 001, Proposition 2, Theorem 1, Corollary 1; specification,
/// section 12.
#pragma once

#include "engine/core/json.hpp"
#include "engine/methods/method.hpp"

namespace vigil::sparse {

/// The report of every station for windows of T readings and q attacked channels, at the target's noise-free place
/// `time` seconds after the start:
/// {"time","q","dimension_ok","dimension":[2 q T, p T - n],"eigvec_support","phi_support","q_max","coherence",
///  "stations":[{"node","eigvec_support","phi_support","coherence"}]}. Supports are the least over the eigenvectors of
/// Abar (and over stations), the coherence the largest; an entry counts above 1e-9 of the largest.
Json identifiability(const Knowledge& knowledge, int T, int q, double time);

}  // namespace vigil::sparse
