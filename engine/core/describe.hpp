/// Words for messages: values as a reader may see them, whatever bytes they hold.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

/// A value as short valid UTF-8 text for a message: JSON, cut at 60 characters, broken bytes replaced.
std::string shown(const Json& value);
/// A word in quotes, cut and cleaned likewise.
std::string in_quotes(std::string_view word);
/// A number as its shortest text: 0.1, 8, inf.
std::string number_text(double value);
/// "a, b, c", cut after 40 entries.
std::string listed(const std::vector<std::string>& words);
/// `pointer` with one more token, escaped as RFC 6901 asks and cut at 80 bytes.
std::string child(const std::string& pointer, std::string_view token);
std::string child(const std::string& pointer, std::size_t index);
/// True for well-formed UTF-8 (no surrogates, no overlong forms).
bool is_utf8(std::string_view text);

}  // namespace vigil
