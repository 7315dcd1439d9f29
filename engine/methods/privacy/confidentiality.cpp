#include "engine/methods/privacy/confidentiality.hpp"

#include <cmath>
#include <limits>

namespace vigil::privacy {

double confidentiality_index(double eavesdropper, double legitimate) {
  if (!(eavesdropper >= 0) || !(legitimate >= 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::log2(eavesdropper) - std::log2(legitimate);  // the ratio itself may overflow
}

ConfidentialityRank confidentiality_rank(double index) {
  if (index >= 8) return ConfidentialityRank::high;
  if (index >= 4) return ConfidentialityRank::relatively_high;
  if (index >= 2) return ConfidentialityRank::medium;
  if (index >= 1) return ConfidentialityRank::relatively_low;
  return ConfidentialityRank::low;
}

const char* rank_name(ConfidentialityRank rank) {
  switch (rank) {
    case ConfidentialityRank::high:
      return "high";
    case ConfidentialityRank::relatively_high:
      return "relatively high";
    case ConfidentialityRank::medium:
      return "medium";
    case ConfidentialityRank::relatively_low:
      return "relatively low";
    case ConfidentialityRank::low:
      break;
  }
  return "low";
}

}  // namespace vigil::privacy
