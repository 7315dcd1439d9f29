#include "server/papers/manager.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "engine/core/describe.hpp"
#include "server/papers/kept.hpp"
#include "server/papers/report.hpp"
#include "server/papers/threads.hpp"
#include "server/runs/campaign_runner.hpp"
#include "server/runs/manager.hpp"
#include "server/runs/refusal.hpp"
#include "server/synthesis/designer.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr int kNice = 5;         // live runs and the page come first
constexpr auto kPatience = 30s;  // for runs that are under way to end
constexpr auto kSolverLook = 50ms;
constexpr std::int64_t kMostRestarts = 5;  // without an item done

constexpr const char* kJob = "papers/job";

std::string setting_of(const std::string& key) { return "papers/" + key; }

/// What is left of a job that was not over; empty where there is nothing, or nothing that can be read.
std::optional<PapersOrder> left_of(const Json& job) {
  if (!job.is_object() || job.value("state", "") != "running") return std::nullopt;
  const auto& keys = job.at("items");
  PapersOrder order;
  order.runs = job.at("runs").get<std::int64_t>();
  order.first_seed = job.at("seed").get<std::uint64_t>();
  for (std::size_t i = job.at("done").get<std::size_t>(); i < keys.size(); ++i) {
    for (const papers::Item& item : papers::items()) {
      if (keys[i] == item.key) order.items.push_back(&item);
    }
  }
  return order;
}

std::string now() {
  const auto time = std::chrono::system_clock::now().time_since_epoch();
  return to_rfc3339(std::chrono::duration_cast<std::chrono::nanoseconds>(time).count());
}

int all_threads() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

}  // namespace

PapersManager::PapersManager(LogWriter& log, const LogReader& reader, RunManager& runs)
    : log_(log), reader_(reader), runs_(runs) {
  for (const papers::Item& item : papers::items()) newest_[item.key] = papers::described(item, kept(item));
  job_ = reader_.setting(kJob);
}

PapersManager::~PapersManager() { stop(); }

void PapersManager::start(PapersOrder order) {
  const std::lock_guard lock(mutex_);
  if (stopping_) throw RunRefusal(RunRefusal::Kind::full, "The server is stopping.");
  if (running_)
    throw RunRefusal(RunRefusal::Kind::state, "Items of the papers are being run; wait for them, or cancel the job.");
  if (worker_.joinable()) worker_.join();  // it has ended but for its last line
  Json keys = Json::array();
  for (const papers::Item* item : order.items) keys.push_back(item->key);
  job_ = {{"state", "running"},       {"items", std::move(keys)}, {"done", 0},
          {"current", nullptr},       {"runs_made", 0},           {"runs", order.runs},
          {"seed", order.first_seed}, {"failed", Json::array()},  {"started", now()},
          {"ended", nullptr},         {"taken_up", nullptr}};
  begin(std::move(order));
}

void PapersManager::take_up() {
  const std::lock_guard lock(mutex_);
  if (stopping_ || running_) return;
  try {
    if (!count_restart()) return;
    std::optional<PapersOrder> order = left_of(job_);
    spdlog::info("the job of the papers goes on with {} items", order->items.size());
    begin(std::move(*order));
  } catch (const std::exception& error) {
    spdlog::warn("the job of the papers cannot be taken up: {}", error.what());
    job_ = nullptr;
  }
}

/// Under the lock; false where no job was left. An item under which the server ended again and again is left out.
bool PapersManager::count_restart() {
  const std::optional<PapersOrder> order = left_of(job_);
  if (!order) return false;
  Json& before = job_["taken_up"];
  const bool same = before.is_object() && before.at("done") == job_.at("done");
  const std::int64_t times = same ? before.at("times").get<std::int64_t>() + 1 : 1;
  if (times > kMostRestarts && !order->items.empty()) {
    job_["failed"].push_back(
        {{"key", order->items.front()->key}, {"error", "The server ended each time it was being run."}});
    job_["done"] = job_.at("done").get<std::int64_t>() + 1;
  }
  job_["taken_up"] = {{"when", now()}, {"done", job_.at("done")}, {"times", times > kMostRestarts ? 0 : times}};
  return true;
}

/// Under the lock.
void PapersManager::begin(PapersOrder order) {
  remember();
  running_ = true;
  stop_ = false;
  cancelled_ = false;
  worker_ = std::thread([this, order = std::move(order)] { work(order); });
}

/// Under the lock. A log that cannot be written keeps nobody from running items.
void PapersManager::remember() {
  try {
    log_.set_setting(kJob, job_);
  } catch (const std::exception& error) {
    spdlog::warn("the job of the papers is not in the log: {}", error.what());
  }
}

void PapersManager::cancel() {
  std::unique_lock lock(mutex_);
  if (!running_) return;
  stop_ = true;
  cancelled_ = true;
  changed_.notify_all();
  if (!changed_.wait_for(lock, kPatience, [this] { return !running_; }))
    throw RunRefusal(RunRefusal::Kind::busy, "The job's runs did not end in time; it ends with them.");
}

void PapersManager::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    stop_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

Json PapersManager::job() const {
  const std::lock_guard lock(mutex_);
  return job_;
}

Json PapersManager::items() const {
  const std::lock_guard lock(mutex_);
  Json list = Json::array();
  for (const papers::Item& item : papers::items()) list.push_back(newest_.at(item.key));
  return list;
}

Json PapersManager::item(const papers::Item& item) const { return papers::detailed(item, kept(item)); }

std::string PapersManager::report() const {
  std::vector<papers::Measured> measured;
  for (const papers::Item& item : papers::items()) {
    const Json whole = kept(item);
    if (whole.empty()) continue;
    measured.push_back({&item, papers::findings_of(whole),
                        "Vigil " + whole.at("version").get<std::string>() + ", from seed " + whole.at("seed").dump() +
                            ", " + whole.at("ended").get<std::string>()});
  }
  if (measured.empty()) return {};
  return papers::report_html(measured, "Vigil " + std::string(version()) + ", the newest result of each of " +
                                           std::to_string(measured.size()) + " items, " + now());
}

/// {} where it was never run.
Json PapersManager::kept(const papers::Item& item) const {
  Json whole = reader_.setting(setting_of(item.key));
  return whole.is_object() ? whole : Json::object();
}

void PapersManager::work(const PapersOrder& order) {
  const std::string state = carry_out(order);
  const std::lock_guard lock(mutex_);
  job_["current"] = nullptr;
  if (!stopping_ || cancelled_ || state == "finished") {
    job_["state"] = state;
    job_["ended"] = now();
    remember();
  }
  running_ = false;
  changed_.notify_all();
}

/// How it ended.
std::string PapersManager::carry_out(const PapersOrder& order) {
  LaboratoryOptions options;
  options.runs = order.runs;
  options.first_seed = order.first_seed;
  options.threads = all_threads();
  options.nice = kNice;
  options.stop = &stop_;
  options.gains = [this](const DesignTask& task) { return gains(task); };
  std::int64_t before = 0;  // of a job that is taken up
  {
    const std::lock_guard lock(mutex_);
    before = job_["runs_made"].get<std::int64_t>();
  }
  options.progress = [this, before](std::int64_t made) {
    const std::lock_guard lock(mutex_);
    job_["runs_made"] = before + made;
  };
  ThreadedLaboratory laboratory(options);
  for (const papers::Item* item : order.items) {
    at(item->key);
    try {
      if (stop_) return "cancelled";
      keep(*item, order, item->measure(laboratory));
    } catch (const TrialGivenUp&) {
      return "cancelled";
    } catch (const std::exception& error) {
      fail(item->key, error.what());
    }
    over();
  }
  return "finished";
}

void PapersManager::at(const std::string& key) {
  const std::lock_guard lock(mutex_);
  job_["current"] = key;
}

/// One item more: what a next start does not run again.
void PapersManager::over() {
  const std::lock_guard lock(mutex_);
  job_["done"] = job_["done"].get<std::int64_t>() + 1;
  remember();
}

void PapersManager::keep(const papers::Item& item, const PapersOrder& order, const papers::Findings& findings) {
  Json whole = papers::to_json(item, findings);
  whole["seed"] = order.first_seed;
  whole["version"] = std::string(version());
  whole["ended"] = now();
  log_.set_setting(setting_of(item.key), whole);
  const std::lock_guard lock(mutex_);
  newest_[item.key] = papers::described(item, whole);
}

void PapersManager::fail(const std::string& key, const std::string& error) {
  spdlog::warn("item {} of the papers: {}", key, error);
  const std::lock_guard lock(mutex_);
  job_["failed"].push_back({{"key", key}, {"error", error}});
}

/// The record of a task, whether it holds or not, as `vigil papers` takes it.
Json PapersManager::gains(const DesignTask& task) {
  Designer& designer = runs_.designer();
  if (Json record = designer.known(task); !record.is_null()) return record;
  designer.ask({task});
  for (;;) {
    const std::optional<DesignItem> item = designer.find(task.key);
    if (item && item->settled()) {
      if (!item->record.is_null()) return item->record;
      throw std::runtime_error("Gains of " + task.lane + ": " + item->reason);
    }
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, kSolverLook, [this] { return stop_.load(); })) throw TrialGivenUp();
  }
}

}  // namespace vigil
