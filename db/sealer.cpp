#include "db/sealer.hpp"

#include <algorithm>
#include <cmath>

#include "db/chunk.hpp"
#include "db/schema.hpp"
#include "engine/core/missing.hpp"

namespace vigil {

Sealer::Sealer(RunId run, std::vector<int> signals, std::int64_t every, double dt)
    : run_(run),
      signals_(std::move(signals)),
      every_(every),
      dt_(dt),
      cells_((signals_.size() + 1) * kBlockRows, kMissing) {
  for (auto& level : coarse_) level.resize(signals_.size());
}

void Sealer::add(const RowBatch& rows, std::vector<SealedBlock>& sealed) {
  const std::size_t stride = signals_.size() + 1;
  for (std::size_t i = 0; i < rows.k.size(); ++i) add_row(rows.k[i], rows.cells.data() + i * stride, sealed);
}

void Sealer::add_row(std::int64_t k, const double* cells, std::vector<SealedBlock>& sealed) {
  const std::int64_t row = k / every_;
  if (row / kBlockRows != block_) {
    seal(sealed);
    block_ = row / kBlockRows;
  }
  const int place = static_cast<int>(row % kBlockRows);
  if (end_ == 0) begin_ = saved_ = end_ = place;
  for (std::size_t c = 0; end_ < place && c <= signals_.size(); ++c) {
    const auto column = cells_.begin() + static_cast<std::ptrdiff_t>(c * kBlockRows);
    std::fill(column + end_, column + place, kMissing);
  }
  end_ = place + 1;
  newest_ = k;
  for (std::size_t c = 0; c <= signals_.size(); ++c)
    cells_[c * kBlockRows + static_cast<std::size_t>(place)] = cells[c];
  if (end_ == kBlockRows) seal(sealed);
}

bool Sealer::regular_time(std::int64_t begin, std::int64_t end) const {
  for (std::int64_t i = begin; i < end; ++i) {
    const auto k = static_cast<double>((block_ * kBlockRows + i) * every_);
    if (cells_[static_cast<std::size_t>(i)] != k * dt_) return false;
  }
  return true;
}

void Sealer::seal(std::vector<SealedBlock>& sealed) {
  if (end_ == 0) return;
  SealedBlock& block = sealed.emplace_back();
  block.run = run_;
  block.block = block_;
  block.first = block_ * kBlockRows + begin_;
  block.n = end_ - begin_;
  block.last_k = newest_;
  const auto column = [&](std::size_t c) {
    return std::span<const double>(cells_).subspan(c * kBlockRows + static_cast<std::size_t>(begin_),
                                                   static_cast<std::size_t>(block.n));
  };
  block.chunks.reserve(signals_.size() + 1);
  if (!regular_time(begin_, end_)) block.chunks.emplace_back(kTimeSignal, encode_chunk(column(0)));
  const auto times = column(0);
  const auto lost = std::count_if(times.begin(), times.end(), [](double t) { return std::isnan(t); });
  for (int level = 0; level < 2; ++level) {
    const std::int64_t bucket = block_ * kBlockRows / kRollupRows[static_cast<std::size_t>(level) + 1];
    if (bucket_[static_cast<std::size_t>(level)] != bucket) emit(level, block);
    bucket_[static_cast<std::size_t>(level)] = bucket;
  }
  for (std::size_t slot = 0; slot < signals_.size(); ++slot) {
    const auto values = column(slot + 1);
    block.chunks.emplace_back(signals_[slot], encode_chunk(values));
    Summary summary;
    for (const double value : values) summary.add(value);
    summary.nan -= lost;
    roll(slot, summary, block);
  }
  for (int level = 0; level < 2; ++level) {
    if ((block_ + 1) * kBlockRows % kRollupRows[static_cast<std::size_t>(level) + 1] == 0) emit(level, block);
  }
  begin_ = end_ = saved_ = 0;
}

void Sealer::roll(std::size_t slot, const Summary& summary, SealedBlock& block) {
  block.rollups.push_back({signals_[slot], 0, block_, summary});
  for (auto& level : coarse_) level[slot].merge(summary);
}

void Sealer::emit(int level, SealedBlock& block) {
  auto& bucket = bucket_[static_cast<std::size_t>(level)];
  if (bucket < 0) return;
  auto& summaries = coarse_[static_cast<std::size_t>(level)];
  for (std::size_t slot = 0; slot < signals_.size(); ++slot) {
    block.rollups.push_back({signals_[slot], level + 1, bucket, summaries[slot]});
    summaries[slot] = Summary();
  }
  bucket = -1;
}

void Sealer::save_tail(std::vector<TailRow>& tail) {
  for (int place = saved_; place < end_; ++place) {
    const auto at = static_cast<std::size_t>(place);
    if (std::isnan(cells_[at])) continue;
    TailRow& row = tail.emplace_back();
    row.run = run_;
    row.k = (block_ * kBlockRows + place) * every_;
    row.v.resize(signals_.size() + 1);
    for (std::size_t c = 0; c < row.v.size(); ++c) row.v[c] = cells_[c * kBlockRows + at];
  }
  saved_ = end_;
}

}  // namespace vigil
