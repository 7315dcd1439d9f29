#include "db/samples.hpp"

#include <algorithm>
#include <cstring>

#include "db/chunk.hpp"
#include "db/schema.hpp"
#include "engine/core/missing.hpp"

namespace vigil {

std::optional<RunLayout> read_layout(Database& database, RunId run) {
  RunLayout layout;
  {
    auto query = database.cached("SELECT every,dt FROM run WHERE id=? AND deleted=0");
    if (!query.bind(1, run).step()) return std::nullopt;
    layout.every = query.integer(0);
    layout.dt = query.real(1);
  }
  auto signals = database.cached("SELECT id,slot FROM signal WHERE run=? AND slot IS NOT NULL");
  signals.bind(1, run);
  while (signals.step())
    layout.slots[static_cast<int>(signals.integer(0))] = static_cast<std::size_t>(signals.integer(1));
  bool any = false;
  const auto extend = [&](std::int64_t first, std::int64_t last) {
    layout.first = any ? std::min(layout.first, first) : first;
    layout.last = any ? std::max(layout.last, last) : last;
    any = true;
  };
  for (const char* sql : {"SELECT block,first,n FROM block WHERE run=? ORDER BY block LIMIT 1",
                          "SELECT block,first,n FROM block WHERE run=? ORDER BY block DESC LIMIT 1"}) {
    auto query = database.cached(sql);
    if (!query.bind(1, run).step()) continue;
    extend(query.integer(1), query.integer(1) + query.integer(2) - 1);
    layout.sealed_end = (query.integer(0) + 1) * kBlockRows;
  }
  auto tail = database.cached("SELECT min(k),max(k) FROM tail WHERE run=?");
  if (tail.bind(1, run).step() && !tail.null(0)) extend(tail.integer(0) / layout.every, tail.integer(1) / layout.every);
  return layout;
}

SampleSource::SampleSource(Database& database, RunId run, const RunLayout& layout, std::vector<int> signals)
    : database_(database), run_(run), layout_(layout), signals_(std::move(signals)) {}

bool SampleSource::read_chunk(std::int64_t block, int signal, std::vector<double>& values) {
  auto query = database_.cached("SELECT data FROM chunk WHERE run=? AND block=? AND sig=?");
  if (!query.all(run_, block, signal).step()) return false;
  decode_chunk(query.bytes(0), values);
  return true;
}

std::optional<RowSpan> SampleSource::next_block(std::int64_t row) {
  auto query =
      database_.cached("SELECT block,first,n FROM block WHERE run=? AND block>=? AND first+n>? ORDER BY block LIMIT 1");
  if (!query.all(run_, row / kBlockRows, row).step()) return std::nullopt;
  const std::int64_t block = query.integer(0);
  RowSpan span;
  span.first = query.integer(1);
  const auto n = static_cast<std::size_t>(query.integer(2));
  span.t.resize(n);
  if (!read_chunk(block, kTimeSignal, span.t)) {
    for (std::size_t i = 0; i < n; ++i) {
      span.t[i] = static_cast<double>((span.first + static_cast<std::int64_t>(i)) * layout_.every) * layout_.dt;
    }
  }
  for (const int signal : signals_) {
    auto& column = span.values.emplace_back(n, kMissing);
    if (layout_.slots.count(signal) > 0) read_chunk(block, signal, column);
  }
  const auto skip = std::max<std::int64_t>(0, row - span.first);
  const auto cut = [&](std::vector<double>& column) { column.erase(column.begin(), column.begin() + skip); };
  cut(span.t);
  for (auto& column : span.values) cut(column);
  span.first += skip;
  return span;
}

std::optional<RowSpan> SampleSource::next_tail(std::int64_t row) {
  auto query = database_.cached("SELECT k,v FROM tail WHERE run=? AND k>=? ORDER BY k LIMIT ?");
  query.all(run_, row * layout_.every, kBlockRows);
  RowSpan span;
  span.values.resize(signals_.size());
  std::vector<double> cells(layout_.slots.size() + 1);
  for (bool first = true; query.step(); first = false) {
    const std::int64_t at = query.integer(0) / layout_.every;
    const auto bytes = query.bytes(1);
    if (bytes.size() != cells.size() * sizeof(double)) throw ChunkError("a row of the tail has the wrong size");
    std::memcpy(cells.data(), bytes.data(), bytes.size());
    if (first) span.first = at;
    const auto place = static_cast<std::size_t>(at - span.first);
    if (place > 16 * kBlockRows) break;  // a long gap: the next call goes on behind it
    span.t.resize(place, kMissing);
    span.t.push_back(cells[0]);
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      span.values[i].resize(place, kMissing);
      const auto slot = layout_.slots.find(signals_[i]);
      span.values[i].push_back(slot == layout_.slots.end() ? kMissing : cells[slot->second + 1]);
    }
  }
  if (span.t.empty()) return std::nullopt;
  return span;
}

std::optional<RowSpan> SampleSource::next(std::int64_t row) {
  if (row < layout_.sealed_end) {
    if (auto span = next_block(row)) return span;
  }
  return next_tail(row);
}

void SampleSource::summarise(std::size_t index, std::int64_t begin, std::int64_t end, std::int64_t origin,
                             std::int64_t width, std::vector<Summary>& buckets) {
  if (layout_.slots.count(signals_[index]) == 0) return;
  int level = static_cast<int>(kRollupRows.size()) - 1;
  while (level >= 0 && width % kRollupRows[static_cast<std::size_t>(level)] != 0) --level;
  add_level(level, index, begin, end, origin, width, buckets);
}

void SampleSource::add_level(int level, std::size_t index, std::int64_t begin, std::int64_t end, std::int64_t origin,
                             std::int64_t width, std::vector<Summary>& buckets) {
  if (begin >= end) return;
  if (level < 0) {
    add_rows(index, begin, std::min(end, layout_.sealed_end), origin, width, buckets);
    add_tail(index, std::max(begin, layout_.sealed_end), end, origin, width, buckets);
    return;
  }
  const std::int64_t size = kRollupRows[static_cast<std::size_t>(level)];
  const std::int64_t from = (begin + size - 1) / size, to = std::min(end, layout_.sealed_end) / size;
  if (from >= to) {
    add_level(level - 1, index, begin, end, origin, width, buckets);
    return;
  }
  add_level(level - 1, index, begin, from * size, origin, width, buckets);
  add_rollups(level, signals_[index], from, to, origin, width, buckets);
  add_level(level - 1, index, to * size, end, origin, width, buckets);
}

void SampleSource::add_rollups(int level, int signal, std::int64_t begin, std::int64_t end, std::int64_t origin,
                               std::int64_t width, std::vector<Summary>& buckets) {
  auto query =
      database_.cached("SELECT b,lo,hi,mean,n,nan FROM rollup WHERE run=? AND sig=? AND level=? AND b>=? AND b<?");
  query.all(run_, signal, level, begin, end);
  const std::int64_t size = kRollupRows[static_cast<std::size_t>(level)];
  while (query.step()) {
    Summary summary;
    summary.lo = query.real(1);
    summary.hi = query.real(2);
    summary.n = query.integer(4);
    summary.sum = query.real(3) * static_cast<double>(summary.n);
    summary.nan = query.integer(5);
    buckets[static_cast<std::size_t>((query.integer(0) * size - origin) / width)].merge(summary);
  }
}

void SampleSource::add_rows(std::size_t index, std::int64_t begin, std::int64_t end, std::int64_t origin,
                            std::int64_t width, std::vector<Summary>& buckets) {
  if (begin >= end) return;
  auto query = database_.cached("SELECT block,first,n FROM block WHERE run=? AND block>=? AND block<=? ORDER BY block");
  query.all(run_, begin / kBlockRows, (end - 1) / kBlockRows);
  std::vector<double> values;
  while (query.step()) {
    const std::int64_t first = query.integer(1);
    values.assign(static_cast<std::size_t>(query.integer(2)), kMissing);
    if (!read_chunk(query.integer(0), signals_[index], values)) continue;
    const std::int64_t last = std::min(end, first + static_cast<std::int64_t>(values.size()));
    for (std::int64_t row = std::max(begin, first); row < last; ++row) {
      buckets[static_cast<std::size_t>((row - origin) / width)].add(values[static_cast<std::size_t>(row - first)]);
    }
  }
}

const RowSpan& SampleSource::whole_tail() {
  if (!tail_) tail_ = next_tail(layout_.sealed_end).value_or(RowSpan{});
  return *tail_;
}

void SampleSource::add_tail(std::size_t index, std::int64_t begin, std::int64_t end, std::int64_t origin,
                            std::int64_t width, std::vector<Summary>& buckets) {
  if (begin >= end) return;
  const RowSpan& tail = whole_tail();
  if (tail.t.empty()) return;
  const std::int64_t last = std::min(end, tail.end());
  for (std::int64_t row = std::max(begin, tail.first); row < last; ++row) {
    const auto place = static_cast<std::size_t>(row - tail.first);
    buckets[static_cast<std::size_t>((row - origin) / width)].add(tail.values[index][place]);
  }
}

}  // namespace vigil
