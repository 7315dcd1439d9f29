#include "engine/scenario/fields.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/expectation.hpp"
#include "engine/core/params.hpp"

namespace vigil {
namespace {

const Json kNothing;
const Json kEmpty = Json::object();

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

Fields::Fields(const Json& given, std::string pointer, std::vector<Problem>& problems)
    : given_(given.is_object() ? given : kEmpty), pointer_(std::move(pointer)), problems_(problems) {
  if (given.is_object()) return;
  const std::string name = pointer_.empty() ? "the document" : pointer_.substr(pointer_.rfind('/') + 1);
  problems_.push_back({pointer_, name + " is " + shown(given) + "; expected an object", "object"});
}

void Fields::known(const std::vector<std::string>& keys) {
  for (const auto& [key, value] : given_.items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) problems_.push_back(unknown_key(key, keys, pointer_));
  }
}

bool Fields::has(std::string_view key) const { return given_.contains(std::string(key)); }

const Json& Fields::at(std::string_view key) const {
  const auto place = given_.find(std::string(key));
  return place == given_.end() ? kNothing : *place;
}

std::string Fields::pointer(std::string_view key) const { return child(pointer_, key); }

void Fields::wrong(std::string_view key, const std::string& expected) {
  problems_.push_back({pointer(key), std::string(key) + " is " + shown(at(key)) + "; expected " + expected, expected});
}

void Fields::missing(std::string_view key, const std::string& expected) {
  problems_.push_back({pointer(key), std::string(key) + " is missing; expected " + expected, expected});
}

Json Fields::text(std::string_view key, const Json& fallback) {
  if (!has(key)) return fallback;
  if (at(key).is_string()) return at(key);
  wrong(key, "a text");
  return fallback;
}

Json Fields::choice(std::string_view key, const std::vector<std::string>& choices, const Json& fallback) {
  if (!has(key) || (at(key).is_null() && fallback.is_null())) return fallback;
  const Json& value = at(key);
  const auto same = [&](const std::string& choice) { return value == choice; };
  if (std::any_of(choices.begin(), choices.end(), same)) return value;
  std::string expected = choices.size() == 1 ? in_quotes(choices.front()) : "one of " + listed(choices);
  if (fallback.is_null()) expected += " or null";
  const std::string near = value.is_string() ? nearest(value.get_ref<const std::string&>(), choices) : "";
  wrong(key, near.empty() ? expected : expected + "; did you mean " + in_quotes(near) + "?");
  problems_.back().allowed = listed(choices);
  return fallback;
}

Json Fields::boolean(std::string_view key, bool fallback) {
  if (!has(key)) return fallback;
  if (at(key).is_boolean()) return at(key);
  wrong(key, "true or false");
  return fallback;
}

Json Fields::integer(std::string_view key, const Json& fallback, std::int64_t minimum, bool nullable) {
  if (!has(key)) return fallback;
  const Json& value = at(key);
  if (value.is_null() && nullable) return nullptr;
  constexpr double kMost = 1e12;
  const bool whole = value.is_number() && value.get<double>() == std::floor(value.get<double>());
  if (whole && value.get<double>() >= static_cast<double>(minimum) && value.get<double>() <= kMost)
    return value.get<std::int64_t>();
  wrong(key, "an integer >= " + std::to_string(minimum) + " and <= 1e12" + (nullable ? " or null" : ""));
  return fallback;
}

Json Fields::positive(std::string_view key, const Json& fallback, bool nullable) {
  if (!has(key)) return fallback;
  const Json& value = at(key);
  if (value.is_null() && nullable) return nullptr;
  constexpr double kMost = 1e12;
  if (value.is_number() && value.get<double>() > 0 && value.get<double>() <= kMost) return value;
  wrong(key, std::string("a number > 0 and <= 1e12") + (nullable ? " or null" : ""));
  return fallback;
}

Json Fields::texts(std::string_view key, const Json& fallback) {
  if (!has(key)) return fallback;
  const Json& value = at(key);
  constexpr std::size_t kMost = 4096;
  const auto text = [](const Json& entry) { return entry.is_string() && !entry.get_ref<const std::string&>().empty(); };
  const bool good =
      value.is_array() && !value.empty() && value.size() <= kMost && std::all_of(value.begin(), value.end(), text);
  if (good) return value;
  wrong(key, "an array of 1 to 4096 texts");
  return fallback;
}

bool is_id(std::string_view text, std::size_t longest, const std::function<bool(char)>& allowed) {
  return !text.empty() && text.size() <= longest && std::all_of(text.begin(), text.end(), allowed);
}

bool is_member_id(std::string_view text) {
  return is_id(text, 32, [](char c) { return is_lower(c) || is_digit(c) || c == '_'; });
}

bool is_node_id(std::string_view text) {
  return is_id(text, 16, [](char c) { return is_lower(c) || is_upper(c) || is_digit(c) || c == '_'; });
}

}  // namespace vigil
