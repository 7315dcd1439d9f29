#include "engine/world/interconnected/signals.hpp"

#include <cmath>

namespace vigil::observer {

double Signal::value(double t, double branch) const {
  if (pieces_.empty()) return 0;
  std::size_t at = 0;
  // A tick's time is a product and may miss the end of its piece by rounding.
  while (at + 1 < pieces_.size() && branch > pieces_[at].until + 1e-9) ++at;
  const Piece& piece = pieces_[at];
  double value = piece.offset + piece.slope * t;
  if (piece.sine != 0) value += piece.sine * std::sin(piece.rate * t + piece.phase);
  if (piece.cosine != 0) value += piece.cosine * std::cos(piece.rate * t + piece.phase);
  return value;
}

}  // namespace vigil::observer
