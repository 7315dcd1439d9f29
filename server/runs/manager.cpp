#include "server/runs/manager.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/run/trace.hpp"

namespace vigil {

RunManager::RunManager(LogWriter& log, const LogReader& reader, Hub& hub, ManagerOptions options)
    : log_(log), reader_(reader), hub_(hub), options_(options), keeper_([this] { keep_house(); }) {}

RunManager::~RunManager() {
  stop();
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  keeper_.join();
}

CreatedRun RunManager::create(RunOrder order) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) throw RunRefusal(RunRefusal::Kind::full, "The server is stopping.");
    if (queue_.size() + static_cast<std::size_t>(beginning_) >= options_.max_queue) {
      throw RunRefusal(RunRefusal::Kind::full, "Too many runs wait already; try again when some have ended.");
    }
    ++beginning_;
  }
  // Counts down whatever happens, after the run is in the queue.
  const std::shared_ptr<void> leave(nullptr, [this](void*) {
    const std::lock_guard lock(mutex_);
    --beginning_;
    changed_.notify_all();
  });
  Run run = make_run(order);
  const CreatedRun created = log_.create_run(make_record(order, run));
  if (!created.fresh) return created;
  for (const Command& command : order.commands) log_.command(created.id, command);
  auto live = std::make_shared<LiveRun>(created.id, std::move(order), std::move(run), log_, hub_,
                                        [this](RunId id) { ended(id); });
  const std::lock_guard lock(mutex_);
  runs_[created.id] = live;
  if (stopping_) {
    live->stop("interrupted");
  } else if (live->order().sleeps_unwatched) {
    live->start();
  } else {
    queue_.push_back(created.id);
    fill();
  }
  return created;
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

void RunManager::remove(RunId id) {
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
  std::unique_lock lock(mutex_);
  stopping_ = true;
  queue_.clear();
  for (const auto& [id, run] : runs_) run->stop(run->started() ? "stopped" : "interrupted");
  changed_.wait(lock, [this] { return runs_.empty() && beginning_ == 0; });
}

}  // namespace vigil
