#include "engine/core/expectation.hpp"

#include <cmath>

#include "engine/core/describe.hpp"

namespace vigil {

std::string_view to_string(ParamType type) {
  switch (type) {
    case ParamType::real:
      return "real";
    case ParamType::integer:
      return "integer";
    case ParamType::boolean:
      return "boolean";
    case ParamType::text:
      return "text";
    case ParamType::texts:
      return "texts";
    case ParamType::vector:
      return "vector";
    case ParamType::matrix:
      return "matrix";
    case ParamType::object:
      return "object";
  }
  return "";
}

std::string range_text(const Param& param) {
  std::string text;
  if (std::isfinite(param.minimum)) text = (param.exclusive_minimum ? "> " : ">= ") + number_text(param.minimum);
  if (std::isfinite(param.maximum)) {
    if (!text.empty()) text += " and ";
    text += (param.exclusive_maximum ? "< " : "<= ") + number_text(param.maximum);
  }
  return text;
}

namespace {

std::string base(const Param& param) {
  switch (param.type) {
    case ParamType::real:
      return "a finite number";
    case ParamType::integer:
      return "an integer";
    case ParamType::boolean:
      return "true or false";
    case ParamType::text:
      return param.choices.empty() ? "a text" : "one of " + listed(param.choices);
    case ParamType::texts:
      return "a list of texts";
    case ParamType::vector:
      return param.rows > 0 ? "a vector of " + std::to_string(param.rows) + " finite numbers"
                            : "a vector of finite numbers";
    case ParamType::matrix:
      return "a finite matrix [[..],..], its diagonal [..] or a number";
    case ParamType::object:
      return "an object";
  }
  return "";
}

}  // namespace

std::string expectation(const Param& param) {
  std::string text = base(param);
  if (param.type == ParamType::real && std::isfinite(param.minimum + param.maximum)) text = "a number";
  const std::string range = range_text(param);
  if (!range.empty())
    text += (param.type == ParamType::vector || param.type == ParamType::matrix ? ", each " : " ") + range;
  if (param.nullable) text += " or null";
  return text;
}

Problem unknown_key(std::string_view key, const std::vector<std::string>& known, const std::string& pointer) {
  const std::string near = nearest(key, known);
  std::string detail = in_quotes(key) + " is not a key here; ";
  if (!near.empty()) {
    detail += "did you mean " + in_quotes(near) + "?";
  } else {
    detail += known.empty() ? "none is expected" : "expected one of " + listed(known);
  }
  return {child(pointer, key), std::move(detail), near.empty() ? listed(known) : near};
}

}  // namespace vigil
