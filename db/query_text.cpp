#include "db/query_text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <ctime>

namespace vigil {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool ends_word(char c) { return c == '\0' || c == '(' || c == ')' || is_space(c); }
bool in_field(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '-';
}

}  // namespace

QueryError::QueryError(int column, const std::string& expected)
    : std::runtime_error(column > 0 ? "At column " + std::to_string(column) + " of the query: " + expected : expected),
      column_(column) {}

void QueryText::skip_space() {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
}

bool QueryText::at_end() {
  skip_space();
  return at_ >= text_.size();
}

bool QueryText::take(std::string_view expected) {
  if (text_.substr(at_, expected.size()) != expected) return false;
  at_ += expected.size();
  return true;
}

bool QueryText::take_word(std::string_view word) {
  skip_space();
  const std::size_t end = at_ + word.size();
  if (text_.substr(at_, word.size()) != word || !ends_word(end < text_.size() ? text_[end] : '\0')) return false;
  at_ = end;
  return true;
}

int QueryText::column(std::size_t position) const {
  int column = 1;
  for (std::size_t i = 0; i < position && i < text_.size(); ++i) {
    if ((static_cast<unsigned char>(text_[i]) & 0xc0) != 0x80) ++column;
  }
  return column;
}

void QueryText::fail_at(std::size_t position, const std::string& expected) const {
  throw QueryError(column(position), expected);
}

std::string QueryText::field() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && in_field(text_[at_])) ++at_;
  return std::string(text_.substr(begin, at_ - begin));
}

QueryText::Value QueryText::quoted() {
  Value value;
  value.quoted = true;
  value.position = at_++;
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '"') {
      ++at_;
      return value;
    }
    if (c == '\\' && at_ + 1 < text_.size() && (text_[at_ + 1] == '"' || text_[at_ + 1] == '\\')) ++at_;
    value.text += text_[at_];
  }
  fail_at(value.position, "this quote is not closed; expected \" at the end.");
}

std::optional<QueryText::Value> QueryText::value() {
  if (peek() == '"') return quoted();
  Value value;
  value.position = at_;
  while (at_ < text_.size() && !ends_word(text_[at_]) && text_[at_] != '"' && text_.substr(at_, 2) != "..") {
    value.text += text_[at_++];
  }
  if (value.text.empty()) return std::nullopt;
  return value;
}

std::optional<std::int64_t> read_integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> read_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

namespace {

constexpr WallTime kSecond = 1'000'000'000;

std::optional<WallTime> read_span(std::string_view text) {
  if (text.size() < 2) return std::nullopt;
  const auto amount = read_number(text.substr(0, text.size() - 1));
  double unit = 0;
  switch (text.back()) {
    case 's':
      unit = 1;
      break;
    case 'm':
      unit = 60;
      break;
    case 'h':
      unit = 3600;
      break;
    case 'd':
      unit = 86400;
      break;
    case 'w':
      unit = 7 * 86400;
      break;
    default:
      return std::nullopt;
  }
  if (!amount || *amount < 0 || *amount * unit > 4e9) return std::nullopt;
  return static_cast<WallTime>(*amount * unit * 1e9);
}

/// The digits at `at`, which move on; what is no number of that many digits is refused.
std::optional<int> digits(std::string_view text, std::size_t& at, std::size_t count) {
  if (at + count > text.size()) return std::nullopt;
  int value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const char c = text[at + i];
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  at += count;
  return value;
}

std::optional<WallTime> fraction(std::string_view text, std::size_t& at, WallTime& resolution) {
  WallTime value = 0;
  std::size_t places = 0;
  for (; at < text.size() && text[at] >= '0' && text[at] <= '9' && places < 9; ++at, ++places)
    value = value * 10 + (text[at] - '0');
  if (places == 0) return std::nullopt;
  for (resolution = 1; places < 9; ++places) {
    value *= 10;
    resolution *= 10;
  }
  return value;
}

/// Year to second; nothing where the month has no such day.
std::optional<WallTime> utc_seconds(const std::array<int, 6>& value) {
  std::tm utc{};
  utc.tm_year = value[0] - 1900;
  utc.tm_mon = value[1] - 1;
  utc.tm_mday = value[2];
  utc.tm_hour = value[3];
  utc.tm_min = value[4];
  utc.tm_sec = value[5];
  const auto seconds = static_cast<WallTime>(timegm(&utc));
  if (utc.tm_mday != value[2]) return std::nullopt;
  return seconds;
}

}  // namespace

std::optional<std::pair<WallTime, WallTime>> read_time(std::string_view text, WallTime now) {
  if (!text.empty() && text[0] == '-') {
    const auto span = read_span(text.substr(1));
    if (!span) return std::nullopt;
    return std::pair(now - *span, now - *span);
  }
  if (!text.empty() && text.back() == 'Z') text.remove_suffix(1);
  struct Part {
    char before;
    std::size_t count;
    int low, high;
    WallTime resolution;
  };
  constexpr std::array<Part, 6> parts = {{{'\0', 4, 1970, 2261, 0},
                                          {'-', 2, 1, 12, 0},
                                          {'-', 2, 1, 31, 86400 * kSecond},
                                          {'T', 2, 0, 23, 3600 * kSecond},
                                          {':', 2, 0, 59, 60 * kSecond},
                                          {':', 2, 0, 59, kSecond}}};
  std::array<int, 6> value = {1970, 1, 1, 0, 0, 0};
  std::size_t at = 0, count = 0;
  for (; count < parts.size() && at < text.size(); ++count) {
    const Part& part = parts[count];
    if (part.before != '\0' && (text[at] != part.before || ++at > text.size())) return std::nullopt;
    const auto number = digits(text, at, part.count);
    if (!number || *number < part.low || *number > part.high) return std::nullopt;
    value[count] = *number;
  }
  if (count < 3) return std::nullopt;
  WallTime resolution = parts[count - 1].resolution, part_of_second = 0;
  if (count == 6 && at < text.size() && text[at] == '.') {
    const auto read = fraction(text, ++at, resolution);
    if (!read) return std::nullopt;
    part_of_second = *read;
  }
  if (at != text.size()) return std::nullopt;
  const auto seconds = utc_seconds(value);
  if (!seconds) return std::nullopt;
  const WallTime first = *seconds * kSecond + part_of_second;
  return std::pair(first, first + resolution);
}

}  // namespace vigil
