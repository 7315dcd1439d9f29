/// Reading the text of a query: tokens, and values of each kind.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "db/query.hpp"

namespace vigil {

/// A place in a query's text.
class QueryText {
 public:
  explicit QueryText(std::string_view text) : text_(text) {}

  void skip_space();
  bool at_end();
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(std::string_view expected);   ///< exactly these characters
  bool take_word(std::string_view word);  ///< and then a space, a parenthesis or the end
  std::size_t position() const { return at_; }
  void go_back(std::size_t position) { at_ = position; }
  int column(std::size_t position) const;
  [[noreturn]] void fail(const std::string& expected) const { fail_at(at_, expected); }
  [[noreturn]] void fail_at(std::size_t position, const std::string& expected) const;

  std::string field();  ///< letters, digits, _ . - ; may be empty
  struct Value {
    std::string text;
    bool quoted = false;
    std::size_t position = 0;
  };
  /// A word (up to a space, a parenthesis or ..) or a quoted text; empty where neither is there.
  std::optional<Value> value();

 private:
  Value quoted();
  std::string_view text_;
  std::size_t at_ = 0;
};

std::optional<std::int64_t> read_integer(std::string_view text);
std::optional<double> read_number(std::string_view text);  ///< finite
/// First nanosecond, and the one after the last, of what is written: a day, a minute, … or one instant (-2h).
std::optional<std::pair<WallTime, WallTime>> read_time(std::string_view text, WallTime now);

}  // namespace vigil
