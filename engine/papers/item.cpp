#include "engine/papers/item.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vigil::papers {
namespace {

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json finite(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(finite(value));
  return list;
}

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

Json to_json(const Axis& axis) { return {{"label", axis.label}, {"scale", axis.log ? "log" : "linear"}}; }

Json to_json(const Panel& panel) {
  Json series = Json::array();
  for (const Series& one : panel.series)
    series.push_back({{"name", one.name}, {"style", one.style}, {"x", finite(one.x)}, {"y", finite(one.y)}});
  return {{"title", panel.title}, {"x", to_json(panel.x)}, {"y", to_json(panel.y)}, {"series", std::move(series)}};
}

Json to_json(const Claim& claim) {
  return {{"reading", to_string(claim.reading)}, {"what", claim.what},          {"paper", claim.paper},
          {"ours", finite(claim.ours.value)},    {"se", finite(claim.ours.se)}, {"low", finite(claim.low)},
          {"high", finite(claim.high)},          {"holds", claim.holds()}};
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

Json to_json(const Item& item, const Findings& findings) {
  const Claim& head = headline_of(findings);
  Json claims = Json::array(), panels = Json::array();
  for (const Claim& claim : findings.claims) claims.push_back(to_json(claim));
  for (const Panel& panel : findings.panels) panels.push_back(to_json(panel));
  return {{"key", item.key},
          {"title", {{"en", item.title.en}, {"zh", item.title.zh}}},
          {"paper", head.paper},
          {"ours", finite(head.ours.value)},
          {"se", finite(head.ours.se)},
          {"verdict", to_string(verdict_of(findings))},
          {"reason", item.reason},
          {"runs", findings.runs},
          {"scenario", item.scenario},
          {"spec", item.spec},
          {"figure", {{"rule", item.rule}, {"claims", std::move(claims)}, {"panels", std::move(panels)}}}};
}

}  // namespace vigil::papers
