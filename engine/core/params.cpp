#include "engine/core/params.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/expectation.hpp"

namespace vigil {
namespace {

constexpr std::size_t kLongestVector = 4096;
constexpr std::size_t kLargestMatrix = 512;

bool in_range(const Param& param, double value) {
  if (!std::isfinite(value)) return false;
  const bool above = param.exclusive_minimum ? value > param.minimum : value >= param.minimum;
  const bool below = param.exclusive_maximum ? value < param.maximum : value <= param.maximum;
  return above && below;
}

bool fits_number(const Param& param, const Json& value) {
  return value.is_number() && in_range(param, value.get<double>());
}

bool fits_integer(const Param& param, const Json& value) {
  if (!fits_number(param, value)) return false;
  const double number = value.get<double>();
  return number == std::floor(number) && std::abs(number) <= std::numeric_limits<int>::max();
}

bool fits_text(const Param& param, const Json& value) {
  if (!value.is_string()) return false;
  if (param.choices.empty()) return true;
  const auto& word = value.get_ref<const std::string&>();
  for (const auto& choice : param.choices) {
    if (choice == word) return true;
  }
  return false;
}

bool fits_texts(const Json& value) {
  if (!value.is_array() || value.empty() || value.size() > kLongestVector) return false;
  for (const auto& entry : value) {
    if (!entry.is_string() || entry.get_ref<const std::string&>().empty()) return false;
  }
  return true;
}

bool fits_vector(const Param& param, const Json& value) {
  if (!value.is_array() || value.empty() || value.size() > kLongestVector) return false;
  if (param.rows > 0 && value.size() != static_cast<std::size_t>(param.rows)) return false;
  for (const auto& entry : value) {
    if (!fits_number(param, entry)) return false;
  }
  return true;
}

bool fits_matrix(const Param& param, const Json& value) {
  if (value.is_number()) return fits_number(param, value);
  if (!value.is_array() || value.empty() || value.size() > kLargestMatrix) return false;
  if (!value.front().is_array()) return fits_vector(param, value);
  const std::size_t columns = value.front().size();
  if (columns == 0 || columns > kLargestMatrix) return false;
  for (const auto& row : value) {
    if (!row.is_array() || row.size() != columns) return false;
    for (const auto& entry : row) {
      if (!entry.is_number() || !std::isfinite(entry.get<double>())) return false;
    }
  }
  return true;
}

bool fits(const Param& param, const Json& value) {
  if (value.is_null()) return param.nullable;
  switch (param.type) {
    case ParamType::real:
      return fits_number(param, value);
    case ParamType::integer:
      return fits_integer(param, value);
    case ParamType::boolean:
      return value.is_boolean();
    case ParamType::text:
      return fits_text(param, value);
    case ParamType::texts:
      return fits_texts(value);
    case ParamType::vector:
      return fits_vector(param, value);
    case ParamType::matrix:
      return fits_matrix(param, value);
    case ParamType::object:
      return value.is_object();
  }
  return false;
}

/// An integer written as 3.0 is stored as 3, so that equal documents have equal texts.
Json canonical(const Param& param, const Json& value) {
  if (param.type == ParamType::integer && value.is_number_float())
    return static_cast<std::int64_t>(value.get<double>());
  return value;
}

}  // namespace

ParamTable::ParamTable(std::vector<Param> params) : params_(std::move(params)) {}

const Param* ParamTable::find(std::string_view name) const {
  for (const auto& param : params_) {
    if (param.name == name) return &param;
  }
  return nullptr;
}

std::optional<Problem> ParamTable::check(const Param& param, const Json& value, const std::string& pointer) const {
  if (fits(param, value)) return std::nullopt;
  const std::string expected = expectation(param);
  std::string detail = param.name + " is " + shown(value) + "; expected " + expected;
  if (param.type == ParamType::text && value.is_string()) {
    const std::string near = nearest(value.get_ref<const std::string&>(), param.choices);
    if (!near.empty()) detail += "; did you mean " + in_quotes(near) + "?";
  }
  return Problem{pointer, std::move(detail), param.type == ParamType::text ? listed(param.choices) : expected};
}

Json ParamTable::complete(const Json& given, const std::string& pointer, std::vector<Problem>& problems) const {
  Json result = Json::object();
  if (!given.is_object()) {
    problems.push_back({pointer, "params is " + shown(given) + "; expected an object", "object"});
    return result;
  }
  std::vector<std::string> names;
  for (const auto& param : params_) names.push_back(param.name);
  for (const auto& [key, value] : given.items()) {
    if (find(key) == nullptr) problems.push_back(unknown_key(key, names, pointer));
  }
  for (const auto& param : params_) {
    const auto place = given.find(param.name);
    if (place == given.end()) {
      if (param.required) {
        problems.push_back({child(pointer, param.name), param.name + " is missing; expected " + expectation(param),
                            expectation(param)});
      }
      result[param.name] = param.fallback;
      continue;
    }
    if (auto problem = check(param, *place, child(pointer, param.name)))
      problems.push_back(std::move(*problem));
    else
      result[param.name] = canonical(param, *place);
  }
  return result;
}

}  // namespace vigil
