#include "server/papers/threads.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "server/runs/campaign_runner.hpp"

namespace vigil {
namespace {

/// Calls work(0) … work(count - 1) on some threads and rethrows the first error.
void on_threads(int threads, int nice, std::int64_t count, const std::function<void(std::int64_t)>& work) {
  std::atomic<std::int64_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  {
    std::vector<std::jthread> crew;
    for (int i = 0; i < std::min<std::int64_t>(threads, count); ++i) {
      crew.emplace_back([&] {
        if (nice > 0) setpriority(PRIO_PROCESS, 0, nice);  // of the calling thread
        try {
          for (std::int64_t index = next++; index < count; index = next++) work(index);
        } catch (...) {
          const std::lock_guard lock(mutex);
          if (!error) error = std::current_exception();
          next = count;
        }
      });
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace

std::shared_ptr<const papers::Study> ThreadedLaboratory::campaign(const Scenario& scenario, std::int64_t runs) {
  const std::string key = std::to_string(runs) + scenario.document().dump();
  if (const auto known = studies_.find(key); known != studies_.end()) return known->second;
  CampaignPlan plan;
  plan.points.push_back({Json::object(), scenario, designs_of(scenario)});
  plan.runs = runs;
  plan.first_seed = options_.first_seed;
  plan.threads = options_.threads;
  plan.nice = options_.nice;
  auto study = std::make_shared<papers::Study>();
  const std::atomic<bool> never{false};
  const auto outcomes =
      run_campaign(plan, options_.stop ? *options_.stop : never, [&](std::int64_t /*index*/, const TrialResult& trial) {
        study->add(trial);
        advance(1);
      });
  check_stop();
  study->close(outcomes.front().metrics);
  return studies_[key] = std::move(study);
}

std::shared_ptr<const papers::Records> ThreadedLaboratory::samples(const Scenario& scenario,
                                                                   const std::vector<std::string>& signals,
                                                                   std::int64_t runs) {
  const std::int64_t count = std::min(runs, kMostRecords);
  std::string key = std::to_string(count) + scenario.document().dump();
  for (const std::string& signal : signals) key += " " + signal;
  if (const auto known = records_.find(key); known != records_.end()) return known->second;
  const Json designs = designs_of(scenario);
  std::vector<std::optional<papers::Record>> kept(static_cast<std::size_t>(count));
  on_threads(options_.threads, options_.nice, count, [&](std::int64_t index) {
    check_stop();
    const std::uint64_t seed = options_.first_seed + static_cast<std::uint64_t>(index);
    kept[static_cast<std::size_t>(index)] = papers::record_run(scenario, seed, signals, designs);
  });
  auto records = std::make_shared<papers::Records>();
  for (auto& record : kept) records->push_back(std::move(*record));
  advance(count);
  return records_[key] = std::move(records);
}

Json ThreadedLaboratory::designs_of(const Scenario& scenario) const {
  Json designs = Json::object();
  for (const DesignTask& task : design_tasks(scenario)) designs[task.lane] = options_.gains(task);
  return designs;
}

void ThreadedLaboratory::check_stop() const {
  if (options_.stop && *options_.stop) throw TrialGivenUp();
}

void ThreadedLaboratory::advance(std::int64_t runs) {
  done_ += runs;
  if (options_.progress) options_.progress(done_);
}

}  // namespace vigil
