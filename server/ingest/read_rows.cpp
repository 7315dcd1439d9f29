#include "server/ingest/read_rows.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "engine/core/missing.hpp"
#include "server/front/message.hpp"
#include "server/ingest/csv_cells.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostRows = 20'000;
constexpr std::int64_t kLastTick = 1'000'000'000'000;

void check_count(std::size_t rows) {
  if (rows > kMostRows)
    throw InputError("", "more than " + std::to_string(kMostRows) + " rows at once", "20000 rows a call");
}

/// The strict reading that every body of this server gets.
Json parse(std::string text) {
  HttpRequest request;
  request.body = std::move(text);
  return request.json();
}

bool blank(std::string_view line) { return line.find_first_not_of(" \t\r\n") == std::string_view::npos; }

std::int64_t read_tick(const Json& json, const std::string& pointer) {
  const auto k = json.find("k");
  static const Json none;
  const bool fits = k != json.end() && k->is_number_unsigned() && k->get<std::uint64_t>() <= kLastTick;
  if (!fits)
    throw InputError(pointer + "/k", "k is " + shown(k == json.end() ? none : *k) + "; expected a tick",
                     "an integer from 0 to 1000000000000");
  return k->get<std::int64_t>();
}

}  // namespace

RowReader::RowReader(const PushedColumns& columns) : columns_(columns) {
  for (std::size_t c = 0; c < columns.names.size(); ++c) {
    index_.emplace(columns.names[c], static_cast<int>(c));
    states_.push_back(largest_state(columns.names[c]));
  }
}

std::vector<IngestRow> RowReader::read(std::string_view type, const std::string& body) const {
  if (!is_utf8(body)) throw HttpError(400, "The body is not UTF-8.");
  if (blank(body)) throw HttpError(400, "The body holds no row.");
  std::vector<IngestRow> rows =
      type == "text/csv" ? read_csv(body) : (type == "application/x-ndjson" ? read_lines(body) : read_json(body));
  if (rows.empty()) throw HttpError(400, "The body holds no row.");
  return rows;
}

std::vector<IngestRow> RowReader::read_lines(const std::string& body) const {
  std::vector<IngestRow> rows;
  std::size_t line = 0;
  for (std::size_t at = 0; at < body.size(); ++line) {
    const std::size_t end = std::min(body.find('\n', at), body.size());
    std::string text = body.substr(at, end - at);
    at = end + 1;
    if (blank(text)) continue;
    check_count(rows.size() + 1);
    Json json;
    try {
      json = parse(std::move(text));
    } catch (const HttpError& error) {
      throw HttpError(400, "Line " + std::to_string(line + 1) + ": " + error.what());
    }
    rows.push_back(row(json, rows.size()));
  }
  return rows;
}

std::vector<IngestRow> RowReader::read_json(const std::string& body) const {
  std::vector<IngestRow> rows;
  const std::size_t first = body.find_first_not_of(" \t\r\n");
  const bool many = first != std::string::npos && body[first] == '[';
  const Json json = parse(many ? "{\"rows\":" + body + "}" : body);
  if (!many) return {row(json, 0)};
  if (json.size() != 1) throw HttpError(400, "The body must be a JSON object or one array of them.");
  const Json& list = json.at("rows");
  check_count(list.size());
  for (const Json& item : list) rows.push_back(row(item, rows.size()));
  return rows;
}

IngestRow RowReader::row(const Json& json, std::size_t index) const {
  const std::string pointer = child("", index);
  if (!json.is_object()) throw InputError(pointer, "the row is " + shown(json) + "; expected an object", "object");
  for (const auto& [key, value] : json.items()) {
    if (key != "seq" && key != "k" && key != "node" && key != "values")
      throw InputError(child(pointer, key), "there is no " + in_quotes(key) + " in a row", "seq, k, node, values");
  }
  IngestRow row;
  row.k = read_tick(json, pointer);
  if (json.contains("seq") && !json.at("seq").is_null()) {
    const Json& seq = json.at("seq");
    if (!seq.is_number_unsigned())
      throw InputError(pointer + "/seq", "seq is " + shown(seq) + "; expected a count", "an integer from 0");
    row.seq = seq.get<std::uint64_t>();
  }
  if (json.contains("node") && !json.at("node").is_null()) {
    const Json& node = json.at("node");
    const std::string name = node.is_string() ? node.get<std::string>() : node.dump();
    const auto place = std::find(columns_.nodes.begin(), columns_.nodes.end(), name);
    if (place == columns_.nodes.end())
      throw InputError(pointer + "/node", "there is no node " + in_quotes(name), listed(columns_.nodes));
    row.source = static_cast<int>(place - columns_.nodes.begin());
  }
  const auto values = json.find("values");
  if (values == json.end() || !values->is_object())
    throw InputError(pointer + "/values",
                     "values is " + shown(values == json.end() ? Json() : *values) +
                         "; expected an object of channels and their values",
                     "object");
  add_values(*values, index, row);
  return row;
}

void RowReader::add_values(const Json& values, std::size_t index, IngestRow& row) const {
  const std::string pointer = child("", index) + "/values";
  for (const auto& [name, value] : values.items())
    row.values.push_back(cell(name, row.source, value, child(pointer, name)));
}

int RowReader::find(const std::string& name, int node, const std::string& pointer) const {
  const std::string id = node < 0 ? std::string() : columns_.nodes[static_cast<std::size_t>(node)];
  const auto place = index_.find(node < 0 ? name : "sensor." + id + "." + name);
  if (place != index_.end()) return place->second;
  std::vector<std::string> allowed;
  for (std::size_t c = 0; c < columns_.names.size(); ++c) {
    if (node < 0) allowed.push_back(columns_.names[c]);
    if (node >= 0 && columns_.reporter[c] == node) allowed.push_back(columns_.names[c].substr(8 + id.size()));
  }
  const std::string who = node < 0 ? "this run takes no column " : "node " + in_quotes(id) + " has no channel ";
  throw InputError(pointer, who + in_quotes(name), listed(allowed));
}

std::pair<int, double> RowReader::cell(const std::string& name, int node, const Json& value,
                                       const std::string& pointer) const {
  const int column = find(name, node, pointer);
  if (value.is_null()) return {column, kMissing};
  const double number = value.is_number() ? value.get<double>() : kMissing;
  if (!std::isfinite(number))
    throw InputError(pointer, in_quotes(name) + " is " + shown(value) + "; expected a finite number or null",
                     "a finite number or null");
  const auto& largest = states_[static_cast<std::size_t>(column)];
  if (largest && !(number >= 0 && number <= *largest && number == std::floor(number)))
    throw InputError(pointer, in_quotes(name) + " is " + number_text(number) + "; expected a state",
                     "an integer from 0 to " + std::to_string(*largest));
  return {column, number};
}

std::vector<IngestRow> RowReader::read_csv(std::string_view body) const {
  CsvCells cells(body);
  std::vector<std::string> header = cells.next();
  std::vector<IngestRow> rows;
  int tick = -1;
  for (std::size_t c = 0; c < header.size(); ++c) {
    if (header[c] == "k") tick = static_cast<int>(c);
    if (std::count(header.begin(), header.end(), header[c]) > 1)
      throw InputError("", "the header has " + in_quotes(header[c]) + " twice", "every column once");
    if (header[c] != "k" && header[c] != "t" && header[c] != "seq") find(header[c], -1, "");
  }
  if (tick < 0) throw InputError("", "the header has no column k", "k,<signal names>");
  while (cells.more()) {
    const std::vector<std::string> line = cells.next();
    check_count(rows.size() + 1);
    if (line.size() != header.size())
      throw InputError("", "line " + std::to_string(cells.line()) + " has " + std::to_string(line.size()) +
                               " cells; expected the header's " + std::to_string(header.size()));
    Json json{{"k", csv_number(line[static_cast<std::size_t>(tick)])}};
    IngestRow row;
    const std::string pointer = child("", rows.size());
    row.k = read_tick(json, pointer);
    for (std::size_t c = 0; c < header.size(); ++c) {
      if (header[c] == "k" || header[c] == "t") continue;
      const Json value = csv_number(line[c]);
      if (header[c] != "seq") {
        row.values.push_back(cell(header[c], -1, value, child(pointer, header[c])));
      } else if (value.is_number_unsigned()) {
        row.seq = value.get<std::uint64_t>();
      } else if (!value.is_null()) {
        throw InputError(pointer + "/seq", "seq is " + shown(value) + "; expected a count", "an integer from 0");
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace vigil
