#include "engine/papers/item.hpp"

#include <algorithm>
#include <stdexcept>

namespace vigil::papers {
namespace {

/// Whether there is a claim on this reading, and all of them hold.
bool stands(const std::vector<Claim>& claims, Reading reading) {
  bool some = false;
  for (const Claim& claim : claims) {
    if (claim.reading != reading) continue;
    if (!claim.holds()) return false;
    some = true;
  }
  return some;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::corrected:
      return "reproduced after correction";
    case Verdict::not_reproduced:
      break;
  }
  return "not reproduced";
}

std::string_view to_string(Reading reading) {
  switch (reading) {
    case Reading::printed:
      return "as printed";
    case Reading::corrected:
      return "corrected";
    case Reading::noted:
      break;
  }
  return "noted";
}

void Findings::claim(Reading reading, std::string what, Json paper, Estimate ours, double low, double high) {
  claims.push_back({reading, std::move(what), std::move(paper), ours, low, high});
}

Verdict verdict_of(const Findings& findings) {
  if (stands(findings.claims, Reading::printed)) return Verdict::reproduced;
  return stands(findings.claims, Reading::corrected) ? Verdict::corrected : Verdict::not_reproduced;
}

const Claim& headline_of(const Findings& findings) {
  const auto& claims = findings.claims;
  const auto first = [&](Reading reading) {
    return std::find_if(claims.begin(), claims.end(), [&](const Claim& c) { return c.reading == reading; });
  };
  if (verdict_of(findings) != Verdict::reproduced) {
    if (const auto corrected = first(Reading::corrected); corrected != claims.end()) return *corrected;
  }
  const auto printed = first(Reading::printed);
  if (printed == claims.end()) throw std::logic_error("an item without a claim");
  return *printed;
}

const std::vector<Item>& items() {
  static const std::vector<Item> all = [] {
    std::vector<Item> list;
    for (const auto& family : {consensus_items(), sparse_items(), observer_items(), replay_items(), privacy_items()})
      list.insert(list.end(), family.begin(), family.end());
    return list;
  }();
  return all;
}

const Basis& Item::basis() const {
  const Basis* found = basis_of(key);
  if (found == nullptr) throw std::logic_error(key + " stands on nothing");
  return *found;
}

std::vector<std::string> Item::methods() const {
  std::vector<std::string> all;
  for (const Scene& scene : basis().scenes) {
    for (const std::string& id : scene.methods()) {
      if (std::find(all.begin(), all.end(), id) == all.end()) all.push_back(id);
    }
  }
  return all;
}

}  // namespace vigil::papers
