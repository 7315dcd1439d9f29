/// A table somebody recorded: a header of names and rows of cells, with whatever other columns it has.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace vigil::identify {

/// Names and numbers of some columns of a file. values: rows x columns, NaN where a cell is empty.
struct Table {
  std::vector<std::string> columns;
  Eigen::MatrixXd values;
};

/// The header's names, without blanks and quotes around them. Throws InputError where there is no header.
std::vector<std::string> header_of(std::string_view text);

/// The header's names that the patterns name, each once, in the order of the patterns and then of the file; `*` stands
/// for any text. Throws InputError where a pattern names none of them (with the nearest name).
std::vector<std::string> chosen_columns(const std::vector<std::string>& header,
                                        const std::vector<std::string>& patterns);

/// Reads those columns; the cells of others are never looked at. Throws InputError naming line and column: ragged rows,
/// names that are not there or there twice, numbers that are not, or are beyond 1e100, more than `max_cells` cells.
/// CRLF, a byte order mark, quoted cells and blanks around names and numbers are read.
Table read_table(std::string_view text, const std::vector<std::string>& columns, std::size_t max_cells = 20'000'000);

}  // namespace vigil::identify
