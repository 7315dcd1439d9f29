#include <algorithm>

#include "server/hub/feed.hpp"

namespace vigil {

const Feed::KeptMark* Feed::mark_from(std::uint64_t sequence) const {
  const auto found = std::lower_bound(marks_.begin(), marks_.end(), sequence,
                                      [](const KeptMark& mark, std::uint64_t at) { return mark.sequence < at; });
  return found == marks_.end() ? nullptr : &*found;
}

std::uint64_t Feed::mark_after_tick(std::int64_t k) const {
  const auto found = std::find_if(marks_.begin(), marks_.end(), [k](const KeptMark& mark) { return mark.k > k; });
  return found == marks_.end() ? end() : found->sequence;
}

std::optional<std::uint64_t> Feed::position_after(std::size_t topic, std::int64_t k) const {
  if (k > head_tick_) return std::nullopt;
  const Kind kind = global() ? Kind::mark : Kind::frame;
  const std::uint64_t lowest = low(topic);
  // From the newest back: whoever resumes was here a moment ago.
  std::optional<std::uint64_t> next;
  for (std::uint64_t at = end(); at > first_; --at) {
    const Item& candidate = item(at - 1);
    if (candidate.kind != kind) continue;
    if (candidate.k <= k) return at >= lowest ? std::optional(at) : std::nullopt;
    next = at - 1;
  }
  if (!next) return k == head_tick_ ? std::optional(end()) : std::nullopt;
  const bool contiguous = item(*next).k - item(*next).n <= k;
  return contiguous && *next >= lowest ? next : std::nullopt;
}

}  // namespace vigil
