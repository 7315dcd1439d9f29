#include "server/runs/campaign_runner.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "engine/core/input_error.hpp"

namespace vigil {
namespace {

/// Hands out trials and takes their results back in order. Workers run at most a few trials ahead of the merge, so that
/// memory does not grow with the campaign.
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
class Workers {
 public:
  Workers(const CampaignPlan& plan, TrialQueue& queue) : queue_(queue) {
    for (int i = 0; i < plan.threads; ++i) threads_.emplace_back([&plan, &queue] { work(plan, queue); });
  }
  ~Workers() {
    queue_.close();
    for (std::thread& thread : threads_) thread.join();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

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
        const auto seed = plan.first_seed + static_cast<std::uint64_t>(*index % plan.runs);
        queue.put(*index, run_trial(point.scenario, seed, plan.trace, point.designs));
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

void add_fault(std::vector<CampaignFault>& sums, const FaultCount& fault) {
  for (CampaignFault& sum : sums) {
    if (sum.fault.lane != fault.lane || sum.fault.node != fault.node || sum.fault.code != fault.code) continue;
    sum.fault.first = std::min(sum.fault.first, fault.first);
    sum.fault.last = std::max(sum.fault.last, fault.last);
    sum.fault.count += fault.count;
    sum.fault.stopped = sum.fault.stopped || fault.stopped;
    ++sum.runs;
    return;
  }
  sums.push_back({fault, 1});
}

template <class Rows>
Json list_json(const Rows& rows) {
  Json list = Json::array();
  for (const auto& row : rows) list.push_back(to_json(row));
  return list;
}

}  // namespace

const char* trial_state(const TrialResult& trial) {
  if (!trial.error.empty()) return "failed";
  const bool stopped =
      std::any_of(trial.faults.begin(), trial.faults.end(), [](const FaultCount& fault) { return fault.stopped; });
  return stopped ? "stopped" : "finished";
}

TrialResult failed_trial(const CampaignPlan& plan, std::int64_t index, const std::string& error) {
  TrialResult failed;
  failed.seed = plan.first_seed + static_cast<std::uint64_t>(index % plan.runs);
  failed.error = error;
  return failed;
}

void CampaignCell::add(const TrialResult& trial) {
  table_.add(trial);
  const std::string_view state = trial_state(trial);
  ++(state == "failed" ? failed_ : state == "stopped" ? stopped_ : finished_);
  if (sums_.design.is_null()) sums_.design = trial.design;
  for (const FaultCount& fault : trial.faults) add_fault(sums_.faults, fault);
  for (const std::string& warning : trial.warnings) {
    const auto& known = sums_.warnings;
    if (std::find(known.begin(), known.end(), warning) == known.end()) sums_.warnings.push_back(warning);
  }
  sums_.ticks += trial.ticks;
}

CampaignOutcome CampaignCell::outcome(Json sweep) const {
  CampaignOutcome outcome = sums_;
  outcome.sweep = std::move(sweep);
  outcome.metrics = table_.summary();
  return outcome;
}

Json CampaignCell::result() const {
  Json faults = Json::array();
  for (const CampaignFault& fault : sums_.faults) {
    faults.push_back(to_json(fault.fault));
    faults.back()["runs"] = fault.runs;
  }
  return {{"trials", {{"finished", finished_}, {"stopped", stopped_}, {"failed", failed_}}},
          {"ticks", sums_.ticks},
          {"metrics", list_json(table_.summary())},
          {"paired", list_json(table_.paired())},
          {"detection", list_json(table_.detection())},
          {"faults", std::move(faults)},
          {"warnings", sums_.warnings},
          {"design", sums_.design}};
}

std::vector<CampaignPoint> make_grid(const Scenario& base,
                                     const std::vector<std::pair<std::string, std::vector<Json>>>& sweeps) {
  std::vector<CampaignPoint> points{{Json::object(), base, Json::object()}};
  for (const auto& [path, values] : sweeps) {
    std::vector<CampaignPoint> wider;
    for (const CampaignPoint& point : points) {
      for (const Json& value : values) {
        CampaignPoint next{point.sweep, point.scenario.with(path, value), point.designs};
        next.sweep[path] = value;
        wider.push_back(std::move(next));
      }
    }
    points = std::move(wider);
  }
  return points;
}

void run_trials(const CampaignPlan& plan, const std::atomic<bool>& stop,
                const std::function<void(std::int64_t, const TrialResult&)>& each) {
  TrialQueue queue(plan.first, plan.trials(), plan.threads);
  const Workers workers(plan, queue);
  for (std::int64_t index = plan.first; index < plan.trials(); ++index) {
    const auto trial = queue.take(stop);
    if (!trial) return;
    each(index, *trial);
  }
}

std::vector<CampaignOutcome> run_campaign(const CampaignPlan& plan, const std::atomic<bool>& stop,
                                          const std::function<void(std::int64_t, const TrialResult&)>& each) {
  std::vector<CampaignOutcome> outcomes;
  CampaignCell cell;
  const auto close = [&] {
    outcomes.push_back(cell.outcome(plan.points[outcomes.size()].sweep));
    cell = {};
  };
  run_trials(plan, stop, [&](std::int64_t index, const TrialResult& trial) {
    cell.add(trial);
    if (each) each(index, trial);
    if ((index + 1) % plan.runs == 0) close();
  });
  if (cell.trials() > 0) close();
  return outcomes;
}

}  // namespace vigil
