#include "server/ingest/plant_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "server/front/message.hpp"
#include "server/ingest/csv_cells.hpp"

namespace vigil {
namespace {

constexpr std::array kTimes{"t", "time", "timestamp", "ts"};
constexpr double kLastTick = 1e12;
constexpr std::size_t kMostRows = 20'000;

bool is_time(const std::string& key) { return std::find(kTimes.begin(), kTimes.end(), key) != kTimes.end(); }

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// The strict reading that every body of this server gets.
Json parse(const std::string& text) {
  HttpRequest request;
  request.body = text;
  return request.json();
}

std::optional<Json> parse_if(const std::string& text) {
  try {
    return parse(text);
  } catch (const HttpError&) {
    return std::nullopt;
  }
}

void check_count(std::size_t rows) {
  if (rows > kMostRows)
    throw InputError("", "more than " + std::to_string(kMostRows) + " rows at once", "20000 rows a message");
}

/// {"value":…} of what is only a value.
Json bare(const std::string& text) {
  if (text.empty() || text == "null") return {{"value", nullptr}};
  if (text == "true" || text == "false") return {{"value", text == "true"}};
  if (!is_utf8(text)) throw HttpError(400, "The payload is not UTF-8.");
  return {{"value", csv_number(text)}};
}

}  // namespace

PlantReader::PlantReader(const PushedColumns& columns, const RowReader& rows, PlantOptions options, double dt)
    : columns_(columns), rows_(rows), options_(std::move(options)), dt_(dt), start_(options_.start) {
  for (const auto& [name, column] : options_.signals) {
    if (std::find(columns.names.begin(), columns.names.end(), column) == columns.names.end())
      throw InputError(child("/input/ingest/mqtt/signals", name), "this run takes no column " + in_quotes(column),
                       listed(columns.names));
  }
}

std::string PlantReader::column(const std::string& name) const {
  const auto place = options_.signals.find(name);
  return place == options_.signals.end() ? name : place->second;
}

std::uint64_t PlantReader::tick_at(double seconds) {
  if (!start_) start_ = seconds;
  const double k = std::round((seconds - *start_) / dt_);
  if (!(k >= 0))
    throw InputError("/time", "the message is " + number_text(*start_ - seconds) + " s older than tick 0",
                     "from " + number_text(*start_));
  if (k > kLastTick) throw InputError("/time", "the message is of tick " + number_text(k), "up to tick 1000000000000");
  return static_cast<std::uint64_t>(k);
}

void PlantReader::set_tick(const Json& message, Json& row) {
  if (options_.clock == PlantOptions::Clock::arrival) {
    row["k"] = 0u;
  } else if (options_.clock == PlantOptions::Clock::ticks) {
    if (!message.contains("k"))
      throw InputError("/k", "the message has no k; a run whose plant does not count ticks has a \"clock\"",
                       "k, or a run with \"clock\":\"time\" or \"arrival\"");
    row["k"] = message.at("k");
  } else {
    for (const char* key : kTimes) {
      const auto member = message.find(key);
      if (member == message.end()) continue;
      const auto seconds = plant_seconds(*member);
      if (!seconds)
        throw InputError(child("", key), shown(*member) + " is no time", "seconds, milliseconds or ISO 8601");
      row["k"] = tick_at(*seconds);
      return;
    }
    throw InputError("/time", "the message has no time", "one of t, time, timestamp, ts");
  }
}

/// The message as a row of the HTTP ingest, without its tick.
Json PlantReader::row_of(const TopicPlace& place, const Json& message) const {
  Json row{{"values", Json::object()}};
  const auto node = message.find("node");
  const bool says = node != message.end() && !node->is_null();
  if (says) row["node"] = *node;
  if (!place.node.empty()) {
    if (says && *node != place.node && !(node->is_number() && node->dump() == place.node))
      throw InputError("/node",
                       "the message is of node " + shown(*node) + " and its topic of " + in_quotes(place.node));
    row["node"] = place.node;
  }
  if (message.contains("seq")) row["seq"] = message.at("seq");
  const bool whole = !row.contains("node");
  const auto add = [&](const std::string& name, const Json& value) {
    row["values"][whole ? column(name) : name] = value.is_boolean() ? Json(value.get<bool>() ? 1 : 0) : value;
  };
  if (const auto values = message.find("values"); values != message.end()) {
    if (!values->is_object()) row["values"] = *values;
    if (values->is_object())
      for (const auto& [name, value] : values->items()) add(name, value);
    return row;
  }
  for (const auto& [name, value] : message.items()) {
    if (name != "k" && name != "seq" && name != "node" && !is_time(name)) add(name, value);
  }
  if (row["values"].empty()) throw InputError("", "the message has no value", "values, or members that are channels");
  return row;
}

IngestRow PlantReader::object(const TopicPlace& place, const Json& message, std::size_t index) {
  if (!message.is_object())
    throw InputError(child("", index), "the row is " + shown(message) + "; expected an object", "object");
  Json row = row_of(place, message);
  set_tick(message, row);
  return rows_.row(row, index);
}

IngestRow PlantReader::value(const TopicPlace& place, const std::string& payload) {
  const std::string text = trimmed(payload);
  const Json message = text.starts_with('{') ? parse(text) : bare(text);
  const auto value = message.contains("value") ? message.find("value") : message.find("v");
  if (value == message.end()) throw InputError("/value", "the message has no value", "a number, or {\"value\":…}");
  Json row{{"values", Json::object()}};
  if (!place.node.empty()) row["node"] = place.node;
  row["values"][place.node.empty() ? column(place.channel) : place.channel] =
      value->is_boolean() ? Json(value->get<bool>() ? 1 : 0) : *value;
  if (message.contains("seq")) row["seq"] = message.at("seq");
  set_tick(message, row);
  IngestRow read = rows_.row(row, 0);
  if (read.source < 0 && !read.values.empty())
    read.source = columns_.reporter[static_cast<std::size_t>(read.values.front().first)];
  read.partial = true;
  return read;
}

std::vector<IngestRow> PlantReader::read(const TopicPlace& place, const std::string& payload) {
  const auto before = start_;
  try {
    return read_message(place, payload);
  } catch (...) {
    start_ = before;  // what is refused does not say when tick 0 is
    throw;
  }
}

std::vector<IngestRow> PlantReader::read_message(const TopicPlace& place, const std::string& payload) {
  if (!place.channel.empty()) return {value(place, payload)};
  const std::string text = trimmed(payload);
  if (!text.starts_with('{') && !text.starts_with('[')) {
    if (options_.clock == PlantOptions::Clock::time)
      throw InputError("", "a table has ticks, and this run's messages have times", "JSON, or the clock \"k\"");
    return rows_.read("text/csv", payload);
  }
  if (!is_utf8(text)) throw HttpError(400, "The payload is not UTF-8.");
  std::vector<IngestRow> rows;
  if (text.starts_with('[')) {
    const Json list = parse("{\"rows\":" + text + "}").at("rows");
    check_count(list.size());
    for (const Json& message : list) rows.push_back(object(place, message, rows.size()));
    return rows;
  }
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) return {object(place, parse(text), 0)};
  if (const auto whole = parse_if(text)) return {object(place, *whole, 0)};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t stop = std::min(text.find('\n', at), text.size());
    const std::string line = trimmed(text.substr(at, stop - at));
    at = stop + 1;
    if (line.empty()) continue;
    check_count(rows.size() + 1);
    rows.push_back(object(place, parse(line), rows.size()));
  }
  return rows;
}

}  // namespace vigil
