#include "db/query_condition.hpp"

#include <array>
#include <bit>
#include <charconv>

namespace vigil {

const char* const kQueryFields =
    "a field: id, scenario, family, state, seed, tag, note, error, parent, created, started, ended, "
    "metrics.<name>, <lane>.<name> or params.<path>";

namespace {

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

Query::Value scalar(const QueryText::Value& value) {
  if (value.quoted) return value.text;
  if (value.text == "true") return std::int64_t{1};
  if (value.text == "false") return std::int64_t{0};
  if (const auto number = read_number(value.text)) return *number;
  return value.text;
}

}  // namespace

QueryField ConditionWriter::field(const std::string& name, std::size_t position) const {
  static const std::array<std::pair<std::string_view, FieldKind>, 12> plain = {{{"id", FieldKind::integer},
                                                                                {"seed", FieldKind::integer},
                                                                                {"scenario", FieldKind::text},
                                                                                {"family", FieldKind::text},
                                                                                {"state", FieldKind::text},
                                                                                {"note", FieldKind::prose},
                                                                                {"error", FieldKind::prose},
                                                                                {"tag", FieldKind::tags},
                                                                                {"tags", FieldKind::tags},
                                                                                {"created", FieldKind::time},
                                                                                {"started", FieldKind::time},
                                                                                {"ended", FieldKind::time}}};
  for (const auto& [known, kind] : plain) {
    if (name == known) return {kind, "run." + name, {}};
  }
  if (name == "parent") return {FieldKind::integer, "run.parent_run", {}};
  const auto dot = name.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == name.size()) {
    text_.fail_at(position, "there is no field " + name + "; expected " + kQueryFields + ".");
  }
  const std::string head = name.substr(0, dot), rest = name.substr(dot + 1);
  return head == "params" ? parameter(rest, position) : metric(head, rest);
}

QueryField ConditionWriter::parameter(const std::string& path, std::size_t position) const {
  std::string json_path = "$";
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = path.find('.', begin);
    const std::string key = path.substr(begin, end == std::string::npos ? end : end - begin);
    if (key.empty()) text_.fail_at(position, "the path params." + path + " has an empty part.");
    json_path += ".\"" + key + "\"";
  }
  return {FieldKind::parameter, "(SELECT json_extract(body,$) FROM document WHERE document.run=run.id)", {json_path}};
}

QueryField ConditionWriter::metric(const std::string& lane, const std::string& rest) {
  const auto dot = rest.find('.');
  QueryField field{FieldKind::metric, "metric.run=run.id AND metric.node='' AND metric.name=$", {rest.substr(0, dot)}};
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

std::string ConditionWriter::condition(const QueryField& field, Compare compare) {
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

std::string ConditionWriter::anywhere(const std::string& word) {
  const std::string place = bind(word);
  return "(instr(lower(run.scenario||' '||run.family||' '||run.note),lower(" + place +
         "))>0 OR EXISTS(SELECT 1 FROM json_each(run.tags) WHERE instr(lower(value),lower(" + place + "))>0))";
}

std::string ConditionWriter::missing(const QueryField& field) {
  if (field.kind == FieldKind::metric)
    return "NOT EXISTS(SELECT 1 FROM metric WHERE " + use(field) + " AND value IS NOT NULL)";
  if (field.kind == FieldKind::tags) return "run.tags='[]'";
  return "ifnull(" + use(field) + ",'')=''";
}

std::string ConditionWriter::test(const QueryField& field, Compare compare, const Value& value) {
  switch (field.kind) {
    case FieldKind::integer:
      return compared(field, compare, integer(value, compare));
    case FieldKind::time:
      return time(field, compare, value);
    case FieldKind::tags:
      return tags(compare, value);
    case FieldKind::metric:
      return "EXISTS(SELECT 1 FROM metric WHERE " + use(field) + " AND value" + sign(compare) +
             bind(number(value, compare)) + ")";
    case FieldKind::parameter:
      if (compare != Compare::contains) return compared(field, compare, scalar(value));
      [[fallthrough]];
    default:
      return text(field, compare, value);
  }
}

std::string ConditionWriter::compared(const QueryField& field, Compare compare, const Query::Value& value) {
  std::string sql = use(field);
  return sql + sign(compare) + bind(value);
}

std::string ConditionWriter::text(const QueryField& field, Compare compare, const Value& value) {
  std::string sql = use(field);
  const bool prose = field.kind == FieldKind::prose && compare == Compare::is;
  if (compare == Compare::contains || prose) return "instr(lower(" + sql + "),lower(" + bind(value.text) + "))>0";
  return sql + sign(compare) + bind(value.text) + " COLLATE NOCASE";
}

std::string ConditionWriter::tags(Compare compare, const Value& value) {
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

std::string ConditionWriter::time(const QueryField& field, Compare compare, const Value& value) {
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
      if (first == end) return column + ">=" + bind(first);
      [[fallthrough]];
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

Query::Value ConditionWriter::integer(const Value& value, Compare compare) const {
  if (compare == Compare::contains)
    text_.fail_at(value.position, "a number cannot be searched with ~; expected a comparison.");
  if (const auto number = read_integer(value.text)) return *number;
  std::uint64_t large = 0;
  const auto [end, error] = std::from_chars(value.text.data(), value.text.data() + value.text.size(), large);
  if (error == std::errc() && end == value.text.data() + value.text.size()) return std::bit_cast<std::int64_t>(large);
  text_.fail_at(value.position, "\"" + value.text + "\" is no whole number.");
}

Query::Value ConditionWriter::number(const Value& value, Compare compare) const {
  if (compare == Compare::contains)
    text_.fail_at(value.position, "a metric cannot be searched with ~; expected a comparison.");
  if (!value.quoted && value.text == "true") return 1.0;
  if (!value.quoted && value.text == "false") return 0.0;
  if (const auto number = read_number(value.text)) return *number;
  text_.fail_at(value.position, "\"" + value.text + "\" is no number.");
}

/// The field's SQL with its values bound: each $ becomes the number of its parameter.
std::string ConditionWriter::use(const QueryField& field) {
  std::string sql;
  std::size_t next = 0;
  for (const char c : field.sql) sql += c == '$' ? bind(field.values[next++]) : std::string(1, c);
  return sql;
}

std::string ConditionWriter::bind(Query::Value value) {
  values_.push_back(std::move(value));
  return "?" + std::to_string(values_.size());
}

}  // namespace vigil
