// Runs that wait for their gains.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "server/runs/designs.hpp"
#include "server/runs/waiting_run.hpp"

namespace vigil {
namespace {

constexpr auto kSolverEnds = std::chrono::seconds(10);

WallTime wall_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

Mark state_mark(const std::string& state, const std::string& detail = {}) {
  Mark mark;
  mark.type = MarkType::state;
  mark.code = state;
  mark.detail = detail;
  return mark;
}

}  // namespace

CreatedRun RunManager::create_designing(RunOrder order, std::vector<DesignTask> tasks) {
  const auto waiting = std::make_shared<Waiting>();
  {
    const std::lock_guard lock(mutex_);
    waiting->holder = ++last_holder_;
  }
  designer_->ask(tasks, waiting->holder);
  RunRecord record = make_record(order);
  record.state = "designing";
  CreatedRun created;
  try {
    created = log_.create_run(record);
    if (created.fresh) {
      for (const Command& command : order.commands) log_.command(created.id, command);
    }
  } catch (...) {
    designer_->release(waiting->holder);
    throw;
  }
  if (!created.fresh) {
    designer_->release(waiting->holder);
    return created;
  }
  waiting->order = std::move(order);
  waiting->tasks = std::move(tasks);
  log_.mark(created.id, state_mark("designing"));
  announce(created.id, waiting->order, "designing");
  bool late = false;
  {
    const std::lock_guard lock(mutex_);
    waiting_[created.id] = waiting;
    late = stopping_;
  }
  if (late) {
    stop_designing(created.id, "interrupted");
  } else {
    look_at_designs();  // all of them may have been found meanwhile
  }
  return created;
}

void RunManager::look_at_designs() {
  std::vector<std::pair<RunId, WaitingPointer>> ready;
  std::vector<std::shared_ptr<void>> leave;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, waiting] : waiting_) {
      const auto settled = [this](const DesignTask& task) {
        const auto item = designer_->find(task.key);
        return !item || item->settled();
      };
      if (waiting->going_on || !std::all_of(waiting->tasks.begin(), waiting->tasks.end(), settled)) continue;
      waiting->going_on = true;
      ++beginning_;
      leave.push_back(count_in());
      ready.emplace_back(id, waiting);
    }
  }
  for (const auto& [id, waiting] : ready) go_on(id, waiting);
}

void RunManager::go_on(RunId id, const WaitingPointer& waiting) {
  std::string error;
  try {
    Run run = make_waiting(*waiting);
    RunUpdate update;
    update.state = "queued";
    update.dt = run.dt();
    update.steps = run.steps();
    update.designs = waiting->order.designs;
    log_.update(id, update);
    announce(id, waiting->order, "queued");
    begin(id, waiting->order, std::move(run));
    designer_->release(waiting->holder);
    return;
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  std::string state = "failed";
  {
    const std::lock_guard lock(mutex_);
    if (waiting->stop) {
      state = *waiting->stop;
      error.clear();
    }
  }
  end_waiting(id, *waiting, state, error);
  const std::lock_guard lock(mutex_);
  waiting_.erase(id);
  changed_.notify_all();
}

/// Throws InputError with the sentence that the run ends with, where it cannot be made.
Run RunManager::make_waiting(Waiting& waiting) {
  for (const DesignTask& task : waiting.tasks) {
    const auto item = designer_->find(task.key);
    if (!item) throw std::runtime_error("The design of lane " + task.lane + " was given up.");
    require_gains(task, *item);
    waiting.order.designs[task.lane] = item->record;
  }
  return make_run(waiting.order);
}

bool RunManager::stop_designing(RunId id, const std::string& state) {
  WaitingPointer waiting;
  std::shared_ptr<void> leave;
  {
    std::unique_lock lock(mutex_);
    const auto place = waiting_.find(id);
    if (place == waiting_.end()) return false;
    if (place->second->going_on) {
      if (!place->second->stop) place->second->stop = state;
      changed_.wait_for(lock, kSolverEnds, [&] { return !waiting_.contains(id); });
      return true;
    }
    waiting = place->second;
    waiting_.erase(place);
    ++beginning_;
    leave = count_in();
  }
  end_waiting(id, *waiting, state, "");
  return true;
}

std::vector<DesignItem> RunManager::designing(RunId id) const {
  WaitingPointer waiting;
  {
    const std::lock_guard lock(mutex_);
    if (const auto place = waiting_.find(id); place != waiting_.end()) waiting = place->second;
  }
  std::vector<DesignItem> items;
  if (!waiting) return items;
  for (const DesignTask& task : waiting->tasks) {
    auto item = designer_->find(task.key);
    if (!item) continue;
    item->lane = task.lane;
    items.push_back(std::move(*item));
  }
  return items;
}

void RunManager::end_waiting(RunId id, const Waiting& waiting, const std::string& state, const std::string& error) {
  designer_->release(waiting.holder);
  RunUpdate update;
  update.state = state;
  update.ended = wall_now();
  update.error = error;
  log_.mark(id, state_mark(state, error));
  try {
    log_.finish(id, update);
  } catch (const LogError& failure) {
    spdlog::warn("run {}: {}", id, failure.what());
  }
  announce(id, waiting.order, state);
}

void RunManager::announce(RunId id, const RunOrder& order, const std::string& state) {
  const Json& steps = order.scenario.document().at("time").at("steps");
  const Json note{{"id", std::to_string(id)}, {"scenario", order.scenario.id()}, {"state", state}, {"k", -1}, {"t", 0},
                  {"steps", steps},           {"ticks_per_second", nullptr}};
  hub_.publish("run", note);
  if (options_.announcer != nullptr) options_.announcer->state(id, note, {});
}

}  // namespace vigil
