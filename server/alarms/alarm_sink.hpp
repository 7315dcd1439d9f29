/// A way out for alarms and states.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

struct Announcement {
  std::string topic;  ///< below the sink's own prefix, levels between '/'
  std::string text;   ///< JSON; empty and kept: forget what was kept
  bool kept = false;  ///< for those who come later, where the sink can
};

/// All but status(), connected() and name() are called by one thread, the announcer's.
class AlarmSink {
 public:
  virtual ~AlarmSink() = default;
  virtual std::string name() const = 0;
  /// False where it could not be sent: the same comes again later. Waits for a few seconds at most.
  virtual bool send(const Announcement& announcement) = 0;
  virtual bool connected() const = 0;
  /// How often it has been connected: with another number what is kept is said again.
  virtual std::uint64_t connections() const = 0;
  /// Topics that somebody keeps, with their texts, as heard since the last call.
  virtual std::vector<std::pair<std::string, std::string>> kept() { return {}; }
  virtual Json status() const = 0;
};

}  // namespace vigil
