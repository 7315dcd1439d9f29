#include <cmath>

#include "engine/core/expectation.hpp"
#include "engine/core/params.hpp"

namespace vigil {
namespace {

Json type_words(const Param& param, Json words) {
  if (param.nullable) words.push_back("null");
  if (words.size() == 1) return words.front();
  return words;
}

void add_range(Json& schema, const Param& param) {
  if (std::isfinite(param.minimum)) schema[param.exclusive_minimum ? "exclusiveMinimum" : "minimum"] = param.minimum;
  if (std::isfinite(param.maximum)) schema[param.exclusive_maximum ? "exclusiveMaximum" : "maximum"] = param.maximum;
}

Json number_schema(const Param& param) {
  Json schema = {{"type", "number"}};
  add_range(schema, param);
  return schema;
}

Json vector_schema(const Param& param) {
  Json schema = {{"type", type_words(param, Json::array({"array"}))}, {"items", number_schema(param)}};
  schema["minItems"] = param.rows > 0 ? param.rows : 1;
  if (param.rows > 0) schema["maxItems"] = param.rows;
  return schema;
}

Json matrix_schema(const Param& param) {
  Json rows = {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}}};
  Json diagonal = {{"type", "array"}, {"minItems", 1}, {"items", number_schema(param)}};
  Json forms = Json::array({number_schema(param), std::move(diagonal), std::move(rows)});
  if (param.nullable) forms.push_back({{"type", "null"}});
  return {{"anyOf", std::move(forms)}};
}

Json text_schema(const Param& param) {
  Json schema = {{"type", type_words(param, Json::array({"string"}))}};
  if (param.choices.empty()) return schema;
  schema["enum"] = param.choices;
  if (param.nullable) schema["enum"].push_back(nullptr);
  return schema;
}

Json texts_schema(const Param& param) {
  return {{"type", type_words(param, Json::array({"array"}))},
          {"items", {{"type", "string"}, {"minLength", 1}}},
          {"minItems", 1}};
}

Json typed_schema(const Param& param) {
  switch (param.type) {
    case ParamType::boolean:
      return {{"type", type_words(param, Json::array({"boolean"}))}};
    case ParamType::text:
      return text_schema(param);
    case ParamType::texts:
      return texts_schema(param);
    case ParamType::vector:
      return vector_schema(param);
    case ParamType::matrix:
      return matrix_schema(param);
    case ParamType::object:
      return {{"type", type_words(param, Json::array({"object"}))}};
    case ParamType::real:
    case ParamType::integer:
      break;
  }
  Json schema = {{"type", type_words(param, Json::array({param.type == ParamType::integer ? "integer" : "number"}))}};
  add_range(schema, param);
  return schema;
}

Json bound(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace

Json ParamTable::schema() const {
  Json properties = Json::object();
  Json required = Json::array();
  for (const auto& param : params_) {
    Json leaf = typed_schema(param);
    if (!param.required) leaf["default"] = param.fallback;
    leaf["title"] = param.meaning.en;
    leaf["x-zh"] = param.meaning.zh;
    leaf["description"] = expectation(param);
    leaf["x-type"] = to_string(param.type);
    if (!param.unit.empty()) leaf["x-unit"] = param.unit;
    if (!param.symbol.empty()) leaf["x-symbol"] = param.symbol;
    leaf["x-live"] = param.live;
    properties[param.name] = std::move(leaf);
    if (param.required) required.push_back(param.name);
  }
  Json schema = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

Json ParamTable::to_json() const {
  Json list = Json::array();
  for (const auto& param : params_) {
    Json entry = {
        {"name", param.name}, {"type", to_string(param.type)}, {"unit", param.unit}, {"default", param.fallback}};
    entry["minimum"] = bound(param.minimum);
    entry["maximum"] = bound(param.maximum);
    entry["exclusive_minimum"] = param.exclusive_minimum;
    entry["exclusive_maximum"] = param.exclusive_maximum;
    entry["choices"] = param.choices;
    entry["rows"] = param.rows > 0 ? Json(param.rows) : Json(nullptr);
    entry["nullable"] = param.nullable;
    entry["required"] = param.required;
    entry["live"] = param.live;
    entry["symbol"] = param.symbol;
    entry["meaning"] = {{"en", param.meaning.en}, {"zh", param.meaning.zh}};
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace vigil
