/// The language of `q`: which runs. Compiled to SQL in which everything the user wrote is a bound parameter.
///
///   query   := or            or := and ("OR" and)*          and := not (["AND"] not)*         not := ["NOT"] (term |
///   "(" or ")") term    := field ":" value | field ":" [low] ".." [high] | field ("=" | "!=" | ">" | ">=" | "<" | "<="
///   | "~") value | word field   := id scenario family state seed tag tags note created started ended error |
///   metrics.<name> | <lane>.<name>
///              | params.<dotted path into the document>
///   value   := word | "quoted, with \" and \\"
///
/// `~` finds a part of a text, whatever its case. A bare word is looked for in scenario, family, tags and note. Times
/// are RFC 3339 (or a part: 2026-03-01, 2026-03-01T12:00) in UTC, or relative: -2h (s m h d w). `field:null` finds what
/// is missing.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "db/records.hpp"

namespace vigil {

/// A query that cannot be read.
class QueryError : public std::runtime_error {
 public:
  /// `column` counts characters from 1.
  QueryError(int column, const std::string& what_was_expected);
  int column() const { return column_; }

 private:
  int column_;
};

class Query {
 public:
  /// All runs.
  Query() = default;
  /// Throws QueryError: longer than 2000 bytes, deeper than 32 parentheses, more than 64 terms, unknown field, a value
  /// of the wrong type.
  static Query parse(std::string_view text, WallTime now);

  using Value = std::variant<std::int64_t, double, std::string>;
  const std::string& sql() const { return sql_; }  ///< a condition over table `run`
  const std::vector<Value>& values() const { return values_; }

 private:
  std::string sql_ = "1";
  std::vector<Value> values_;
};

}  // namespace vigil
