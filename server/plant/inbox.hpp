/// Between a broker's thread that brings messages and the runs that they feed. No broker in it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/json.hpp"
#include "server/plant/topic_pattern.hpp"
#include "server/runs/live_run.hpp"

namespace vigil {

struct InboxOptions {
  std::size_t full = 16u << 20;    ///< bytes of messages that wait: then the broker is asked to keep the others
  std::size_t low = 4u << 20;      ///< below this it may send again
  std::size_t payload = 8u << 20;  ///< longer ones are refused
};

class PlantInbox {
 public:
  /// Runs that a topic's {run} is the id or the name of; without one all that listen.
  using Find = std::function<std::vector<std::shared_ptr<LiveRun>>(const std::string& run)>;

  PlantInbox(std::vector<TopicPattern> patterns, Find find, InboxOptions options = {});
  ~PlantInbox();  ///< stops
  PlantInbox(const PlantInbox&) = delete;
  PlantInbox& operator=(const PlantInbox&) = delete;

  const std::vector<TopicPattern>& patterns() const { return patterns_; }

  // Any thread.

  /// Queues the message; never waits for a run.
  void deliver(std::string topic, std::string payload);
  /// Called with true when so much waits that no more should come, later with false; on any thread, and it must be
  /// quick. Null: nobody any more.
  void on_pause(std::function<void(bool)> paused);
  /// {"received","taken","no_run","refused","newest_refused":[sentence],"waiting_bytes","behind":[run]}.
  Json status() const;
  void stop();  ///< what waits is dropped

 private:
  using Clock = std::chrono::steady_clock;
  struct Message {
    std::string topic, payload;
    Clock::time_point at;
    std::size_t bytes() const { return topic.size() + payload.size() + sizeof(Message); }
  };
  struct Parked {
    std::shared_ptr<LiveRun> run;
    TopicPlace place;
    std::shared_ptr<const Message> message;
  };
  enum class Fate { taken, refused, over, behind };

  void work();
  void handle(std::shared_ptr<const Message> message);
  void feed(const std::shared_ptr<LiveRun>& run, const TopicPlace& place,
            const std::shared_ptr<const Message>& message);
  Fate give(LiveRun& run, const TopicPlace& place, const Message& message);
  void retry();
  void refuse(const std::string& topic, const std::string& sentence);
  void without_run(const std::string& topic, const std::string& run);
  void free(std::size_t bytes);

  const std::vector<TopicPattern> patterns_;
  const Find find_;
  const InboxOptions options_;

  std::map<RunId, std::deque<Parked>> parked_;  ///< of the worker alone
  std::set<std::string> told_;                  ///< of the worker alone: what was said once

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::shared_ptr<const Message>> queue_;
  std::size_t bytes_ = 0;  ///< of queued and parked ones
  bool paused_ = false, stop_ = false;
  std::function<void(bool)> on_pause_;
  std::int64_t received_ = 0, taken_ = 0, no_run_ = 0, refused_ = 0;
  std::deque<std::string> newest_;
  std::vector<std::string> behind_;
  std::thread thread_;
};

}  // namespace vigil
