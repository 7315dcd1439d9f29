/// Small JSON Schemas with words in both languages.
#pragma once

#include <string>
#include <utility>

#include "engine/core/json.hpp"
#include "engine/core/params.hpp"

namespace vigil::schema {

/// `base` ({"type":…}) with title, x-zh and, unless discarded, default.
inline Json leaf(Json base, const Words& words, const Json& fallback = Json(Json::value_t::discarded)) {
  base["title"] = words.en;
  base["x-zh"] = words.zh;
  if (!fallback.is_discarded()) base["default"] = fallback;
  return base;
}

/// An object with these members and no others.
inline Json object(Json properties, Json required = Json::array()) {
  Json result = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) result["required"] = std::move(required);
  return result;
}

/// An object whose keys match `pattern` and whose members follow `member`.
inline Json map(const std::string& pattern, Json member, std::size_t least, std::size_t most) {
  return {{"type", "object"},
          {"patternProperties", {{pattern, std::move(member)}}},
          {"additionalProperties", false},
          {"minProperties", least},
          {"maxProperties", most}};
}

inline Json reference(const std::string& definition) { return {{"$ref", "#/$defs/" + definition}}; }

}  // namespace vigil::schema
