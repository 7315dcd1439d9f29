#include "server/runs/campaign_runner.hpp"

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
  TrialQueue(std::int64_t trials, int threads) : trials_(trials), ahead_(4 * threads) {}

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
  std::int64_t next_ = 0, merged_ = 0;
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
    try {
      while (const auto index = queue.next()) {
        const CampaignPoint& point = plan.points[static_cast<std::size_t>(*index / plan.runs)];
        const auto seed = plan.first_seed + static_cast<std::uint64_t>(*index % plan.runs);
        queue.put(*index, run_trial(point.scenario, seed, plan.trace, point.designs));
      }
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

void merge(CampaignOutcome& outcome, const TrialResult& trial) {
  if (outcome.design.is_null()) outcome.design = trial.design;
  for (const FaultCount& fault : trial.faults) add_fault(outcome.faults, fault);
  for (const std::string& warning : trial.warnings) {
    const auto& known = outcome.warnings;
    if (std::find(known.begin(), known.end(), warning) == known.end()) outcome.warnings.push_back(warning);
  }
  outcome.ticks += trial.ticks;
}

}  // namespace

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

std::vector<CampaignOutcome> run_campaign(const CampaignPlan& plan, const std::atomic<bool>& stop,
                                          const std::function<void(std::int64_t, const TrialResult&)>& each) {
  TrialQueue queue(plan.trials(), plan.threads);
  std::vector<CampaignOutcome> outcomes;
  const Workers workers(plan, queue);
  for (std::size_t point = 0; point < plan.points.size() && !stop; ++point) {
    CampaignOutcome outcome;
    outcome.sweep = plan.points[point].sweep;
    CampaignTable table;
    for (std::int64_t i = 0; i < plan.runs; ++i) {
      const auto trial = queue.take(stop);
      if (!trial) break;
      table.add(*trial);
      merge(outcome, *trial);
      if (each) each(static_cast<std::int64_t>(point) * plan.runs + i, *trial);
    }
    outcome.metrics = table.summary();
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

Json campaign_metrics_json(const std::vector<CampaignOutcome>& outcomes) {
  Json list = Json::array();
  for (const CampaignOutcome& outcome : outcomes) {
    for (const MetricSummary& metric : outcome.metrics) {
      list.push_back(to_json(metric));
      list.back()["sweep"] = outcome.sweep;
    }
  }
  return list;
}

Json campaign_faults_json(const std::vector<CampaignOutcome>& outcomes) {
  Json list = Json::array();
  for (const CampaignOutcome& outcome : outcomes) {
    for (const CampaignFault& fault : outcome.faults) {
      list.push_back(to_json(fault.fault));
      list.back()["runs"] = fault.runs;
      list.back()["sweep"] = outcome.sweep;
    }
  }
  return list;
}

Json campaign_design_json(const std::vector<CampaignOutcome>& outcomes) {
  if (outcomes.size() == 1) return outcomes.front().design;
  Json list = Json::array();
  for (const CampaignOutcome& outcome : outcomes)
    list.push_back({{"sweep", outcome.sweep}, {"design", outcome.design}});
  return list;
}

Json campaign_warnings_json(const std::vector<CampaignOutcome>& outcomes) {
  std::vector<std::string> all;
  for (const CampaignOutcome& outcome : outcomes) {
    for (const std::string& warning : outcome.warnings) {
      if (std::find(all.begin(), all.end(), warning) == all.end()) all.push_back(warning);
    }
  }
  return all;
}

}  // namespace vigil
