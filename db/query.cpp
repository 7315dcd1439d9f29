#include "db/query.hpp"

#include <array>

#include "db/query_condition.hpp"

namespace vigil {

namespace {

constexpr std::size_t kLongest = 2000;
constexpr int kDeepest = 32;
constexpr int kMostTerms = 64;

class Parser {
 public:
  Parser(std::string_view text, WallTime now, std::vector<Query::Value>& values)
      : text_(text), writer_(text_, now, values) {}

  std::string parse() {
    if (text_.at_end()) return "1";
    std::string sql = either(0);
    if (!text_.at_end()) text_.fail("expected AND, OR or the end, not a closing parenthesis.");
    return sql;
  }

 private:
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
    if (text_.at_end()) text_.fail("the query ends here; expected " + std::string(kQueryFields) + ".");
    if (++terms_ > kMostTerms) text_.fail("the query has more than " + std::to_string(kMostTerms) + " conditions.");
    const std::size_t begin = text_.position();
    const std::string name = text_.field();
    const auto compare = name.empty() ? std::nullopt : operation();
    if (!compare) {
      text_.go_back(begin);
      return word();
    }
    return "ifnull(" + writer_.condition(writer_.field(name, begin), *compare) + ",0)";
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
    if (!value) text_.fail_at(begin, std::string("expected ") + kQueryFields + ", or a word to look for.");
    if (!value->quoted && (value->text == "AND" || value->text == "OR")) {
      text_.fail_at(begin, "expected a condition before " + value->text + ".");
    }
    const auto sign = value->quoted ? std::string::npos : value->text.find_first_of(":=<>~");
    if (sign != std::string::npos) {
      text_.fail_at(begin, std::string("expected ") + kQueryFields + " before " + value->text[sign] +
                               ", or quotes around the word.");
    }
    return writer_.anywhere(value->text);
  }

  QueryText text_;
  ConditionWriter writer_;
  int terms_ = 0;
};

}  // namespace

Query Query::parse(std::string_view text, WallTime now) {
  if (text.size() > kLongest) {
    throw QueryError(static_cast<int>(kLongest) + 1,
                     "the query is longer than " + std::to_string(kLongest) + " bytes.");
  }
  Query query;
  query.sql_ = Parser(text, now, query.values_).parse();
  return query;
}

}  // namespace vigil
