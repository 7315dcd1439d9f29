/// The lines and cells of a CSV text, one after the other.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

/// Commas between cells, no quoting but around a whole cell; CRLF and a byte order mark are read, blank lines skipped.
class CsvCells {
 public:
  explicit CsvCells(std::string_view text);
  bool more() const { return !rest_.empty(); }
  std::vector<std::string> next();            ///< the cells of the next line, without blanks around them
  std::size_t line() const { return line_; }  ///< of the last next(), from 1

 private:
  void skip_blank();
  std::string_view rest_;
  std::size_t line_ = 0, upcoming_ = 1;
};

/// A cell as JSON: null where empty, an integer, a number, or the text itself where it is neither. Numbers beyond a
/// double are texts, too.
Json csv_number(const std::string& cell);

}  // namespace vigil
