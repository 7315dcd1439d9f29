/// Alarms and states of all runs, to every sink there is. No run ever waits for it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "db/records.hpp"
#include "server/alarms/outbox.hpp"

namespace vigil {

struct AnnouncerOptions {
  std::size_t queue = 1000;  ///< alarms that wait for each sink
  /// The state of a run that is not live, from the log; empty: there is none. On the sinks' threads.
  std::function<std::optional<std::string>(RunId)> logged;
};

class Announcer {
 public:
  /// A topic is "runs/<id>/alarms" (each alarm once) or "runs/<id>/state" (the newest kept).
  Announcer(std::vector<std::unique_ptr<AlarmSink>> sinks, AnnouncerOptions options);

  // Any thread; none of these waits for a sink.

  /// The mark of an alarm that begins or ends, with its run.
  void alarm(RunId run, const Mark& mark);
  /// `note` as the global feed has it: {"id","scenario","state","k",…}. The state gets its lanes with their alarms.
  void state(RunId run, const Json& note, const std::vector<std::string>& lanes);
  /// The run was deleted.
  void forget(RunId run);
  /// By the sinks' names.
  Json status() const;

 private:
  struct Live {
    Json note;
    std::map<std::string, std::map<std::string, std::int64_t>> alarms;  ///< lane, node: since which tick
  };

  void say_state(RunId run, const Live& live, bool lasting);
  std::optional<std::string> right(const std::string& topic, const std::string& text) const;

  const AnnouncerOptions options_;
  mutable std::mutex mutex_;
  std::map<RunId, Live> live_;
  std::vector<std::unique_ptr<Outbox>> outboxes_;  ///< last: their threads ask right()
};

}  // namespace vigil
