/// One run that is not over, and the thread that steps it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "db/writer.hpp"
#include "engine/run/run.hpp"
#include "server/hub/hub.hpp"
#include "server/runs/order.hpp"
#include "server/runs/refusal.hpp"
#include "server/runs/run_sink.hpp"

namespace vigil {

/// What others may know of a live run; made by its thread a few times a second, whoever looks.
struct RunStatus {
  std::string state = "queued";
  std::string error;
  std::int64_t k = -1;
  double t = 0;                            ///< s
  std::optional<double> ticks_per_second;  ///< measured
  bool idle = false;                       ///< sleeps because nobody watches
  Pace pace;
  std::optional<WallTime> started, ended;
  std::vector<MetricValue> metrics;
  std::vector<FaultCount> faults;
  std::vector<std::string> warnings;
  Json design, world;
};

class LiveRun {
 public:
  /// `announcer`: null for none. `ended` is called once, at the end of the run's thread.
  LiveRun(RunId id, RunOrder order, Run run, LogWriter& log, Hub& hub, Webhooks& webhooks, Announcer* announcer,
          std::function<void(RunId)> ended);
  ~LiveRun();  ///< stops
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  // Every public call is safe from any thread. Those that change the run return when its thread has done it, and throw
  // RunRefusal when it is over or does not answer.

  RunId id() const { return id_; }
  const RunOrder& order() const { return order_; }
  void start();  ///< the wait in the queue is over; once
  bool started() const { return started_; }
  std::shared_ptr<const RunStatus> status() const;
  std::int64_t tick() const { return tick_.load(std::memory_order_relaxed); }  ///< of the newest frame

  /// Prepares, commits to the log, applies: the change is part of the run when this returns. Throws InputError,
  /// LogError.
  Command command(const Json& body);
  void set_pace(Pace pace);
  void pause();
  void resume();
  /// Makes so many ticks of a paused run; returns when they are made, or after two seconds of making them.
  void step(std::int64_t ticks);
  /// Ends the run in this state ("stopped", "interrupted"). Does not wait. Harmless when it is over.
  void stop(const std::string& state);
  /// True when the thread has done its last work (or never will); waits for at most that long.
  bool wait_ended(std::chrono::milliseconds patience) const;
  void join();
  /// Something was pushed into order().feed.
  void wake();

 private:
  using Clock = std::chrono::steady_clock;

  void inside(std::function<void()> work);
  void serve();
  void settle();  ///< makes known what a request has changed
  void main();
  void begin();
  void loop();
  bool over() const;
  bool rest();
  bool unwatched();
  bool starving();
  void sleep_until(Clock::time_point time);
  void tick_once();
  void enter(const std::string& state);
  /// The status as it stands; metrics and the like are counted anew only when `whole`.
  std::shared_ptr<const RunStatus> snapshot(bool whole) const;
  void publish(bool whole);
  void measure_rate();
  void announce(const RunStatus& status);
  void finish(std::string state, std::string error);
  bool every_lane_stopped() const;

  const RunId id_;
  const RunOrder order_;
  LogWriter& log_;
  Hub& hub_;
  Webhooks& webhooks_;
  Announcer* const announcer_;
  std::vector<std::string> lanes_;
  const std::function<void(RunId)> ended_call_;

  // Touched by the run's thread alone once it was started; before that under mutex_.
  Run run_;
  RunSink sink_;
  Pace pace_;
  std::string state_ = "queued";
  bool paused_ = false;
  bool idle_ = false;
  std::int64_t owed_ = 0;
  std::shared_ptr<std::promise<void>> stepped_;
  std::optional<WallTime> started_at_;
  Clock::time_point due_{}, watched_{}, published_{}, announced_{}, rate_since_{};
  std::int64_t rate_tick_ = -1;
  std::int64_t shown_tick_ = -1;  ///< of the status that was published last
  std::optional<double> rate_;
  Json design_, world_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::packaged_task<void()>> requests_;
  std::shared_ptr<const RunStatus> status_;
  std::string stop_state_;
  bool closed_ = false;  ///< takes no more requests
  bool fed_ = false;     ///< something was pushed since the thread last slept
  std::atomic<bool> pending_{false};
  std::atomic<bool> stop_{false};
  std::atomic<bool> started_{false};
  std::atomic<std::int64_t> tick_{-1};
  std::promise<void> ended_;
  std::shared_future<void> over_;
  std::thread thread_;
};

}  // namespace vigil
