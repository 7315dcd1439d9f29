/// Items as JSON.
#include <cmath>

#include "engine/papers/chinese.hpp"
#include "engine/papers/item.hpp"
#include "engine/scenario/method_page.hpp"

namespace vigil::papers {
namespace {

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json finite(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(finite(value));
  return list;
}

Json both(const Words& words) { return {{"en", words.en}, {"zh", words.zh}}; }

/// Chinese of a text, the text itself where the catalogue has none (a result of another version, say); no text stays.
Json in_chinese(const Json& text) {
  if (!text.is_string()) return text;
  const std::string found = chinese(text.get<std::string>());
  return found.empty() ? text : Json(found);
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

Json panel_words(const Json& panel) {
  Json names = Json::array();
  for (const Json& series : panel.at("series")) names.push_back(in_chinese(series.at("name")));
  return {{"title", in_chinese(panel.at("title"))},
          {"x", in_chinese(panel.at("x").at("label"))},
          {"y", in_chinese(panel.at("y").at("label"))},
          {"names", std::move(names)}};
}

}  // namespace

Json words_json(const Item& item, const Json& paper) {
  const ItemWords* words = chinese_words(item.key);
  if (words == nullptr) return nullptr;
  return {{"paper", in_chinese(paper)}, {"reason", std::string(words->reason)}, {"rule", std::string(words->rule)}};
}

Json to_json(const Item& item, const Findings& findings) {
  const Claim& head = headline_of(findings);
  Json claims = Json::array(), panels = Json::array();
  for (const Claim& claim : findings.claims) claims.push_back(to_json(claim));
  for (const Panel& panel : findings.panels) panels.push_back(to_json(panel));
  Json figure{{"rule", item.rule}, {"claims", std::move(claims)}, {"panels", std::move(panels)}};
  add_chinese(figure);
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
          {"zh", words_json(item, head.paper)},
          {"figure", std::move(figure)}};
}

Json basis_json(const Item& item) {
  Json scenes = Json::array(), methods = Json::array(), drawn = Json::array();
  for (const Scene& scene : item.basis().scenes)
    scenes.push_back({{"name", both(scene.name)}, {"scenario", scene.preset}, {"patch", scene.whole_patch()}});
  for (const std::string& id : item.methods())
    methods.push_back({{"id", id}, {"title", both(method_title(id).value_or(Words{id, id}))}});
  for (const std::string& id : item.basis().equations) {
    if (const Equation* equation = find_equation(id)) drawn.push_back(equation_json(*equation));
  }
  return {{"scenes", std::move(scenes)}, {"methods", std::move(methods)}, {"equations", std::move(drawn)}};
}

void add_chinese(Json& figure) {
  for (Json& claim : figure.at("claims"))
    claim["zh"] = {{"what", in_chinese(claim.at("what"))}, {"paper", in_chinese(claim.at("paper"))}};
  for (Json& panel : figure.at("panels")) panel["zh"] = panel_words(panel);
}

}  // namespace vigil::papers
