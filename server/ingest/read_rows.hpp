/// Rows pushed into a run, as NDJSON, JSON or CSV. A pure function of bytes, so that it can be fuzzed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/run/pushed_columns.hpp"

namespace vigil {

struct IngestRow {
  std::int64_t k = 0;                          ///< tick
  std::optional<std::uint64_t> seq;            ///< the sender's count of its rows, of one source never twice
  int source = -1;                             ///< the node that sent it, -1: a row for any of them
  std::vector<std::pair<int, double>> values;  ///< column and value, NaN: reported as missing
  bool partial = false;                        ///< its node says more of this tick in rows of their own

  /// Whose sequence numbers its seq is one of: its source's, or, of a partial row, its column's.
  int memory(const PushedColumns& columns) const {
    if (!partial || values.empty()) return source;
    return static_cast<int>(columns.nodes.size()) + values.front().first;
  }
};

class RowReader {
 public:
  explicit RowReader(const PushedColumns& columns);

  /// Of a body of that type (application/x-ndjson, application/json, text/csv). All rows or none: throws HttpError 400
  /// where the text cannot be read, InputError (pointers /<row>/<member>) where a row is not one of this run: an
  /// unknown node or channel, a number that is not finite, more than 20000 rows.
  std::vector<IngestRow> read(std::string_view type, const std::string& body) const;
  /// Of one row as JSON; `index` is for the pointers. Throws InputError.
  IngestRow row(const Json& json, std::size_t index) const;

 private:
  std::vector<IngestRow> read_lines(const std::string& body) const;
  std::vector<IngestRow> read_json(const std::string& body) const;
  std::vector<IngestRow> read_csv(std::string_view body) const;
  void add_values(const Json& values, std::size_t index, IngestRow& row) const;
  std::pair<int, double> cell(const std::string& name, int node, const Json& value, const std::string& pointer) const;
  int find(const std::string& name, int node, const std::string& pointer) const;

  const PushedColumns& columns_;
  std::unordered_map<std::string, int> index_;
  std::vector<std::optional<int>> states_;  ///< by column: its largest state
};

}  // namespace vigil
