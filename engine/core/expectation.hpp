/// What a declared parameter accepts, in words; shared by the error messages, the schema and the tables of the
/// documentation.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/params.hpp"

namespace vigil {

/// "real", "integer", "boolean", "text", "vector", "matrix"
std::string_view to_string(ParamType type);
/// "a number > 0 and <= 1", "one of clip, strict", "a vector of 2 numbers", with " or null" where null is legal.
std::string expectation(const Param& param);
/// The range alone: "> 0 and <= 1", "" where there is none.
std::string range_text(const Param& param);
/// The problem of a key that nobody declared: names it and the nearest valid one.
Problem unknown_key(std::string_view key, const std::vector<std::string>& known, const std::string& pointer);

}  // namespace vigil
