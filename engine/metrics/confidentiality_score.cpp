#include "engine/metrics/confidentiality_score.hpp"

#include <cmath>

#include "engine/core/missing.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kParts = 5;  // the last of which is late

}  // namespace

SquareTally::SquareTally(std::optional<std::int64_t> last) : now_(kMissing) {
  if (last) late_from_ = *last - *last / kParts + 1;
}

void SquareTally::add(std::int64_t k, double square) {
  now_ = square;
  if (k < 1 || std::isnan(square)) return;
  sum_ += square;
  if (k < late_from_) return;
  late_ += square;
  ++count_;
}

double SquareTally::late_mean() const { return count_ > 0 ? late_ / static_cast<double>(count_) : kMissing; }

}  // namespace vigil
