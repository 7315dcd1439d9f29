#include "server/ingest/sampler.hpp"

#include <limits>
#include <utility>

namespace vigil {

Sampler::Sampler(const PushedColumns& columns, SamplerLimits limits)
    : columns_(columns),
      limits_(limits),
      value_(columns.names.size(), std::numeric_limits<double>::quiet_NaN()),
      since_(columns.names.size(), 0),
      seqs_(limits.seqs) {}

std::optional<double> Sampler::due() const {
  if (!start_ || over()) return std::nullopt;
  return *start_ + static_cast<double>(closed_ + 2) * limits_.dt;
}

bool Sampler::advance(double now) {
  for (auto end = due(); end && *end <= now; end = due()) {
    if (ready_.size() >= limits_.room) return false;
    close();
  }
  return true;
}

void Sampler::close() {
  const double begin = *start_ + static_cast<double>(closed_ + 1) * limits_.dt;
  std::vector<double> cells(value_.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (since_[c] + limits_.hold >= begin) cells[c] = value_[c];
  }
  ready_.push_back(std::move(cells));
  ++closed_;
}

Tally Sampler::take(const std::vector<IngestRow>& rows, double now) {
  Tally tally;
  for (const IngestRow& row : rows) {
    if (over()) {
      ++tally.beyond;
    } else if (row.seq && seqs_.known(row.memory(columns_), *row.seq)) {
      ++tally.duplicate;
    } else {
      if (row.seq) seqs_.remember(row.memory(columns_), *row.seq);
      if (!start_) start_ = now;
      for (const auto& [column, value] : row.values) {
        value_[static_cast<std::size_t>(column)] = value;
        since_[static_cast<std::size_t>(column)] = now;
      }
      ++tally.accepted;
    }
  }
  return tally;
}

std::vector<std::int64_t> Sampler::open() const {
  if (!start_ || over()) return {};
  return {closed_ + 1};
}

std::vector<double> Sampler::pop() {
  std::vector<double> cells = std::move(ready_.front());
  ready_.pop_front();
  return cells;
}

}  // namespace vigil
