/// Given signals of time in pieces, closed on the right. Specification (observer), section 7.
#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace vigil::observer {

/// offset + slope t + sine sin(rate t + phase) + cosine cos(rate t + phase), up to and with t = until.
struct Piece {
  double until = std::numeric_limits<double>::infinity();  ///< s
  double offset = 0;
  double slope = 0;
  double sine = 0;
  double cosine = 0;
  double rate = 0;   ///< rad/s
  double phase = 0;  ///< rad
};

/// Pieces in order of time; the first also holds before 0, the last beyond its end. Without pieces: zero.
class Signal {
 public:
  Signal() = default;
  explicit Signal(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}
  /// The value at t of the piece in force at `branch`: a step of integration takes its own midpoint for that, a sample
  /// t.
  double value(double t, double branch) const;
  double value(double t) const { return value(t, t); }
  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  std::vector<Piece> pieces_;
};

/// One signal an entry, for each kind of input of a subsystem.
struct SubsystemSignals {
  std::vector<Signal> u, w, d, f;  ///< m, q, dd, g of them; fewer: the rest is zero
};

}  // namespace vigil::observer
