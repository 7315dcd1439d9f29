#include "server/ingest/assembler.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"

namespace vigil {

Assembler::Assembler(const PushedColumns& columns, AssemblerLimits limits)
    : columns_(columns),
      limits_(limits),
      awaited_(columns.nodes.size() + 1, 0),
      parts_(columns.nodes.size() + 1, 0),
      seqs_(limits.seqs) {
  for (std::size_t c = 0; c < columns.names.size(); ++c) {
    if (columns.reporter[c] >= 0) awaited_[group(static_cast<int>(c))] = 1;
    if (columns.reporter[c] >= 0 || columns.names[c].starts_with("input.")) ++parts_[group(static_cast<int>(c))];
  }
  awaited_.back() = columns.inputs ? 1 : 0;
}

/// The part of a tick that comes at once: a node's readings, or what is nobody's in particular.
std::size_t Assembler::group(int column) const {
  const int reporter = columns_.reporter[static_cast<std::size_t>(column)];
  return reporter < 0 ? awaited_.size() - 1 : static_cast<std::size_t>(reporter);
}

void Assembler::check_ahead(const std::vector<IngestRow>& rows) const {
  std::int64_t newest = closed_ + static_cast<std::int64_t>(window_.size());
  const std::int64_t most = newest + limits_.advance;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (limits_.last && rows[i].k > *limits_.last) continue;
    if (rows[i].k > newest + limits_.ahead)
      throw InputError(child("", i) + "/k",
                       "k is " + std::to_string(rows[i].k) + " and the newest tick before it is " +
                           std::to_string(newest) + "; expected at most " + std::to_string(limits_.ahead) +
                           " ticks more",
                       "up to " + std::to_string(newest + limits_.ahead));
    newest = std::max(newest, rows[i].k);
    if (newest > most)
      throw InputError(child("", i) + "/k",
                       "k is " + std::to_string(newest) + "; one call may go on to tick " + std::to_string(most),
                       "fewer ticks at once");
  }
}

Tally Assembler::take(const std::vector<IngestRow>& rows, double now) {
  check_ahead(rows);
  expire(now);
  Tally tally;
  for (const IngestRow& row : rows) take(row, now, tally);
  return tally;
}

void Assembler::take(const IngestRow& row, double now, Tally& tally) {
  if (limits_.last && row.k > *limits_.last) {
    ++tally.beyond;
  } else if (row.k <= closed_) {
    ++tally.late;
  } else if (row.seq && seqs_.known(row.memory(columns_), *row.seq)) {
    ++tally.duplicate;
  } else if (OpenTick& tick = reach(row.k, now); !(row.partial ? apply_partial(row, tick) : apply(row, tick))) {
    ++tally.duplicate;
  } else {
    if (row.seq) seqs_.remember(row.memory(columns_), *row.seq);
    ++tally.accepted;
    close_complete();
  }
}

Assembler::OpenTick& Assembler::reach(std::int64_t k, double now) {
  while (closed_ + static_cast<std::int64_t>(window_.size()) < k) {
    if (window_.size() == limits_.open) close_front();
    OpenTick tick;
    tick.cells.assign(columns_.names.size(), std::numeric_limits<double>::quiet_NaN());
    tick.reported.assign(awaited_.size(), 0);
    tick.seen.assign(columns_.names.size(), 0);
    tick.left = parts_;
    tick.missing = static_cast<std::size_t>(std::count(awaited_.begin(), awaited_.end(), 1));
    tick.since = now;
    window_.push_back(std::move(tick));
  }
  return window_[static_cast<std::size_t>(k - closed_ - 1)];
}

/// False where all of it was there already. What a part said first, it said.
bool Assembler::apply(const IngestRow& row, OpenTick& tick) {
  const std::vector<char> before = tick.reported;
  const auto first = [&](std::size_t part) {
    if (before[part] != 0) return false;
    report(tick, part);
    return true;
  };
  bool fresh = row.source >= 0 ? first(static_cast<std::size_t>(row.source)) : row.values.empty() && !tick.touched;
  for (const auto& [column, value] : row.values) {
    if (!first(group(column))) continue;
    tick.cells[static_cast<std::size_t>(column)] = value;
    fresh = true;
  }
  tick.touched = true;
  return fresh;
}

/// A part whose rows bring a column each has reported when all of its columns are there.
bool Assembler::apply_partial(const IngestRow& row, OpenTick& tick) {
  bool fresh = false;
  for (const auto& [column, value] : row.values) {
    const auto c = static_cast<std::size_t>(column);
    const std::size_t part = group(column);
    if (tick.reported[part] != 0 || tick.seen[c] != 0) continue;
    tick.seen[c] = 1;
    tick.cells[c] = value;
    fresh = true;
    const bool counts = columns_.reporter[c] >= 0 || columns_.names[c].starts_with("input.");
    if (counts && --tick.left[part] == 0) report(tick, part);
  }
  tick.touched = true;
  return fresh;
}

void Assembler::report(OpenTick& tick, std::size_t group) const {
  if (tick.reported[group] == 0 && awaited_[group] != 0) --tick.missing;
  tick.reported[group] = 1;
}

void Assembler::close_front() {
  ready_.push_back(std::move(window_.front().cells));
  window_.pop_front();
  ++closed_;
}

void Assembler::close_complete() {
  while (!window_.empty() && window_.front().missing == 0) close_front();
}

void Assembler::expire(double now) {
  while (!window_.empty() && window_.front().since + limits_.deadline <= now) close_front();
  close_complete();
}

std::optional<double> Assembler::due() const {
  if (window_.empty()) return std::nullopt;
  return window_.front().since + limits_.deadline;
}

std::vector<std::int64_t> Assembler::open() const {
  std::vector<std::int64_t> ticks;
  for (std::size_t i = 0; i < window_.size(); ++i) {
    if (window_[i].touched) ticks.push_back(closed_ + 1 + static_cast<std::int64_t>(i));
  }
  return ticks;
}

std::vector<double> Assembler::pop() {
  std::vector<double> cells = std::move(ready_.front());
  ready_.pop_front();
  return cells;
}

}  // namespace vigil
