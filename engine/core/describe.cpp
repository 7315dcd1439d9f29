#include "engine/core/describe.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace vigil {
namespace {

constexpr std::size_t kShown = 60;

/// Cuts before `limit` bytes without splitting a character.
std::string cut(std::string text, std::size_t limit) {
  if (text.size() <= limit) return text;
  std::size_t end = limit;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  text.resize(end);
  return text + "…";
}

std::string dump(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Few entries and at most two levels: only such arrays are written out, whatever somebody sends.
bool is_short(const Json& array) {
  if (array.size() > 16) return false;
  for (const auto& row : array) {
    if (row.size() > 16 && row.is_structured()) return false;
    for (const auto& entry : row) {
      if (entry.is_structured()) return false;
    }
  }
  return true;
}

/// Bytes that follow a lead byte; -1 where it cannot lead.
int followers(unsigned char lead) {
  if (lead < 0x80U) return 0;
  if (lead >= 0xC2U && lead <= 0xDFU) return 1;
  if (lead >= 0xE0U && lead <= 0xEFU) return 2;
  if (lead >= 0xF0U && lead <= 0xF4U) return 3;
  return -1;
}

bool is_scalar(std::uint32_t code, int more) {
  if (more == 2) return code >= 0x800U && !(code >= 0xD800U && code <= 0xDFFFU);
  if (more == 3) return code >= 0x10000U && code <= 0x10FFFFU;
  return true;
}

}  // namespace

std::string shown(const Json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) return number_text(value.get<double>());
  if (value.is_object()) return value.empty() ? "{}" : "an object";
  if (value.is_array() && !is_short(value)) return "an array of " + std::to_string(value.size());
  return cut(dump(value), kShown);
}

std::string in_quotes(std::string_view word) {
  return cut(dump(Json(std::string(word.substr(0, 4 * kShown)))), kShown);
}

std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i == 40) return text + ", …";
    if (i > 0) text += ", ";
    text += words[i];
  }
  return text;
}

std::string child(const std::string& pointer, std::string_view token) {
  std::string clean(token);
  if (!is_utf8(clean)) {
    clean = dump(Json(clean));
    clean = clean.substr(1, clean.size() - 2);
  }
  std::string text = pointer + "/";
  for (const char c : cut(clean, 80)) {
    if (c == '~') {
      text += "~0";
    } else if (c == '/') {
      text += "~1";
    } else {
      text += c;
    }
  }
  return text;
}

std::string child(const std::string& pointer, std::size_t index) { return pointer + "/" + std::to_string(index); }

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int more = followers(lead);
    if (more < 0 || i + static_cast<std::size_t>(more) >= text.size()) return false;
    std::uint32_t code = more == 0 ? lead : lead & (0x3FU >> static_cast<unsigned>(more));
    for (int n = 1; n <= more; ++n) {
      const auto byte = static_cast<unsigned char>(text[i + static_cast<std::size_t>(n)]);
      if ((byte & 0xC0U) != 0x80U) return false;
      code = (code << 6U) | (byte & 0x3FU);
    }
    if (!is_scalar(code, more)) return false;
    i += static_cast<std::size_t>(more) + 1;
  }
  return true;
}

}  // namespace vigil
