#include "db/sort.hpp"

#include <algorithm>
#include <array>

#include "engine/core/json.hpp"

namespace vigil {

namespace {

constexpr std::array<std::string_view, 8> kPlain = {"id",       "created", "started", "ended",
                                                    "scenario", "family",  "state",   "seed"};

std::string parameter(std::vector<Query::Value>& values, Query::Value value) {
  values.push_back(std::move(value));
  return "?" + std::to_string(values.size());
}

std::string to_hex(const std::string& bytes) {
  static const char* const digits = "0123456789abcdef";
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    out += digits[byte >> 4];
    out += digits[byte & 15];
  }
  return out;
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

std::string from_hex(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    const int high = digit(text[i]), low = digit(text[i + 1]);
    if (high < 0 || low < 0) return {};
    out += static_cast<char>(16 * high + low);
  }
  return out;
}

std::string metric_key(const std::string& field, std::vector<Query::Value>& values) {
  const auto dot = field.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == field.size()) {
    throw QueryError(0, "sort by " + field +
                            " is not possible; expected id, created, started, ended, scenario, family, state, seed, "
                            "metrics.<name> or <lane>.<name>, with - before it for falling order.");
  }
  const std::string lane = field.substr(0, dot);
  std::string sql = "(SELECT min(value) FROM metric WHERE metric.run=run.id AND metric.node='' AND metric.name=" +
                    parameter(values, field.substr(dot + 1));
  if (lane != "metrics") sql += " AND metric.lane=" + parameter(values, lane);
  return sql + ")";
}

}  // namespace

RowOrder::RowOrder(std::string_view sort, std::string_view cursor, std::vector<Query::Value>& values)
    : sort_(sort.empty() ? "-id" : sort) {
  falling_ = sort_[0] == '-';
  const std::string field = sort_.substr(falling_ ? 1 : 0);
  const bool plain = std::find(kPlain.begin(), kPlain.end(), field) != kPlain.end();
  key_ = plain ? "run." + field : metric_key(field, values);
  if (!cursor.empty()) read_cursor(cursor, values);
}

void RowOrder::read_cursor(std::string_view cursor, std::vector<Query::Value>& values) {
  const Json read = Json::parse(from_hex(cursor), nullptr, false);
  const bool sound = read.is_array() && read.size() == 3 && read[0] == sort_ && read[2].is_number_integer() &&
                     (read[1].is_null() || read[1].is_number() || read[1].is_string());
  if (!sound) throw QueryError(0, "this cursor does not belong to this list; start again without one.");
  const std::string beyond = falling_ ? "<" : ">";
  const std::string id = parameter(values, read[2].get<std::int64_t>());
  const std::string later = "run.id" + beyond + id;
  if (read[1].is_null()) {
    after_ = "(" + key_ + " IS NULL AND " + later + ")";
    return;
  }
  Query::Value value;
  if (read[1].is_string()) {
    value = read[1].get<std::string>();
  } else if (read[1].is_number_integer()) {
    value = read[1].get<std::int64_t>();
  } else {
    value = read[1].get<double>();
  }
  const std::string place = parameter(values, value);
  after_ = "(" + key_ + beyond + place + " OR (" + key_ + "=" + place + " AND " + later + ") OR " + key_ + " IS NULL)";
}

std::string RowOrder::clause() const {
  const std::string way = falling_ ? " DESC" : " ASC";
  return " ORDER BY sort_key IS NULL,sort_key" + way + ",run.id" + way;
}

std::string RowOrder::cursor_of(const Statement& row, int key_column, std::int64_t id) const {
  Json key;
  if (!row.null(key_column)) {
    const auto type = row.type(key_column);
    if (type == SQLITE_INTEGER) key = row.integer(key_column);
    if (type == SQLITE_FLOAT) key = row.real(key_column);
    if (type == SQLITE_TEXT) key = row.text(key_column);
  }
  return to_hex(Json::array({sort_, key, id}).dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace vigil
