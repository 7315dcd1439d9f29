/// How much worse off an eavesdropper is than the legitimate user. Seed 004, (4-10), (4-34); specification (privacy),
/// section 1.7.
#pragma once

#include <cstdint>

namespace vigil::privacy {

/// log2(eavesdropper / legitimate) of two traces of error covariances, or of two mean squared errors: negative where
/// the eavesdropper is better off. Infinite where one of them is zero or infinite and the other is not; NaN where
/// there is no ratio.
double confidentiality_index(double eavesdropper, double legitimate);

enum class ConfidentialityRank : std::uint8_t { low, relatively_low, medium, relatively_high, high };
/// Ranks begin at 1, 2, 4 and 8; a negative index, and one that is none, is low.
ConfidentialityRank confidentiality_rank(double index);
/// "relatively low", as the seed writes it.
const char* rank_name(ConfidentialityRank rank);

}  // namespace vigil::privacy
