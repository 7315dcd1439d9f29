#include "server/ingest/csv_cells.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace vigil {
namespace {

std::string_view trimmed(std::string_view cell) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!cell.empty() && blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && blank(cell.back())) cell.remove_suffix(1);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
  return cell;
}

}  // namespace

CsvCells::CsvCells(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  skip_blank();
}

void CsvCells::skip_blank() {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    if (!trimmed(rest_.substr(0, end)).empty()) return;
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++upcoming_;
  }
}

std::vector<std::string> CsvCells::next() {
  std::vector<std::string> cells;
  if (rest_.empty()) return cells;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  line_ = upcoming_++;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  skip_blank();
  return cells;
}

Json csv_number(const std::string& cell) {
  if (cell.empty()) return {};
  const char* const begin = cell.data() + (cell[0] == '+' && cell.size() > 1 && cell[1] != '-' ? 1 : 0);
  const char* const end = cell.data() + cell.size();
  std::uint64_t whole = 0;
  if (const auto read = std::from_chars(begin, end, whole); read.ec == std::errc() && read.ptr == end) return whole;
  double value = 0;
  const auto read = std::from_chars(begin, end, value);
  if (read.ec == std::errc::result_out_of_range && read.ptr == end) value = std::strtod(begin, nullptr);
  const bool number = (read.ec == std::errc() || read.ec == std::errc::result_out_of_range) && read.ptr == end;
  return number && std::isfinite(value) ? Json(value) : Json(cell);
}

}  // namespace vigil
