#include "server/crew/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/run/campaign.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kMostInJob = 4096;
constexpr double kNewest = 0.3;  // weight of the newest job in what a trial takes

}  // namespace

std::int64_t TrialLedger::size(int threads) const {
  if (seconds_ <= 0) return 1;
  const auto wanted = static_cast<std::int64_t>(std::min(kJobSeconds / seconds_, static_cast<double>(kMostInJob)));
  const std::int64_t fair = (trials_ - next_) / (2 * std::max(threads, 1));
  const std::int64_t count = std::max<std::int64_t>(1, std::min(wanted, fair));
  const std::int64_t place = next_ % runs_, block = place % kTrialBlock;
  const bool short_of_block = block + count < kTrialBlock || place + count >= runs_;
  return short_of_block ? count : count - (block + count) % kTrialBlock;
}

bool TrialLedger::asked(const TrialJob& job) const {
  const auto place = under_way_.find(job.first);
  return place != under_way_.end() && place->second.count == job.count;
}

TrialJob TrialLedger::publish(TrialJob job) {
  under_way_[job.first] = job;
  return job;
}

bool TrialLedger::missing(const TrialJob& job) const {
  for (std::int64_t index = job.first; index < job.first + job.count; ++index) {
    if (missing(index)) return true;
  }
  return false;
}

std::optional<TrialJob> TrialLedger::next(int threads) {
  while (!again_.empty()) {
    const TrialJob job = again_.back();
    again_.pop_back();
    if (missing(job)) return publish(job);
  }
  const std::int64_t count = std::min(size(threads), trials_ - next_);
  const std::int64_t jobs = bytes_ > kHeavy ? kJobsAheadHeavy : kJobsAhead;
  const bool enough = next_ - merged_ >= jobs * std::max(threads, 1) * std::max<std::int64_t>(count, 1);
  if (count <= 0 || enough) return std::nullopt;
  const TrialJob job{next_, count, 1};
  next_ += count;
  return publish(job);
}

void TrialLedger::put(JobResult result) {
  if (!result.error.empty()) throw std::runtime_error(result.error);
  const TrialJob& job = result.job;
  if (!asked(job)) return;
  const double each = result.seconds / static_cast<double>(job.count);
  if (std::isfinite(each) && each > 0) seconds_ = seconds_ <= 0 ? each : (1 - kNewest) * seconds_ + kNewest * each;
  for (std::int64_t i = 0; i < job.count; ++i) {
    std::string& bytes = result.trials[static_cast<std::size_t>(i)];
    bytes_ += bytes.size();
    results_[job.first + i] = std::move(bytes);
  }
  std::erase_if(under_way_, [this](const auto& item) { return !missing(item.second); });
}

std::optional<std::pair<std::int64_t, std::string>> TrialLedger::take() {
  const auto place = results_.find(merged_);
  if (place == results_.end()) return std::nullopt;
  std::string bytes = std::move(place->second);
  results_.erase(place);
  bytes_ -= bytes.size();
  return std::pair(merged_++, std::move(bytes));
}

void TrialLedger::again() {
  for (auto place = under_way_.rbegin(); place != under_way_.rend(); ++place) {
    TrialJob job = place->second;
    ++job.attempt;
    again_.push_back(job);  // from the back: the first trials go first
  }
  under_way_.clear();
}

bool TrialLedger::exhausted(const TrialJob& job) {
  const auto place = under_way_.find(job.first);
  if (place == under_way_.end() || place->second != job) return false;  // of an earlier attempt
  if (job.count == 1) return missing(job.first);
  under_way_.erase(place);
  for (std::int64_t index = job.first + job.count - 1; index >= job.first; --index) {
    if (missing(index)) again_.push_back({index, 1, job.attempt + 1});
  }
  return false;
}

}  // namespace vigil
