/// Rows of one run as they lie in blocks and tail. Used inside one read transaction.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "db/database.hpp"
#include "db/records.hpp"
#include "db/rollup.hpp"

namespace vigil {

/// How the run's samples lie in the file.
struct RunLayout {
  std::int64_t every = 1;
  double dt = 0;
  std::unordered_map<int, std::size_t> slots;  ///< logged signals: place in a tail row after t
  std::int64_t first = 0, last = -1;           ///< rows there are; row = k / every
  std::int64_t sealed_end = 0;                 ///< first row of the block after the newest sealed one
};

/// Nothing where there is no such run.
std::optional<RunLayout> read_layout(Database& database, RunId run);

/// Consecutive rows, some perhaps missing (their t is NaN), of chosen signals.
struct RowSpan {
  std::int64_t first = 0;  ///< row
  std::vector<double> t;
  std::vector<std::vector<double>> values;  ///< of each signal; NaN where the signal is not logged
  std::int64_t end() const { return first + static_cast<std::int64_t>(t.size()); }
};

class SampleSource {
 public:
  /// `signals` as the caller wants them; unknown ones read as NaN.
  SampleSource(Database& database, RunId run, const RunLayout& layout, std::vector<int> signals);

  /// The first block or the tail (at most kBlockRows rows of it) that holds rows >= row; nothing at the end. Only rows
  /// >= row are given. Throws ChunkError where a chunk is damaged.
  std::optional<RowSpan> next(std::int64_t row);
  /// Adds the rows [begin, end) of signal `index` to buckets of `width` rows counted from `origin`.
  void summarise(std::size_t index, std::int64_t begin, std::int64_t end, std::int64_t origin, std::int64_t width,
                 std::vector<Summary>& buckets);

 private:
  std::optional<RowSpan> next_block(std::int64_t row);
  std::optional<RowSpan> next_tail(std::int64_t row);
  bool read_chunk(std::int64_t block, int signal, std::vector<double>& values);
  void add_level(int level, std::size_t index, std::int64_t begin, std::int64_t end, std::int64_t origin,
                 std::int64_t width, std::vector<Summary>& buckets);
  void add_rollups(int level, int signal, std::int64_t begin, std::int64_t end, std::int64_t origin, std::int64_t width,
                   std::vector<Summary>& buckets);
  void add_rows(std::size_t index, std::int64_t begin, std::int64_t end, std::int64_t origin, std::int64_t width,
                std::vector<Summary>& buckets);
  void add_tail(std::size_t index, std::int64_t begin, std::int64_t end, std::int64_t origin, std::int64_t width,
                std::vector<Summary>& buckets);
  const RowSpan& whole_tail();

  Database& database_;
  const RunId run_;
  const RunLayout& layout_;
  const std::vector<int> signals_;
  std::optional<RowSpan> tail_;  ///< read once
};

/// The rows of `span` of which there is a tick.
inline bool present(const RowSpan& span, std::size_t i) { return span.t[i] == span.t[i]; }

}  // namespace vigil
