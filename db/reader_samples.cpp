/// LogReader's windows and raw rows.
#include <algorithm>

#include "db/chunk.hpp"
#include "db/reader_state.hpp"
#include "db/samples.hpp"

namespace vigil {

namespace {

std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return a <= 0 ? 0 : (a + b - 1) / b; }

/// Rows a bucket spans: of whole buckets of the coarsest level that does not blur more than half a bucket.
std::int64_t bucket_width(std::int64_t rows, std::int64_t points) {
  const std::int64_t width = ceil_div(rows, points);
  for (auto size = kRollupRows.rbegin(); size != kRollupRows.rend(); ++size) {
    const std::int64_t rounded = ceil_div(width, *size) * *size;
    if (2 * rounded <= 3 * width) return rounded;
  }
  return width;
}

void fill_raw(SampleSource& source, const RunLayout& layout, std::int64_t from, std::int64_t to, SampleWindow& window) {
  for (std::int64_t row = from; row <= to;) {
    const auto span = source.next(row);
    if (!span) break;
    for (std::size_t i = 0; i < span->t.size(); ++i) {
      const std::int64_t at = span->first + static_cast<std::int64_t>(i);
      if (at > to) break;
      if (!present(*span, i)) continue;
      window.k.push_back(at * layout.every);
      window.t.push_back(span->t[i]);
      for (std::size_t s = 0; s < window.series.size(); ++s) window.series[s].v.push_back(span->values[s][i]);
    }
    row = span->end();
  }
}

void fill_buckets(SampleSource& source, const RunLayout& layout, std::int64_t from, std::int64_t to, int points,
                  SampleWindow& window) {
  window.raw = false;
  const std::int64_t width = bucket_width(to - from + 1, points);
  const std::int64_t origin = from / width * width;
  const auto count = static_cast<std::size_t>((to - origin) / width + 1);
  window.bucket = width * layout.every;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t row = std::max(from, origin + static_cast<std::int64_t>(i) * width);
    window.k.push_back(row * layout.every);
    window.t.push_back(static_cast<double>(row * layout.every) * layout.dt);
  }
  for (std::size_t s = 0; s < window.series.size(); ++s) {
    std::vector<Summary> buckets(count);
    source.summarise(s, from, to + 1, origin, width, buckets);
    for (const auto& bucket : buckets) {
      window.series[s].lo.push_back(bucket.lo);
      window.series[s].hi.push_back(bucket.hi);
    }
  }
}

void fill_gaps(Database& database, RunId run, std::int64_t from, std::int64_t to, std::vector<GapRow>& gaps) {
  auto query = database.cached("SELECT first,last FROM gap WHERE run=? AND last>=? AND first<=? ORDER BY first");
  query.all(run, from, to);
  while (query.step()) gaps.push_back({query.integer(0), query.integer(1)});
}

}  // namespace

SampleWindow LogReader::samples(RunId run, const std::vector<int>& signals, std::int64_t from, std::int64_t to,
                                int points) const {
  SampleWindow window;
  for (const int signal : signals) window.series.push_back({signal, {}, {}, {}});
  const auto database = state_->lease();
  Transaction transaction(*database, "BEGIN");
  const auto layout = read_layout(*database, run);
  if (!layout) throw LogError(LogError::Kind::missing, "There is no run " + std::to_string(run) + ".");
  if (layout->last < layout->first) return window;
  window.first = layout->first * layout->every;
  window.last = layout->last * layout->every;
  fill_gaps(*database, run, from, to, window.gaps);
  const std::int64_t first = std::max(layout->first, ceil_div(from, layout->every));
  const std::int64_t last = to < 0 ? -1 : std::min(layout->last, to / layout->every);
  if (first > last) return window;
  SampleSource source(*database, run, *layout, signals);
  if (last - first + 1 <= std::max(1, points)) {
    fill_raw(source, *layout, first, last, window);
  } else {
    fill_buckets(source, *layout, first, last, std::max(1, points), window);
  }
  return window;
}

void LogReader::rows(RunId run, const std::vector<int>& signals, std::int64_t from, std::int64_t to,
                     const RowCallback& row) const {
  std::vector<double> values(signals.size());
  std::int64_t next = -1, every = 1;
  for (bool first = true;; first = false) {
    std::optional<RowSpan> span;
    {
      // One transaction a block: a slow caller must not keep the write-ahead log from being emptied.
      const auto database = state_->lease();
      Transaction transaction(*database, "BEGIN");
      const auto layout = read_layout(*database, run);
      if (!layout) throw LogError(LogError::Kind::missing, "There is no run " + std::to_string(run) + ".");
      every = layout->every;
      if (first) next = ceil_div(from, every);
      SampleSource source(*database, run, *layout, signals);
      span = source.next(next);
    }
    if (!span) return;
    for (std::size_t i = 0; i < span->t.size(); ++i) {
      const std::int64_t k = (span->first + static_cast<std::int64_t>(i)) * every;
      if (k > to) return;
      if (!present(*span, i)) continue;
      for (std::size_t s = 0; s < signals.size(); ++s) values[s] = span->values[s][i];
      if (!row(k, span->t[i], values)) return;
    }
    next = span->end();
  }
}

std::vector<GapRow> LogReader::gaps(RunId run) const {
  const auto database = state_->lease();
  std::vector<GapRow> gaps;
  fill_gaps(*database, run, 0, std::numeric_limits<std::int64_t>::max(), gaps);
  return gaps;
}

}  // namespace vigil
