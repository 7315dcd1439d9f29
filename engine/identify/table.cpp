#include "engine/identify/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "engine/core/missing.hpp"
#include "engine/core/params.hpp"

namespace vigil::identify {
namespace {

constexpr std::size_t kMostColumns = 10'000;
constexpr double kLargest = 1e100;  ///< squares and their sums stay finite

std::string_view trimmed(std::string_view cell) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!cell.empty() && blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && blank(cell.back())) cell.remove_suffix(1);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') return trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

/// Line by line and cell by cell; remembers the line for the messages.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  }

  /// The cells of the next line; false at the end of the text. Empty lines at the end are none.
  bool next(std::vector<std::string_view>& cells) {
    if (rest_.find_first_not_of("\r\n") == std::string_view::npos) return false;
    ++line_;
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    cells.clear();
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
      if (i < line.size() && line[i] == '"') quoted = !quoted;
      if (i < line.size() && (line[i] != ',' || quoted)) continue;
      cells.push_back(trimmed(line.substr(begin, i - begin)));
      begin = i + 1;
    }
    return true;
  }

  std::size_t line() const { return line_; }
  std::size_t longest_rest() const {
    return static_cast<std::size_t>(std::count(rest_.begin(), rest_.end(), '\n')) + 1;
  }

 private:
  std::string_view rest_;
  std::size_t line_ = 0;
};

[[noreturn]] void refuse(std::size_t line, const std::string& detail) {
  throw InputError("", fmt::format("line {}: {}", line, detail), "a header of names and one row a tick");
}

std::vector<std::string> header_of(Lines& lines) {
  std::vector<std::string_view> cells;
  if (!lines.next(cells)) throw InputError("", "the file is empty; expected a header of names", "a header of names");
  if (cells.size() > kMostColumns) refuse(1, fmt::format("the header has more than {} columns", kMostColumns));
  std::vector<std::string> names;
  for (const std::string_view cell : cells) {
    if (!is_utf8(cell)) refuse(1, fmt::format("the header's column {} is not UTF-8", names.size() + 1));
    names.emplace_back(cell);
  }
  return names;
}

[[noreturn]] void refuse_column(const std::string& name, const std::vector<std::string>& header) {
  const std::string near = nearest(name, header);
  throw InputError("",
                   fmt::format("line 1: there is no column {}{}", in_quotes(name),
                               near.empty() ? "" : "; the nearest is " + in_quotes(near)),
                   listed(header));
}

/// Where in the header the column stands. Throws where it is not there, or there twice.
std::size_t place_of(const std::string& name, const std::vector<std::string>& header) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) refuse_column(name, header);
  const auto again = std::find(found + 1, header.end(), name);
  if (again != header.end())
    refuse(1, fmt::format("column {} repeats the name {} of column {}", again - header.begin() + 1, in_quotes(name),
                          found - header.begin() + 1));
  return static_cast<std::size_t>(found - header.begin());
}

double number(std::string_view text, std::size_t line, std::size_t column, const std::string& name) {
  if (text.empty()) return kMissing;
  std::string_view digits = text;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !(std::abs(value) <= kLargest))
    refuse(line, fmt::format("column {} ({}) is {}; expected a number up to 1e100 or nothing", column + 1, name,
                             in_quotes(text)));
  return value;
}

/// True where the pattern, in which '*' stands for any text, is the whole name.
bool fits(std::string_view pattern, std::string_view name) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == name;
  if (name.substr(0, star) != pattern.substr(0, star)) return false;
  pattern.remove_prefix(star + 1);
  for (std::size_t skip = star; skip <= name.size(); ++skip) {
    if (fits(pattern, name.substr(skip))) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> header_of(std::string_view text) {
  Lines lines(text);
  return header_of(lines);
}

std::vector<std::string> chosen_columns(const std::vector<std::string>& header,
                                        const std::vector<std::string>& patterns) {
  std::vector<std::string> chosen;
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (const std::string& name : header) {
      if (!fits(pattern, name)) continue;
      any = true;
      if (std::find(chosen.begin(), chosen.end(), name) == chosen.end()) chosen.push_back(name);
    }
    if (!any) refuse_column(pattern, header);
  }
  return chosen;
}

Table read_table(std::string_view text, const std::vector<std::string>& columns, std::size_t max_cells) {
  Lines lines(text);
  const std::vector<std::string> header = header_of(lines);
  std::vector<std::size_t> places;
  for (const std::string& name : columns) places.push_back(place_of(name, header));
  std::vector<double> values;
  values.reserve(std::min(max_cells, lines.longest_rest() * columns.size()));
  std::vector<std::string_view> cells;
  Eigen::Index rows = 0;
  while (lines.next(cells)) {
    if (cells.size() != header.size())
      refuse(lines.line(), fmt::format("the row has {} cells; expected the header's {}", cells.size(), header.size()));
    if (values.size() + columns.size() > max_cells)
      refuse(lines.line(), fmt::format("the table has more than {} cells", max_cells));
    for (const std::size_t place : places) values.push_back(number(cells[place], lines.line(), place, header[place]));
    ++rows;
  }
  if (rows == 0) refuse(lines.line(), "no row follows the header; expected one row a tick");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return {columns, Eigen::Map<const RowMajor>(values.data(), rows, static_cast<Eigen::Index>(columns.size()))};
}

}  // namespace vigil::identify
