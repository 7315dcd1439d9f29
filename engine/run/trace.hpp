/// A recorded input that takes the place of the world: the contract, section 3.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/core/input_error.hpp"

namespace vigil {

class Trace {
 public:
  /// Reads a frame file: header "k,t,<signal names>", one row a tick, empty = missing. Throws InputError naming line
  /// and column: ragged rows, numbers that are not, non-finite numbers, ticks that do not count up by one, times that
  /// do not grow evenly, names given twice, more than `max_cells` cells. CRLF, a byte order mark, quoted names and
  /// blanks around numbers are read.
  static Trace from_csv(std::string_view text, std::size_t max_cells = 200'000'000);

  /// A trace of these columns (names as above, no two the same) that has no row yet and grows from tick 0. It remembers
  /// its newest rows only: what a run needs that follows it tick by tick.
  static Trace growing(std::vector<std::string> columns);
  bool grows() const { return grows_; }
  /// The row of tick rows(), one cell a column, NaN where missing. Of a growing trace only; throws std::logic_error.
  void append(std::span<const double> cells);

  /// Every bit of a trace that does not grow, and back. load() throws std::runtime_error where the bytes are damaged,
  /// save() std::logic_error where the trace grows.
  std::string save() const;
  static Trace load(std::string_view bytes);

  std::int64_t first_tick() const { return first_tick_; }
  std::int64_t rows() const { return rows_; }
  double dt() const { return dt_; }                                     ///< of the first two rows, s; 0 with one row
  const std::vector<std::string>& columns() const { return columns_; }  ///< without k and t
  int find(std::string_view column) const;                              ///< -1: not there
  /// NaN where missing, outside the trace or no longer remembered.
  double at(std::int64_t k, int column) const;

 private:
  friend class TraceReader;
  std::int64_t first_tick_ = 0;
  std::int64_t rows_ = 0;
  std::int64_t forgotten_ = 0;  ///< rows
  bool grows_ = false;
  double dt_ = 0;
  std::vector<std::string> columns_;
  std::unordered_map<std::string, int> index_;
  std::vector<double> cells_;  ///< row-major
};

}  // namespace vigil
