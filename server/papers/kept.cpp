#include "server/papers/kept.hpp"

#include <limits>

namespace vigil::papers {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

double number(const Json& json, double otherwise = kNaN) { return json.is_number() ? json.get<double>() : otherwise; }

std::vector<double> numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& value : list) values.push_back(number(value));
  return values;
}

Reading reading_of(const Json& word) {
  for (const Reading reading : {Reading::printed, Reading::corrected}) {
    if (word == to_string(reading)) return reading;
  }
  return Reading::noted;
}

Axis axis_of(const Json& json) { return {json.at("label").get<std::string>(), json.at("scale") == "log"}; }

Panel panel_of(const Json& json) {
  Panel panel{json.at("title").get<std::string>(), axis_of(json.at("x")), axis_of(json.at("y")), {}};
  for (const Json& series : json.at("series")) {
    panel.series.push_back({series.at("name").get<std::string>(), numbers(series.at("x")), numbers(series.at("y")),
                            series.at("style").get<std::string>()});
  }
  return panel;
}

}  // namespace

Json described(const Item& item) {
  Json json{{"key", item.key},   {"title", {{"en", item.title.en}, {"zh", item.title.zh}}},
            {"spec", item.spec}, {"scenario", item.scenario},
            {"rule", item.rule}, {"reason", item.reason}};
  for (const char* member : {"paper", "ours", "se", "verdict", "runs", "seed", "version", "ended"})
    json[member] = nullptr;
  json["zh"] = words_json(item, nullptr);
  const Json basis = basis_json(item);
  for (const char* member : {"scenes", "methods"}) json[member] = basis.at(member);
  return json;
}

Json described(const Item& item, const Json& kept) {
  Json json = described(item);
  for (auto& [member, value] : json.items()) {
    if (value.is_null() && kept.contains(member)) value = kept.at(member);
  }
  json["zh"] = words_json(item, json.at("paper"));
  return json;
}

Json detailed(const Item& item, const Json& kept) {
  Json json = described(item, kept);
  json["equations"] = basis_json(item).at("equations");
  json["figure"] = kept.value("figure", Json());
  if (json["figure"].is_object()) add_chinese(json["figure"]);
  return json;
}

Findings findings_of(const Json& json) {
  Findings findings;
  findings.runs = json.at("runs").get<std::int64_t>();
  const Json& figure = json.at("figure");
  for (const Json& claim : figure.at("claims")) {
    findings.claim(reading_of(claim.at("reading")), claim.at("what").get<std::string>(), claim.at("paper"),
                   {number(claim.at("ours")), number(claim.at("se"))}, number(claim.at("low"), -kInfinite),
                   number(claim.at("high"), kInfinite));
  }
  for (const Json& panel : figure.at("panels")) findings.panels.push_back(panel_of(panel));
  return findings;
}

}  // namespace vigil::papers
