#include "db/query.hpp"

#include <array>
#include <bit>
#include <charconv>

#include "db/query_text.hpp"

namespace vigil {

namespace {

constexpr std::size_t kLongest = 2000;
constexpr int kDeepest = 32;
constexpr int kMostTerms = 64;

enum class Kind { integer, text, prose, tags, time, metric, parameter };

struct Field {
  Kind kind = Kind::text;
  std::string sql;  ///< an expression; of a metric, the condition on the row but its value
  std::vector<Query::Value> values;
};

enum class Compare { is, equal, unequal, more, at_least, less, at_most, contains };

const char* const kFields =
    "a field: id, scenario, family, state, seed, tag, note, error, created, started, ended, metrics.<name>, "
    "<lane>.<name> or "
    "params.<path>";

const char* sign(Compare compare) {
  switch (compare) {
    case Compare::unequal:
      return "<>";
    case Compare::more:
      return ">";
    case Compare::at_least:
      return ">=";
    case Compare::less:
      return "<";
    case Compare::at_most:
      return "<=";
    default:
      return "=";
  }
}

class Parser {
 public:
  Parser(std::string_view text, WallTime now) : text_(text), now_(now) {}

  std::string parse(std::vector<Query::Value>& values) {
    values_ = &values;
    if (text_.at_end()) return "1";
    std::string sql = either(0);
    if (!text_.at_end()) text_.fail("expected AND, OR or the end, not a closing parenthesis.");
    return sql;
  }

 private:
  using Value = QueryText::Value;

  std::string either(int depth) {
    std::string sql = both(depth);
    while (text_.take_word("OR")) sql += " OR " + both(depth);
    return "(" + sql + ")";
  }

  std::string both(int depth) {
    std::string sql = negated(depth);
    for (;;) {
      const bool said = text_.take_word("AND");
      if (!said && (text_.at_end() || text_.peek() == ')' || next_is_or())) return sql;
      sql += " AND " + negated(depth);
    }
  }

  bool next_is_or() {
    const std::size_t here = text_.position();
    const bool found = text_.take_word("OR");
    text_.go_back(here);
    return found;
  }

  std::string negated(int depth) {
    if (depth > kDeepest) text_.fail("the query is nested deeper than " + std::to_string(kDeepest) + " levels.");
    if (text_.take_word("NOT")) return "NOT " + negated(depth + 1);
    text_.skip_space();
    if (!text_.take("(")) return term();
    std::string sql = either(depth + 1);
    text_.skip_space();
    if (!text_.take(")")) text_.fail("expected ) here.");
    return sql;
  }

  std::string term() {
    if (text_.at_end()) text_.fail("the query ends here; expected " + std::string(kFields) + ".");
    if (++terms_ > kMostTerms) text_.fail("the query has more than " + std::to_string(kMostTerms) + " conditions.");
    const std::size_t begin = text_.position();
    const std::string name = text_.field();
    const auto compare = name.empty() ? std::nullopt : operation();
    if (!compare) {
      text_.go_back(begin);
      return word();
    }
    return "ifnull(" + condition(field(name, begin), *compare) + ",0)";
  }

  std::optional<Compare> operation() {
    static constexpr std::array<std::pair<std::string_view, Compare>, 8> signs = {{{":", Compare::is},
                                                                                   {"!=", Compare::unequal},
                                                                                   {">=", Compare::at_least},
                                                                                   {"<=", Compare::at_most},
                                                                                   {"=", Compare::equal},
                                                                                   {">", Compare::more},
                                                                                   {"<", Compare::less},
                                                                                   {"~", Compare::contains}}};
    for (const auto& [text, compare] : signs) {
      if (text_.take(text)) return compare;
    }
    return std::nullopt;
  }

  std::string word() {
    const std::size_t begin = text_.position();
    const auto value = text_.value();
    if (!value) text_.fail_at(begin, "expected " + std::string(kFields) + ", or a word to look for.");
    if (!value->quoted && (value->text == "AND" || value->text == "OR")) {
      text_.fail_at(begin, "expected a condition before " + value->text + ".");
    }
    bind(value->text);
    const std::string place = "?" + std::to_string(values_->size());
    return "(instr(lower(run.scenario||' '||run.family||' '||run.note),lower(" + place +
           "))>0 OR EXISTS(SELECT 1 FROM json_each(run.tags) WHERE instr(lower(value),lower(" + place + "))>0))";
  }

  Field field(const std::string& name, std::size_t position) {
    static const std::array<std::pair<std::string_view, Kind>, 12> plain = {{{"id", Kind::integer},
                                                                             {"seed", Kind::integer},
                                                                             {"scenario", Kind::text},
                                                                             {"family", Kind::text},
                                                                             {"state", Kind::text},
                                                                             {"note", Kind::prose},
                                                                             {"error", Kind::prose},
                                                                             {"tag", Kind::tags},
                                                                             {"tags", Kind::tags},
                                                                             {"created", Kind::time},
                                                                             {"started", Kind::time},
                                                                             {"ended", Kind::time}}};
    for (const auto& [known, kind] : plain) {
      if (name == known) return {kind, "run." + name, {}};
    }
    const auto dot = name.find('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == name.size()) {
      text_.fail_at(position, "there is no field " + name + "; expected " + kFields + ".");
    }
    const std::string head = name.substr(0, dot), rest = name.substr(dot + 1);
    return head == "params" ? parameter(rest, position) : metric(head, rest);
  }

  Field parameter(const std::string& path, std::size_t position) {
    std::string json_path = "$";
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
      end = path.find('.', begin);
      const std::string key = path.substr(begin, end == std::string::npos ? end : end - begin);
      if (key.empty()) text_.fail_at(position, "the path params." + path + " has an empty part.");
      json_path += ".\"" + key + "\"";
    }
    return {Kind::parameter, "(SELECT json_extract(body,$) FROM document WHERE document.run=run.id)", {json_path}};
  }

  static Field metric(const std::string& lane, const std::string& rest) {
    const auto dot = rest.find('.');
    Field field{Kind::metric, "metric.run=run.id AND metric.node='' AND metric.name=$", {rest.substr(0, dot)}};
    if (lane != "metrics") {
      field.sql += " AND metric.lane=$";
      field.values.emplace_back(lane);
    }
    if (dot != std::string::npos) {
      field.sql += " AND metric.variant=$";
      field.values.emplace_back(rest.substr(dot + 1));
    }
    return field;
  }

  std::string condition(const Field& field, Compare compare) {
    const std::size_t here = text_.position();
    const auto low = text_.value();
    if (compare == Compare::is && text_.take("..")) {
      const auto high = text_.value();
      if (!low && !high) text_.fail_at(here, "expected a value before or after ...");
      std::string sql = low ? test(field, Compare::at_least, *low) : "1";
      if (high) sql += " AND " + test(field, Compare::at_most, *high);
      return "(" + sql + ")";
    }
    if (!low) text_.fail_at(here, "expected a value.");
    if (low->text == "null" && !low->quoted && (compare == Compare::is || compare == Compare::equal))
      return missing(field);
    return test(field, compare, *low);
  }

  std::string missing(const Field& field) {
    if (field.kind == Kind::metric)
      return "NOT EXISTS(SELECT 1 FROM metric WHERE " + use(field) + " AND value IS NOT NULL)";
    if (field.kind == Kind::tags) return "run.tags='[]'";
    return "ifnull(" + use(field) + ",'')=''";
  }

  std::string test(const Field& field, Compare compare, const Value& value) {
    switch (field.kind) {
      case Kind::integer:
        return compared(field, compare, integer(value, compare));
      case Kind::time:
        return time(field, compare, value);
      case Kind::tags:
        return tags(compare, value);
      case Kind::metric:
        return "EXISTS(SELECT 1 FROM metric WHERE " + use(field) + " AND value" + sign(compare) +
               bind(number(value, compare)) + ")";
      case Kind::parameter:
        if (compare != Compare::contains) return compared(field, compare, scalar(value));
        [[fallthrough]];
      default:
        return text(field, compare, value);
    }
  }

  std::string compared(const Field& field, Compare compare, const Query::Value& value) {
    std::string sql = use(field);
    return sql + sign(compare) + bind(value);
  }

  std::string text(const Field& field, Compare compare, const Value& value) {
    std::string sql = use(field);
    const bool prose = field.kind == Kind::prose && compare == Compare::is;
    if (compare == Compare::contains || prose) return "instr(lower(" + sql + "),lower(" + bind(value.text) + "))>0";
    return sql + sign(compare) + bind(value.text) + " COLLATE NOCASE";
  }

  std::string tags(Compare compare, const Value& value) {
    const std::string any = "EXISTS(SELECT 1 FROM json_each(run.tags) WHERE ";
    switch (compare) {
      case Compare::is:
      case Compare::equal:
        return any + "value=" + bind(value.text) + " COLLATE NOCASE)";
      case Compare::unequal:
        return "NOT " + any + "value=" + bind(value.text) + " COLLATE NOCASE)";
      case Compare::contains:
        return any + "instr(lower(value),lower(" + bind(value.text) + "))>0)";
      default:
        text_.fail_at(value.position, "tags have no order; expected :, =, != or ~ before it.");
    }
  }

  std::string time(const Field& field, Compare compare, const Value& value) {
    const auto span = read_time(value.text, now_);
    if (!span) {
      text_.fail_at(value.position,
                    "\"" + value.text + "\" is no time; expected 2026-03-01, 2026-03-01T12:00, … or -2h.");
    }
    const auto [first, end] = *span;
    const std::string column = use(field);
    switch (compare) {
      case Compare::more:
        return column + ">=" + bind(end);
      case Compare::at_least:
        return column + ">=" + bind(first);
      case Compare::less:
        return column + "<" + bind(first);
      case Compare::at_most:
        return column + (first == end ? "<=" : "<") + bind(end);
      case Compare::is:
      case Compare::equal:
      case Compare::unequal: {
        std::string inside = column + ">=" + bind(first);
        if (first != end) inside += " AND " + column + "<" + bind(end);
        return (compare == Compare::unequal ? "NOT (" : "(") + inside + ")";
      }
      default:
        text_.fail_at(value.position, "a time cannot be searched with ~; expected a comparison.");
    }
  }

  Query::Value integer(const Value& value, Compare compare) {
    if (compare == Compare::contains)
      text_.fail_at(value.position, "a number cannot be searched with ~; expected a comparison.");
    if (const auto number = read_integer(value.text)) return *number;
    std::uint64_t large = 0;
    const auto [end, error] = std::from_chars(value.text.data(), value.text.data() + value.text.size(), large);
    if (error == std::errc() && end == value.text.data() + value.text.size()) return std::bit_cast<std::int64_t>(large);
    text_.fail_at(value.position, "\"" + value.text + "\" is no whole number.");
  }

  Query::Value number(const Value& value, Compare compare) {
    if (compare == Compare::contains)
      text_.fail_at(value.position, "a metric cannot be searched with ~; expected a comparison.");
    if (!value.quoted && value.text == "true") return 1.0;
    if (!value.quoted && value.text == "false") return 0.0;
    if (const auto number = read_number(value.text)) return *number;
    text_.fail_at(value.position, "\"" + value.text + "\" is no number.");
  }

  static Query::Value scalar(const Value& value) {
    if (value.quoted) return value.text;
    if (value.text == "true") return std::int64_t{1};
    if (value.text == "false") return std::int64_t{0};
    if (const auto number = read_number(value.text)) return *number;
    return value.text;
  }

  /// The field's SQL with its values bound: each $ becomes the number of its parameter.
  std::string use(const Field& field) {
    std::string sql;
    std::size_t next = 0;
    for (const char c : field.sql) sql += c == '$' ? bind(field.values[next++]) : std::string(1, c);
    return sql;
  }

  std::string bind(Query::Value value) {
    values_->push_back(std::move(value));
    return "?" + std::to_string(values_->size());
  }

  QueryText text_;
  WallTime now_;
  int terms_ = 0;
  std::vector<Query::Value>* values_ = nullptr;
};

}  // namespace

Query Query::parse(std::string_view text, WallTime now) {
  if (text.size() > kLongest) {
    throw QueryError(static_cast<int>(kLongest) + 1,
                     "the query is longer than " + std::to_string(kLongest) + " bytes.");
  }
  Query query;
  query.sql_ = Parser(text, now).parse(query.values_);
  return query;
}

}  // namespace vigil
