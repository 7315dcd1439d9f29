#include "server/synthesis/designer.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "db/reader.hpp"
#include "db/writer.hpp"
#include "engine/core/input_error.hpp"
#include "server/runs/refusal.hpp"

namespace vigil {
namespace {

std::string title_of(const DesignTask& task) { return "Vigil: gains of lane " + task.lane + ", problem " + task.key; }

}  // namespace

Designer::Designer(LogWriter& log, const LogReader& reader, DesignerOptions options, std::function<void()> settled)
    : log_(log), reader_(reader), options_(std::move(options)), settled_(std::move(settled)), worker_([this] {
        work();
      }) {}

Designer::~Designer() { stop(); }

void Designer::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const auto& [key, entry] : entries_) {
      if (entry->solver) entry->solver->cancel();
    }
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

Json Designer::known(const DesignTask& task) const {
  Json record;
  {
    const std::lock_guard lock(mutex_);
    if (const auto place = entries_.find(task.key); place != entries_.end()) record = place->second->item.record;
  }
  if (record.is_null()) {
    const auto row = reader_.design(task.key);
    if (row) record = row->record;
  }
  if (record.is_null()) return record;
  try {
    check_design(task, record);
  } catch (const InputError&) {
    return {};  // refused, or of another version
  }
  return record;
}

/// What is known, or what the log says is refused for good.
std::optional<DesignItem> Designer::answer(const DesignTask& task) const {
  const DesignItem blank{.lane = task.lane, .key = task.key, .limit = options_.limit};
  if (Json record = known(task); !record.is_null()) return settle(blank, std::move(record));
  const auto row = reader_.design(task.key);
  if (!row) return std::nullopt;
  DesignItem item = settle(blank, row->record);
  const bool refused = item.state == DesignItem::State::refused && !may_be_tried_again(item);
  return refused ? std::optional(std::move(item)) : std::nullopt;
}

std::vector<DesignItem> Designer::ask(const std::vector<DesignTask>& tasks, std::optional<Holder> holder) {
  std::map<std::string, DesignItem> answered;
  for (const DesignTask& task : tasks) {
    if (auto item = answer(task)) answered[task.key] = std::move(*item);
  }
  std::vector<DesignItem> items;
  const std::lock_guard lock(mutex_);
  if (stopping_) throw RunRefusal(RunRefusal::Kind::full, "The server is stopping.");
  if (queue_.size() + tasks.size() > options_.max_waiting + answered.size()) {
    throw RunRefusal(RunRefusal::Kind::full, "Too many designs wait already; try again when some are done.");
  }
  for (const DesignTask& task : tasks) {
    if (const auto place = answered.find(task.key); place != answered.end()) {
      items.push_back(place->second);
    } else {
      const Shared entry = entry_of(task);
      if (holder) entry->holders.insert(*holder);
      entry->kept = entry->kept || entry->holders.empty();
      items.push_back(now(*entry));
    }
    items.back().lane = task.lane;
  }
  changed_.notify_all();
  return items;
}

/// The one that is there, or a new one at the end of the queue. mutex_ is held.
Designer::Shared Designer::entry_of(const DesignTask& task) {
  Shared& entry = entries_[task.key];
  if (entry && !may_be_tried_again(entry->item)) return entry;
  if (!entry) {
    entry = std::make_shared<Entry>();
    entry->task = task;
  }
  std::erase(old_, entry);
  entry->item = {.lane = task.lane, .key = task.key, .limit = options_.limit};
  queue_.push_back(entry);
  return entry;
}

void Designer::release(Holder holder) {
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [&](const auto& item) {
    const Shared& entry = item.second;
    if (entry->holders.erase(holder) == 0 || entry->wanted() || entry->item.settled()) return false;
    std::erase(queue_, entry);
    if (entry->solver) entry->solver->cancel();
    return true;
  });
  forget_old();
}

DesignItem Designer::now(const Entry& entry) {
  DesignItem item = entry.item;
  if (item.state == DesignItem::State::solving) {
    item.seconds = std::chrono::duration<double>(Clock::now() - entry.begin).count();
  }
  return item;
}

std::optional<DesignItem> Designer::find(const std::string& key) const {
  {
    const std::lock_guard lock(mutex_);
    if (const auto place = entries_.find(key); place != entries_.end()) return now(*place->second);
  }
  const auto row = reader_.design(key);
  if (!row) return std::nullopt;
  return settle({.lane = row->lane, .key = key, .limit = options_.limit}, row->record);
}

std::optional<std::string> Designer::sdpa(const std::string& key) const {
  Shared entry;
  {
    const std::lock_guard lock(mutex_);
    if (const auto place = entries_.find(key); place != entries_.end()) entry = place->second;
  }
  if (entry) return to_sdpa(entry->task.problem(), title_of(entry->task));
  return reader_.design_problem(key);
}

void Designer::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
    if (stopping_) return;
    const Shared entry = queue_.front();
    queue_.pop_front();
    solve(entry, lock);
  }
}

void Designer::solve(const Shared& entry, std::unique_lock<std::mutex>& lock) {
  entry->item.state = DesignItem::State::solving;
  entry->begin = Clock::now();
  const auto solver = entry->solver = std::make_shared<ChildSolver>(options_.executable);
  const DesignItem asked = entry->item;
  lock.unlock();
  DesignItem item = asked;
  Json record;
  try {
    record = entry->task.solve(*solver, options_.limit);
  } catch (const std::exception& error) {
    item.reason = error.what();  // memory, say
  }
  item.seconds = std::chrono::duration<double>(Clock::now() - entry->begin).count();
  item = settle(std::move(item), std::move(record));
  lock.lock();
  entry->solver.reset();
  const auto place = entries_.find(asked.key);
  if (stopping_ || place == entries_.end() || place->second != entry) return;
  entry->item = item;
  old_.push_back(entry);
  forget_old();
  lock.unlock();
  store(entry->task, item);
  if (settled_) settled_();
  lock.lock();
}

void Designer::store(const DesignTask& task, const DesignItem& item) noexcept {
  try {
    if (may_be_tried_again(item)) return;
    log_.put_design(item.key, item.lane, item.record, to_sdpa(task.problem(), title_of(task)));
  } catch (const std::exception& failure) {
    spdlog::warn("gains of problem {} were not stored: {}", item.key, failure.what());
  }
}

/// mutex_ is held.
void Designer::forget_old() {
  for (std::size_t i = 0; i < old_.size() && old_.size() > options_.max_settled;) {
    const Shared entry = old_[i];
    if (entry->holders.empty()) {
      entries_.erase(entry->item.key);
      old_.erase(old_.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

}  // namespace vigil
