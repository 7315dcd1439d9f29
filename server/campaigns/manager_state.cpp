// What a campaign is asked from outside: pause, go on, end, be gone.
#include <spdlog/spdlog.h>

#include <algorithm>

#include "server/campaigns/manager.hpp"
#include "server/runs/refusal.hpp"

namespace vigil {
namespace {

constexpr auto kPatience = std::chrono::seconds(10);  // for trials that are under way to end

}  // namespace

std::string CampaignManager::state_of(std::int64_t id) const {
  if (const auto end = unlogged(id)) return end->state;
  const auto row = reader_.campaign(id);
  if (!row) throw LogError(LogError::Kind::missing, "There is no campaign " + std::to_string(id) + ".");
  return row->state;
}

/// True where it ran and has ended now in that state, or by itself. Throws RunRefusal (busy).
bool CampaignManager::end_current(std::int64_t id, const std::string& state, std::unique_lock<std::mutex>& lock) {
  if (current_.id != id) return false;
  current_.wanted = state;
  current_.stop = true;
  changed_.notify_all();
  if (!changed_.wait_for(lock, kPatience, [&] { return current_.id != id; }))
    throw RunRefusal(RunRefusal::Kind::busy, "The campaign did not end in time; try again.");
  return true;
}

std::optional<CampaignEnd> CampaignManager::unlogged(std::int64_t id) const {
  const std::lock_guard lock(mutex_);
  const auto end = unlogged_.find(id);
  return end == unlogged_.end() ? std::nullopt : std::optional(end->second);
}

void CampaignManager::tell_log() {
  const std::lock_guard telling(telling_);
  std::unique_lock lock(mutex_);
  for (const auto& [id, end] : std::map(unlogged_)) {
    lock.unlock();
    bool told = true;
    try {
      log_.update_campaign(id, end.state, end.error);
    } catch (const LogError& failure) {
      told = failure.kind() != LogError::Kind::disk;
      spdlog::warn("campaign {} is {}: {}", id, end.state, failure.what());
    }
    lock.lock();
    if (told) unlogged_.erase(id);
  }
}

void CampaignManager::set_state(std::int64_t id, const std::string& state) {
  {
    std::unique_lock lock(mutex_);
    if (state == "running") {
      const bool ends = current_.id == id && current_.ended;
      if (ends) changed_.wait_for(lock, kPatience, [&] { return current_.id != id; });
      if (current_.id == id || std::find(queue_.begin(), queue_.end(), id) != queue_.end()) return;
    } else {
      end_current(id, state, lock);
      std::erase(queue_, id);
    }
  }
  const std::string old = state_of(id);
  if (old == state) return;
  if (old == "finished" || old == "cancelled" || old == "failed")
    throw RunRefusal(RunRefusal::Kind::state, "The campaign is over: it is " + old + ".");
  const bool on = state == "running";
  {
    const std::lock_guard telling(telling_);
    log_.update_campaign(id, on ? "queued" : state);
    const std::lock_guard lock(mutex_);
    unlogged_.erase(id);
    if (on) queue_.push_back(id);
  }
  announce(id, on ? "queued" : state);
  changed_.notify_all();
}

void CampaignManager::remove(std::int64_t id) {
  {
    std::unique_lock lock(mutex_);
    end_current(id, "cancelled", lock);
    std::erase(queue_, id);
  }
  if (!log_.delete_campaign(id)) state_of(id);  // throws
  announce(id, "deleted");
}

}  // namespace vigil
