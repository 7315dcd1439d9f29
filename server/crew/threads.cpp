#include "server/crew/threads.hpp"

#include <sys/resource.h>

#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

namespace vigil {
namespace {

/// Hands out trials and takes their results back in order. Its threads run at most a few trials ahead of the merge, so
/// that memory does not grow with the campaign.
class TrialQueue {
 public:
  TrialQueue(std::int64_t first, std::int64_t trials, int threads)
      : trials_(trials), ahead_(4 * threads), next_(first), merged_(first) {}

  std::optional<std::int64_t> next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || next_ >= trials_ || next_ < merged_ + ahead_; });
    if (closed_ || next_ >= trials_) return std::nullopt;
    return next_++;
  }
  void put(std::int64_t index, TrialResult result) {
    const std::lock_guard lock(mutex_);
    results_.emplace(index, std::move(result));
    changed_.notify_all();
  }
  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
    closed_ = true;
    changed_.notify_all();
  }
  /// The next result in order; rethrows a worker's error. Nothing when asked to stop.
  std::optional<TrialResult> take(const std::atomic<bool>& stop) {
    std::unique_lock lock(mutex_);
    while (!error_ && !stop && results_.find(merged_) == results_.end())
      changed_.wait_for(lock, std::chrono::milliseconds(100));
    if (error_) std::rethrow_exception(error_);
    const auto place = results_.find(merged_);
    if (stop || place == results_.end()) return std::nullopt;
    TrialResult result = std::move(place->second);
    results_.erase(place);
    ++merged_;
    changed_.notify_all();
    return result;
  }
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

 private:
  const std::int64_t trials_, ahead_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::int64_t, TrialResult> results_;
  std::int64_t next_, merged_;
  std::exception_ptr error_;
  bool closed_ = false;
};

/// Joins its threads whatever happens.
class Team {
 public:
  Team(const CampaignPlan& plan, TrialQueue& queue) : queue_(queue) {
    for (int i = 0; i < plan.threads; ++i) threads_.emplace_back([&plan, &queue] { work(plan, queue); });
  }
  ~Team() {
    queue_.close();
    for (std::thread& thread : threads_) thread.join();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

 private:
  static void work(const CampaignPlan& plan, TrialQueue& queue) {
    if (plan.nice > 0) setpriority(PRIO_PROCESS, 0, plan.nice);  // of the calling thread
    try {
      while (const auto index = queue.next()) {
        if (plan.trial) {
          queue.put(*index, plan.trial(*index));
          continue;
        }
        const CampaignPoint& point = plan.points[static_cast<std::size_t>(*index / plan.runs)];
        queue.put(*index, run_trial(point.scenario, plan.seed_of(*index), plan.trace, point.designs));
      }
    } catch (const TrialGivenUp&) {
      queue.close();
    } catch (...) {
      queue.fail(std::current_exception());
    }
  }
  TrialQueue& queue_;
  std::vector<std::thread> threads_;
};

}  // namespace

void ThreadCrew::run(const CampaignPlan& plan, const std::atomic<bool>& stop, const Take& take) {
  TrialQueue queue(plan.first, plan.trials(), plan.threads);
  const Team team(plan, queue);
  for (std::int64_t index = plan.first; index < plan.trials(); ++index) {
    const auto trial = queue.take(stop);
    if (!trial) return;
    take(index, *trial);
  }
}

}  // namespace vigil
