#include "engine/run/trace.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/missing.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostColumns = 100'000;
constexpr std::size_t kLongestName = 256;
constexpr std::int64_t kRemembered = 16;  ///< rows of a trace that grows

std::string_view trimmed(std::string_view cell) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!cell.empty() && blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && blank(cell.back())) cell.remove_suffix(1);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
  return cell;
}

bool is_name(std::string_view name) {
  const auto plain = [](char c) { return static_cast<unsigned char>(c) > 0x20U && c != '"' && c != 0x7F; };
  return !name.empty() && name.size() <= kLongestName && std::all_of(name.begin(), name.end(), plain) && is_utf8(name);
}

}  // namespace

/// Reads one text once, from front to back; remembers where it is for the messages.
class TraceReader {
 public:
  TraceReader(std::string_view text, std::size_t max_cells) : rest_(text), max_cells_(max_cells) {
    if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  }

  Trace read() {
    header();
    reserve();
    std::string_view line;
    while (next_line(line)) row(line);
    if (trace_.rows_ == 0) refuse("the trace has no rows; expected at least one tick below the header");
    even();
    return std::move(trace_);
  }

 private:
  [[noreturn]] void refuse(const std::string& detail) const {
    throw InputError("", "line " + std::to_string(line_) + ": " + detail, "k,t,<signal names> and one row a tick");
  }

  [[noreturn]] void refuse_cell(std::size_t column, const std::string& detail) const {
    const std::string name = column == 0 ? "k" : column == 1 ? "t" : trace_.columns_[column - 2];
    refuse("column " + std::to_string(column + 1) + " (" + name + ") " + detail);
  }

  /// The next line without its end; false at the end of the text. Empty lines are skipped only where nothing follows
  /// them.
  bool next_line(std::string_view& line) {
    if (rest_.find_first_not_of("\r\n") == std::string_view::npos) return false;
    ++line_;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return true;
  }

  /// The next cell of a line; false when there is none left.
  static bool next_cell(std::string_view& line, std::string_view& cell) {
    if (line.data() == nullptr) return false;
    const void* comma = line.empty() ? nullptr : std::memchr(line.data(), ',', line.size());
    if (comma == nullptr) {
      cell = line;
      line = {};
      return true;
    }
    const auto length = static_cast<std::size_t>(static_cast<const char*>(comma) - line.data());
    cell = line.substr(0, length);
    line.remove_prefix(length + 1);
    return true;
  }

  void header() {
    std::string_view line;
    if (!next_line(line)) refuse("the trace is empty; expected a header k,t,<signal names>");
    std::string_view cell;
    std::size_t column = 0;
    while (next_cell(line, cell)) {
      const std::string_view name = trimmed(cell);
      if (column < 2) {
        const std::string_view expected = column == 0 ? "k" : "t";
        if (name != expected)
          refuse("the header's column " + std::to_string(column + 1) + " is " + in_quotes(name) + "; expected " +
                 in_quotes(expected));
      } else {
        name_column(name, column);
      }
      ++column;
    }
    if (column < 2) refuse("the header has one column; expected k,t,<signal names>");
  }

  void name_column(std::string_view name, std::size_t column) {
    const std::string place = "the header's column " + std::to_string(column + 1);
    if (!is_name(name)) refuse(place + " is " + in_quotes(name) + "; expected a signal name without blanks");
    if (column >= kMostColumns) refuse("the header has more than " + std::to_string(kMostColumns) + " columns");
    const int index = static_cast<int>(column) - 2;
    const auto [first, fresh] = trace_.index_.emplace(std::string(name), index);
    if (!fresh) refuse(place + " repeats " + in_quotes(name) + " of column " + std::to_string(first->second + 3));
    trace_.columns_.emplace_back(name);
  }

  /// Every cell takes at least one byte of text, so the text's length bounds what a hostile header can ask for.
  void reserve() {
    const auto lines = static_cast<std::size_t>(std::count(rest_.begin(), rest_.end(), '\n')) + 1;
    const std::size_t columns = trace_.columns_.size();
    trace_.cells_.reserve(std::min({lines * columns, rest_.size() + 1, max_cells_}));
    times_.reserve(lines);
  }

  void row(std::string_view line) {
    const std::size_t columns = trace_.columns_.size();
    if (line.empty()) refuse("the line is empty; expected " + std::to_string(columns + 2) + " cells");
    if (trace_.cells_.size() + columns > max_cells_)
      refuse("the trace has more than " + std::to_string(max_cells_) + " cells");
    std::string_view cell;
    std::size_t column = 0;
    while (next_cell(line, cell)) {
      if (column >= columns + 2) refuse("the row has more than the header's " + std::to_string(columns + 2) + " cells");
      if (column == 0) {
        tick(cell);
      } else if (column == 1) {
        time(cell);
      } else {
        trace_.cells_.push_back(number(cell, column));
      }
      ++column;
    }
    if (column != columns + 2) {
      refuse("the row has " + std::to_string(column) + " cells; expected the header's " + std::to_string(columns + 2));
    }
    ++trace_.rows_;
  }

  double number(std::string_view cell, std::size_t column) const {
    std::string_view text = trimmed(cell);
    if (text.empty()) return kMissing;
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) return beyond_range(text, column);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole) refuse_cell(column, "is " + in_quotes(text) + "; expected a number or nothing");
    if (!std::isfinite(value)) refuse_cell(column, "is " + in_quotes(text) + "; expected a finite number or nothing");
    return value;
  }

  /// from_chars reports underflow and overflow alike. A number too small to be told from zero is zero; one too large is
  /// refused.
  double beyond_range(std::string_view text, std::size_t column) const {
    const std::size_t exponent = text.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos ? text.substr(exponent + 1, 1) == "-" : text.find("0.") <= 1;
    if (!tiny) refuse_cell(column, "is " + in_quotes(text) + "; expected a finite number or nothing");
    return text.front() == '-' ? -0.0 : 0.0;
  }

  void tick(std::string_view cell) {
    const std::string_view text = trimmed(cell);
    std::int64_t k = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), k);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    constexpr std::int64_t kMost = 1'000'000'000'000;
    if (!whole || k < 0 || k > kMost) refuse_cell(0, "is " + in_quotes(text) + "; expected a tick (an integer from 0)");
    if (trace_.rows_ == 0) trace_.first_tick_ = k;
    const std::int64_t expected = trace_.first_tick_ + trace_.rows_;
    if (k != expected)
      refuse_cell(
          0, "is " + std::to_string(k) + "; expected " + std::to_string(expected) + ", since ticks count up by one");
  }

  void time(std::string_view cell) {
    const double t = number(cell, 1);
    if (std::isnan(t)) refuse_cell(1, "is empty; expected the time in seconds");
    if (!times_.empty() && !(t > times_.back())) {
      refuse_cell(1,
                  "is " + number_text(t) + "; expected more than the row above (" + number_text(times_.back()) + ")");
    }
    times_.push_back(t);
    if (times_.size() == 2) trace_.dt_ = times_[1] - times_[0];
  }

  /// A row off the even line by half a step or more would be read at the wrong tick.
  void even() {
    const std::size_t rows = times_.size();
    if (rows < 3) return;
    const double step = (times_.back() - times_.front()) / static_cast<double>(rows - 1);
    for (std::size_t i = 0; i < rows; ++i) {
      const double expected = times_.front() + step * static_cast<double>(i);
      if (std::abs(times_[i] - expected) < 0.5 * step) continue;
      line_ = static_cast<std::int64_t>(i) + 2;
      refuse_cell(1, "is " + number_text(times_[i]) + "; expected about " + number_text(expected) +
                         ", since the rows are evenly spaced");
    }
  }

  std::string_view rest_;
  std::size_t max_cells_;
  std::int64_t line_ = 0;
  std::vector<double> times_;
  Trace trace_;
};

Trace Trace::from_csv(std::string_view text, std::size_t max_cells) { return TraceReader(text, max_cells).read(); }

Trace Trace::growing(std::vector<std::string> columns) {
  Trace trace;
  trace.grows_ = true;
  trace.columns_ = std::move(columns);
  for (std::size_t c = 0; c < trace.columns_.size(); ++c) {
    if (!is_name(trace.columns_[c]) || !trace.index_.emplace(trace.columns_[c], static_cast<int>(c)).second)
      throw std::logic_error("a column without a name of its own: " + trace.columns_[c]);
  }
  trace.cells_.reserve(trace.columns_.size() * static_cast<std::size_t>(kRemembered + 1));
  return trace;
}

void Trace::append(std::span<const double> cells) {
  if (!grows_ || cells.size() != columns_.size()) throw std::logic_error("a row that this trace cannot take");
  cells_.insert(cells_.end(), cells.begin(), cells.end());
  ++rows_;
  if (rows_ - forgotten_ <= kRemembered) return;
  cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(columns_.size()));
  ++forgotten_;
}

int Trace::find(std::string_view column) const {
  const auto place = index_.find(std::string(column));
  return place == index_.end() ? -1 : place->second;
}

double Trace::at(std::int64_t k, int column) const {
  const std::int64_t row = k - first_tick_ - forgotten_;
  if (row < 0 || row >= rows_ - forgotten_ || column < 0 || column >= static_cast<int>(columns_.size()))
    return kMissing;
  return cells_[static_cast<std::size_t>(row) * columns_.size() + static_cast<std::size_t>(column)];
}

}  // namespace vigil
