/// What waits for one sink, and the thread that hands it over.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "server/alarms/alarm_sink.hpp"

namespace vigil {

class Outbox {
 public:
  /// What should be kept under a topic: its text, "" for nothing, empty where that is as it may be. On the outbox's
  /// thread.
  using Right = std::function<std::optional<std::string>(const std::string& topic, const std::string& text)>;

  /// `most` passing announcements wait; more push out the oldest.
  Outbox(std::unique_ptr<AlarmSink> sink, Right right, std::size_t most);
  ~Outbox();  ///< what is not sent within a second is not sent
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;

  // Any thread; none of these waits for the sink.

  /// A kept one takes the place of what waits under its topic. `lasting`: it is said again to a broker that comes back.
  void put(Announcement announcement, bool lasting = false);
  /// The sink's own, with "sent", "dropped" (passing ones pushed out), "waiting".
  Json status() const;
  std::string name() const { return sink_->name(); }

 private:
  void work();
  void greet(std::unique_lock<std::mutex>& lock);
  void correct(std::unique_lock<std::mutex>& lock);
  std::optional<Announcement> next();
  void give_back(Announcement announcement);

  const std::unique_ptr<AlarmSink> sink_;
  const Right right_;
  const std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Announcement> passing_;
  std::map<std::string, std::string> kept_;     ///< by topic: waits
  std::map<std::string, std::string> lasting_;  ///< by topic: said again at every connection
  std::uint64_t greeted_ = 0;
  bool kept_turn_ = false;  ///< kept and passing ones take turns
  std::int64_t sent_ = 0, dropped_ = 0;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace vigil
