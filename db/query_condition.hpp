/// One condition of a query becomes SQL; every value becomes a bound parameter.
#pragma once

#include <string>
#include <vector>

#include "db/query_text.hpp"

namespace vigil {

enum class FieldKind { integer, text, prose, tags, time, metric, parameter };

struct QueryField {
  FieldKind kind = FieldKind::text;
  std::string
      sql;  ///< an expression, of a metric the condition on its row but for the value; each $ stands for a parameter
  std::vector<Query::Value> values;
};

enum class Compare { is, equal, unequal, more, at_least, less, at_most, contains };

/// What a field's name may be, for messages.
extern const char* const kQueryFields;

class ConditionWriter {
 public:
  /// Reads values from `text`, adds parameters to `values`.
  ConditionWriter(QueryText& text, WallTime now, std::vector<Query::Value>& values)
      : text_(text), now_(now), values_(values) {}

  /// Throws QueryError at `position` where there is no such field.
  QueryField field(const std::string& name, std::size_t position) const;
  /// The value or range that follows in the text, and the whole condition.
  std::string condition(const QueryField& field, Compare compare);
  /// A word that stands alone.
  std::string anywhere(const std::string& word);

 private:
  using Value = QueryText::Value;
  QueryField parameter(const std::string& path, std::size_t position) const;
  static QueryField metric(const std::string& lane, const std::string& rest);
  std::string missing(const QueryField& field);
  std::string test(const QueryField& field, Compare compare, const Value& value);
  std::string compared(const QueryField& field, Compare compare, const Query::Value& value);
  std::string text(const QueryField& field, Compare compare, const Value& value);
  std::string tags(Compare compare, const Value& value);
  std::string time(const QueryField& field, Compare compare, const Value& value);
  Query::Value integer(const Value& value, Compare compare) const;
  Query::Value number(const Value& value, Compare compare) const;
  std::string use(const QueryField& field);
  std::string bind(Query::Value value);

  QueryText& text_;
  const WallTime now_;
  std::vector<Query::Value>& values_;
};

}  // namespace vigil
