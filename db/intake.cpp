#include "db/intake.hpp"

#include <algorithm>
#include <utility>

namespace vigil {

namespace {
constexpr std::size_t kBatchBytes = 256u << 10;
constexpr std::size_t kBatchRows = 512;
constexpr std::size_t kSpareBatches = 8;
}  // namespace

Intake::Intake(LogSelection selection, LogPolicy policy, std::size_t budget)
    : selection_(std::move(selection)),
      row_bytes_((selection_.signals.size() + 2) * sizeof(double)),
      batch_rows_(std::clamp<std::size_t>(kBatchBytes / row_bytes_, 8, kBatchRows)),
      budget_(std::max(budget, 2 * batch_rows_ * row_bytes_)),
      policy_(policy) {
  for (std::size_t i = 0; i < selection_.signals.size(); ++i) {
    whole_ = whole_ && selection_.signals[i] == static_cast<int>(i);
  }
}

RowBatch& Intake::open_batch() {
  if (full_.empty() || full_.back().k.size() >= batch_rows_) {
    if (spare_.empty()) {
      full_.emplace_back();
      full_.back().k.reserve(batch_rows_);
      full_.back().cells.reserve(batch_rows_ * (selection_.signals.size() + 1));
    } else {
      full_.push_back(std::move(spare_.back()));
      spare_.pop_back();
    }
  }
  return full_.back();
}

void Intake::append(const Frame& frame) {
  RowBatch& batch = open_batch();
  batch.k.push_back(frame.k);
  batch.cells.push_back(frame.t);
  const std::size_t width = selection_.signals.size();
  if (whole_ && frame.values.size() >= width) {
    batch.cells.insert(batch.cells.end(), frame.values.begin(),
                       frame.values.begin() + static_cast<std::ptrdiff_t>(width));
    return;
  }
  for (const int id : selection_.signals) {
    const auto index = static_cast<std::size_t>(id);
    batch.cells.push_back(index < frame.values.size() ? frame.values[index] : std::numeric_limits<double>::quiet_NaN());
  }
}

void Intake::drop(std::int64_t k) {
  if (!dropping_) gap_.from = k;
  dropping_ = true;
  gap_.to = k;
  ++dropped_;
}

bool Intake::push(const Frame& frame) {
  if (frame.k % selection_.every != 0) return false;
  std::unique_lock lock(mutex_);
  if (closed_ || frame.k <= newest_) return false;
  if (bytes_ + row_bytes_ > budget_) {
    room_.wait(lock, [&] { return closed_ || policy_ == LogPolicy::live || bytes_ + row_bytes_ <= budget_; });
    if (closed_) return false;
    if (bytes_ + row_bytes_ > budget_) {
      newest_ = frame.k;
      drop(frame.k);
      return false;
    }
  }
  newest_ = frame.k;
  if (std::exchange(dropping_, false)) gaps_.push_back(gap_);
  append(frame);
  bytes_ += row_bytes_;
  const bool was = queued_ >= batch_rows_ * row_bytes_;
  queued_ += row_bytes_;
  return !was && queued_ >= batch_rows_ * row_bytes_;
}

void Intake::set_policy(LogPolicy policy) {
  const std::scoped_lock lock(mutex_);
  policy_ = policy;
  room_.notify_all();
}

void Intake::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  room_.notify_all();
}

Intake::Taken Intake::take(std::size_t most) {
  const std::scoped_lock lock(mutex_);
  Taken taken;
  std::size_t count = 0;
  for (; count < full_.size() && (count == 0 || taken.bytes < most); ++count)
    taken.bytes += full_[count].k.size() * row_bytes_;
  const auto end = full_.begin() + static_cast<std::ptrdiff_t>(count);
  taken.rows.assign(std::make_move_iterator(full_.begin()), std::make_move_iterator(end));
  full_.erase(full_.begin(), end);
  queued_ -= taken.bytes;
  taken.left = !full_.empty();
  taken.gaps = std::exchange(gaps_, {});
  if (closed_ && std::exchange(dropping_, false)) taken.gaps.push_back(gap_);
  return taken;
}

void Intake::release(std::size_t bytes, std::vector<RowBatch> used) {
  const std::scoped_lock lock(mutex_);
  bytes_ -= bytes;
  for (auto& batch : used) {
    if (spare_.size() >= kSpareBatches) break;
    batch.k.clear();
    batch.cells.clear();
    spare_.push_back(std::move(batch));
  }
  room_.notify_all();
}

std::size_t Intake::queued_bytes() const {
  const std::scoped_lock lock(mutex_);
  return bytes_;
}

std::int64_t Intake::dropped() const {
  const std::scoped_lock lock(mutex_);
  return dropped_;
}

}  // namespace vigil
