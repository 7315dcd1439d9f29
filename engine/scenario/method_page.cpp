#include "engine/scenario/method_page.hpp"

#include "engine/core/expectation.hpp"
#include "engine/core/mathml.hpp"
#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/words.hpp"

namespace vigil {
namespace {

Json both(const Words& words) { return {{"en", words.en}, {"zh", words.zh}}; }

Json parameters(const ParamTable& params) {
  Json list = Json::array();
  for (const Param& param : params.all()) {
    list.push_back({{"name", param.name},
                    {"symbol", param.symbol},
                    {"default", param.required ? Json() : param.fallback},
                    {"required", param.required},
                    {"unit", param.unit},
                    {"accepts", expectation(param)},
                    {"live", param.live},
                    {"meaning", both(param.meaning)}});
  }
  return list;
}

Json corrections(const MethodWords& words, const ParamTable& params) {
  Json list = Json::array();
  for (const Correction& one : words.corrected) {
    Json json{{"text", one.text}, {"parameter", nullptr}};
    if (const Param* param = params.find(one.parameter)) {
      json["parameter"] = one.parameter;
      json["value"] = one.value;
      json["printed"] = one.reading == Reading::printed;
      json["usual"] = param->fallback == one.value;
    }
    list.push_back(std::move(json));
  }
  return list;
}

struct Kind {
  const char* name;
  const char* where;
};
constexpr Kind kMethod{"method", "lanes.<id>.method"}, kProtection{"protection", "lanes.<id>.protection.type"},
    kDetector{"detector", "lanes.<id>.detector.type"};

template <class Make>
Json head(const Entry<Make>& entry, const FamilyWords& found, const Kind& kind) {
  return {{"id", entry.id},
          {"kind", kind.name},
          {"title", both(entry.title)},
          {"family", found.family},
          {"line", found.words.line}};
}

template <class Make>
Json page(std::string_view id, const Kind& kind) {
  const Entry<Make>* entry = Registry<Make>::find(id);
  const FamilyWords* found = find_words(id);
  if (entry == nullptr || found == nullptr) return nullptr;
  Json json = head(*entry, *found, kind);
  json["source"] = entry->source;
  json["where"] = kind.where;
  json["model"] = found->words.model;
  json["equations"] = Json::array();
  for (const Equation* one : equations_of(id)) json["equations"].push_back(equation_json(*one));
  json["steps"] = found->words.steps;
  json["parameters"] = parameters(entry->params);
  json["cost"] = found->words.cost;
  json["corrected"] = corrections(found->words, entry->params);
  return json;
}

template <class Make>
void list(const Kind& kind, Json& items) {
  for (const auto& entry : Registry<Make>::all()) {
    if (const FamilyWords* found = find_words(entry.id)) items.push_back(head(entry, *found, kind));
  }
}

template <class Make>
std::optional<Words> title(std::string_view id) {
  const Entry<Make>* entry = Registry<Make>::find(id);
  return entry == nullptr ? std::nullopt : std::optional(entry->title);
}

}  // namespace

Json method_page(std::string_view id) {
  if (Json json = page<MethodMake>(id, kMethod); !json.is_null()) return json;
  if (Json json = page<ProtectionMake>(id, kProtection); !json.is_null()) return json;
  return page<DetectorMake>(id, kDetector);
}

Json method_index() {
  Json items = Json::array();
  list<MethodMake>(kMethod, items);
  list<ProtectionMake>(kProtection, items);
  list<DetectorMake>(kDetector, items);
  return {{"items", std::move(items)}};
}

std::optional<Words> method_title(std::string_view id) {
  if (auto found = title<MethodMake>(id)) return found;
  if (auto found = title<ProtectionMake>(id)) return found;
  return title<DetectorMake>(id);
}

Json equation_json(const Equation& equation) {
  return {{"id", equation.id},
          {"number", equation.number.text},
          {"corrected", equation.number.corrected},
          {"says", both(equation.says)},
          {"tex", equation.tex},
          {"mathml", mathml(equation.tex)}};
}

}  // namespace vigil
