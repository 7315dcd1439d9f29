/// Who is there: the workers that a campaign has heard of.
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "server/crew/crew.hpp"

namespace vigil {

/// Safe from any thread.
class Muster {
 public:
  /// True where this is the first that is heard of its refusal.
  bool note(const CrewMember& member);
  /// Of those who work now; 1 where nobody does, so that a little work is there for the first who comes.
  int threads() const;
  bool empty() const;
  /// Those who work now, and all who refused.
  std::vector<CrewMember> members() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Heard {
    CrewMember member;
    Clock::time_point last{};
  };
  static bool there(const Heard& heard);
  mutable std::mutex mutex_;
  std::map<std::string, Heard> heard_;
};

}  // namespace vigil
