#include "server/nats/muster.hpp"

#include <algorithm>

namespace vigil {
namespace {

constexpr auto kPatience = std::chrono::seconds(6);
constexpr std::size_t kMost = 10'000;

}  // namespace

bool Muster::there(const Heard& heard) { return Clock::now() - heard.last < kPatience; }

bool Muster::note(const CrewMember& member) {
  const std::lock_guard lock(mutex_);
  if (heard_.size() >= kMost) std::erase_if(heard_, [](const auto& one) { return !there(one.second); });
  Heard& heard = heard_[member.name];
  const bool fresh = member.refused && !heard.member.refused;
  heard = {member, Clock::now()};
  return fresh;
}

int Muster::threads() const {
  const std::lock_guard lock(mutex_);
  int threads = 0;
  for (const auto& [name, heard] : heard_) threads += there(heard) && !heard.member.refused ? heard.member.threads : 0;
  return std::max(threads, 1);
}

bool Muster::empty() const {
  const std::lock_guard lock(mutex_);
  return std::none_of(heard_.begin(), heard_.end(),
                      [](const auto& one) { return there(one.second) && !one.second.member.refused; });
}

std::vector<CrewMember> Muster::members() const {
  const std::lock_guard lock(mutex_);
  std::vector<CrewMember> members;
  for (const auto& [name, heard] : heard_) {
    if (there(heard) || heard.member.refused) members.push_back(heard.member);
  }
  return members;
}

}  // namespace vigil
