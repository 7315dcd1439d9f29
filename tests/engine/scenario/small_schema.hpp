/// A JSON Schema validator for the keywords that Vigil's schemas use; any other keyword is a failure of the test
/// itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

#include "engine/core/json.hpp"

namespace vigil {

class SmallSchema {
 public:
  explicit SmallSchema(const Json& root) : root_(root) {}

  /// "" where the value follows the schema, else where and which keyword fails.
  std::string check(const Json& value) const { return check(root_, value, ""); }

 private:
  static bool is_type(const std::string& type, const Json& value) {
    if (type == "null") return value.is_null();
    if (type == "boolean") return value.is_boolean();
    if (type == "string") return value.is_string();
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number() && std::floor(value.get<double>()) == value.get<double>();
    if (type == "array") return value.is_array();
    if (type == "object") return value.is_object();
    throw std::logic_error("unknown type " + type);
  }

  static bool has_type(const Json& types, const Json& value) {
    if (types.is_string()) return is_type(types, value);
    for (const auto& type : types) {
      if (is_type(type, value)) return true;
    }
    return false;
  }

  std::string check(const Json& schema, const Json& value, const std::string& where) const {
    for (const auto& [keyword, rule] : schema.items()) {
      const std::string why =
          keyword == "if" ? conditional(schema, value, where) : apply(schema, keyword, rule, value, where);
      if (!why.empty()) return why;
    }
    return "";
  }

  std::string conditional(const Json& schema, const Json& value, const std::string& where) const {
    return check(schema["if"], value, where).empty() ? check(schema["then"], value, where) : "";
  }

  std::string apply(const Json& schema, const std::string& keyword, const Json& rule, const Json& value,
                    const std::string& where) const {
    static const std::set<std::string> words{"$schema", "$defs", "title", "description", "default", "then"};
    const std::string failed = where + ": " + keyword + " " + rule.dump().substr(0, 80);
    if (words.contains(keyword) || keyword.starts_with("x-")) return "";
    if (keyword == "$ref") return check(root_["$defs"].at(rule.get<std::string>().substr(8)), value, where);
    if (keyword == "type") return has_type(rule, value) ? "" : failed;
    if (keyword == "const") return rule == value ? "" : failed;
    if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end() ? "" : failed;
    if (keyword == "anyOf" || keyword == "allOf") return combine(keyword == "anyOf", rule, value, where, failed);
    if (value.is_number()) return number(keyword, rule, value.get<double>()) ? "" : failed;
    if (value.is_string()) return text(keyword, rule, value) ? "" : failed;
    if (value.is_array()) return array(keyword, rule, value, where, failed);
    if (value.is_object()) return object(schema, keyword, rule, value, where, failed);
    return "";
  }

  std::string combine(bool any, const Json& rules, const Json& value, const std::string& where,
                      const std::string& failed) const {
    for (const auto& rule : rules) {
      const std::string why = check(rule, value, where);
      if (any == why.empty()) return any ? "" : why;
    }
    return any ? failed : "";
  }

  static bool number(const std::string& keyword, const Json& rule, double value) {
    if (keyword == "minimum") return value >= rule;
    if (keyword == "maximum") return value <= rule;
    if (keyword == "exclusiveMinimum") return value > rule;
    if (keyword == "exclusiveMaximum") return value < rule;
    return true;
  }

  static bool text(const std::string& keyword, const Json& rule, const std::string& value) {
    if (keyword == "minLength") return value.size() >= rule;
    if (keyword == "maxLength") return value.size() <= rule;
    if (keyword == "pattern") return std::regex_search(value, std::regex(rule.get<std::string>()));
    return true;
  }

  std::string array(const std::string& keyword, const Json& rule, const Json& value, const std::string& where,
                    const std::string& failed) const {
    if (keyword == "minItems") return value.size() >= rule ? "" : failed;
    if (keyword == "maxItems") return value.size() <= rule ? "" : failed;
    if (keyword != "items") return "";
    for (std::size_t n = 0; n < value.size(); ++n) {
      const std::string why = check(rule, value[n], where + "/" + std::to_string(n));
      if (!why.empty()) return why;
    }
    return "";
  }

  std::string object(const Json& schema, const std::string& keyword, const Json& rule, const Json& value,
                     const std::string& where, const std::string& failed) const {
    static const std::set<std::string> known{
        "required", "properties", "patternProperties", "additionalProperties", "minProperties", "maxProperties"};
    if (!known.contains(keyword)) throw std::logic_error("unknown keyword " + keyword);
    if (keyword == "minProperties") return value.size() >= rule ? "" : failed;
    if (keyword == "maxProperties") return value.size() <= rule ? "" : failed;
    if (keyword == "required") {
      for (const auto& key : rule) {
        if (!value.contains(key.get<std::string>())) return failed;
      }
      return "";
    }
    for (const auto& [key, member] : value.items()) {
      const std::string why = member_follows(schema, keyword, rule, key, member, where + "/" + key);
      if (!why.empty()) return why;
    }
    return "";
  }

  std::string member_follows(const Json& schema, const std::string& keyword, const Json& rule, const std::string& key,
                             const Json& member, const std::string& where) const {
    if (keyword == "properties") return rule.contains(key) ? check(rule[key], member, where) : "";
    if (keyword == "patternProperties") {
      for (const auto& [pattern, inner] : rule.items()) {
        if (std::regex_search(key, std::regex(pattern))) return check(inner, member, where);
      }
      return "";
    }
    if (rule != false) throw std::logic_error("additionalProperties is not false");
    if (schema.contains("properties") && schema["properties"].contains(key)) return "";
    const Json patterns = schema.value("patternProperties", Json::object());
    for (const auto& [pattern, inner] : patterns.items()) {
      if (std::regex_search(key, std::regex(pattern))) return "";
    }
    return where + ": additionalProperties";
  }

  const Json& root_;
};

}  // namespace vigil
