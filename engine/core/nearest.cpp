#include <algorithm>
#include <cctype>

#include "engine/core/params.hpp"

namespace vigil {
namespace {

constexpr std::size_t kLongest = 64;

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Damerau-Levenshtein distance (optimal string alignment): insertions, deletions, substitutions, swaps of neighbours.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

bool begins(const std::string& text, const std::string& prefix) {
  return prefix.size() >= 2 && text.compare(0, prefix.size(), prefix) == 0;
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.empty() || word.size() > kLongest) return {};
  const std::string mine = lower(word);
  std::string best;
  std::size_t best_distance = 0;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongest) continue;
    const std::string theirs = lower(candidate);
    const std::size_t far = distance(mine, theirs);
    const std::size_t limit = std::max<std::size_t>(1, std::max(mine.size(), theirs.size()) / 2);
    const bool same_beginning = begins(theirs, mine) || begins(mine, theirs);
    const bool nothing_shared = far >= std::max(mine.size(), theirs.size());
    if ((far > limit && !same_beginning) || (nothing_shared && !same_beginning)) continue;
    if (best.empty() || far < best_distance) {
      best = candidate;
      best_distance = far;
    }
  }
  return best;
}

}  // namespace vigil
