#include "server/runs/manager.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/run/trace.hpp"
#include "server/runs/designs.hpp"
#include "server/runs/waiting_run.hpp"

namespace vigil {

RunManager::RunManager(LogWriter& log, const LogReader& reader, Hub& hub, ManagerOptions options)
    : log_(log),
      reader_(reader),
      hub_(hub),
      options_(std::move(options)),
      webhooks_(options_.webhooks, [this](RunId run, const Mark& note) { log_.mark(run, note); }),
      keeper_([this] { keep_house(); }),
      designer_(std::make_unique<Designer>(log, reader, options_.design, [this] { look_at_designs(); })) {}

RunManager::~RunManager() {
  stop();
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  keeper_.join();
}

/// Counts in whoever does something outside the lock that stop() must wait for; counts out with the last copy.
std::shared_ptr<void> RunManager::count_in() {
  return {nullptr, [this](void*) {
            const std::lock_guard lock(mutex_);
            --beginning_;
            changed_.notify_all();
          }};
}

CreatedRun RunManager::create(RunOrder order) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) throw RunRefusal(RunRefusal::Kind::full, "The server is stopping.");
    if (queue_.size() + waiting_.size() + static_cast<std::size_t>(beginning_) >= options_.max_queue) {
      throw RunRefusal(RunRefusal::Kind::full, "Too many runs wait already; try again when some have ended.");
    }
    ++beginning_;
  }
  const std::shared_ptr<void> leave = count_in();  // after the run is in the queue
  std::vector<DesignTask> open = open_tasks(order);
  std::erase_if(open, [&](const DesignTask& task) {
    Json record = designer_->known(task);
    if (record.is_null()) return false;
    order.designs[task.lane] = std::move(record);
    return true;
  });
  if (!open.empty()) return create_designing(std::move(order), std::move(open));
  Run run = make_run(order);
  const CreatedRun created = log_.create_run(make_record(order, run));
  if (!created.fresh) return created;
  for (const Command& command : order.commands) log_.command(created.id, command);
  begin(created.id, std::move(order), std::move(run));
  return created;
}

void RunManager::begin(RunId id, RunOrder order, Run run) {
  auto live = std::make_shared<LiveRun>(id, std::move(order), std::move(run), log_, hub_, webhooks_, options_.announcer,
                                        [this](RunId over) { ended(over); });
  const std::lock_guard lock(mutex_);
  runs_[id] = live;
  std::string end = stopping_ ? "interrupted" : "";
  if (const auto place = waiting_.find(id); place != waiting_.end()) {
    end = place->second->stop.value_or(end);
    waiting_.erase(place);
    changed_.notify_all();
  }
  if (!end.empty()) {
    live->stop(end);
  } else if (live->order().sleeps_unwatched) {
    live->start();
  } else {
    queue_.push_back(id);
    fill();
  }
}

void RunManager::fill() {
  const auto busy = [this] {
    return std::count_if(runs_.begin(), runs_.end(), [](const auto& item) {
      return item.second->started() && !item.second->order().sleeps_unwatched;
    });
  };
  while (!queue_.empty() && busy() < options_.max_runs) {
    const auto next = runs_.find(queue_.front());
    queue_.pop_front();
    if (next != runs_.end()) next->second->start();
  }
}

std::shared_ptr<LiveRun> RunManager::find(RunId id) const {
  const std::lock_guard lock(mutex_);
  const auto place = runs_.find(id);
  return place == runs_.end() ? nullptr : place->second;
}

std::vector<std::shared_ptr<LiveRun>> RunManager::fed(const std::string& name) const {
  std::vector<std::shared_ptr<LiveRun>> fed;
  const std::lock_guard lock(mutex_);
  for (const auto& [id, run] : runs_) {
    const auto& feed = run->order().feed;
    if (!feed) continue;
    const bool named = feed->plant() && (name.empty() || feed->plant()->name == name);
    if (named || std::to_string(id) == name) fed.push_back(run);
  }
  return fed;
}

void RunManager::remove(RunId id) {
  stop_designing(id, "stopped");
  if (const auto live = find(id)) {
    live->stop("stopped");
    if (!live->wait_ended(std::chrono::seconds(10))) {
      throw RunRefusal(RunRefusal::Kind::busy, "The run did not end in time; try again.");
    }
  }
  log_.delete_run(id);
  hub_.forget(id);
  Json note;
  note["id"] = std::to_string(id);
  note["state"] = "deleted";
  hub_.publish("run", note);
  if (options_.announcer != nullptr) options_.announcer->forget(id);
}

std::shared_ptr<const Trace> RunManager::trace(std::int64_t id) {
  const std::lock_guard lock(trace_mutex_);
  if (auto known = traces_[id].lock()) return known;
  const auto text = reader_.trace_csv(id);
  if (!text) {
    traces_.erase(id);
    return nullptr;
  }
  auto trace = std::make_shared<const Trace>(Trace::from_csv(*text));
  traces_[id] = trace;
  return trace;
}

RunManager::Counts RunManager::counts() const {
  const std::lock_guard lock(mutex_);
  Counts counts;
  counts.max = options_.max_runs;
  counts.designing = static_cast<int>(waiting_.size());
  for (const auto& [id, run] : runs_) ++(run->started() ? counts.running : counts.queued);
  return counts;
}

void RunManager::ended(RunId id) {
  {
    const std::lock_guard lock(mutex_);
    ended_.push_back(id);
  }
  changed_.notify_all();
}

void RunManager::keep_house() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return closed_ || !ended_.empty(); });
    if (ended_.empty()) return;
    const RunId id = ended_.front();
    const auto place = runs_.find(id);
    if (place == runs_.end()) {
      // It ended before create() had put it in: come back when it has.
      changed_.wait_for(lock, std::chrono::milliseconds(10));
      continue;
    }
    ended_.pop_front();
    const auto run = place->second;
    lock.unlock();
    run->join();
    lock.lock();
    runs_.erase(id);
    std::erase(queue_, id);
    if (!stopping_) fill();
    changed_.notify_all();
  }
}

void RunManager::stop() {
  std::vector<RunId> waiting;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    queue_.clear();
    for (const auto& [id, run] : runs_) run->stop(run->started() ? "stopped" : "interrupted");
    for (const auto& [id, run] : waiting_) waiting.push_back(id);
  }
  designer_->stop();
  for (const RunId id : waiting) stop_designing(id, "interrupted");
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return runs_.empty() && waiting_.empty() && beginning_ == 0; });
}

}  // namespace vigil
