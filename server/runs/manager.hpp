/// Every run that is not over: so many at once, the others in a queue, each with its own thread; and before the queue
/// those whose gains are not found yet.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "db/reader.hpp"
#include "db/writer.hpp"
#include "server/hub/hub.hpp"
#include "server/runs/live_run.hpp"
#include "server/runs/order.hpp"
#include "server/synthesis/design_item.hpp"
#include "server/webhook/webhooks.hpp"

namespace vigil {

class Designer;
struct DesignTask;

struct ManagerOptions {
  int max_runs = 4;            ///< beside the demo
  std::size_t max_queue = 64;  ///< runs that wait; each holds its state in memory
  DesignerOptions design;
  WebhookOptions webhooks;
  Announcer* announcer = nullptr;  ///< outlives the manager; null: none
};

class RunManager {
 public:
  /// All three outlive the manager.
  RunManager(LogWriter& log, const LogReader& reader, Hub& hub, ManagerOptions options = {});
  ~RunManager();  ///< stops
  RunManager(const RunManager&) = delete;
  RunManager& operator=(const RunManager&) = delete;

  // Safe from any thread.

  /// Makes the run, commits it and lets it start or wait; where gains must be found first, it waits in state designing
  /// and is made when they are. Throws InputError, LogError (also conflict, of an idempotency key), RunRefusal (full,
  /// or the server is stopping). A key that is known gives the run it made, not fresh.
  CreatedRun create(RunOrder order);
  std::shared_ptr<LiveRun> find(RunId id) const;  ///< null: over, designing, or never was
  /// Live runs that are fed and have this id, or this name in their plant's topics; "": all that have one.
  std::vector<std::shared_ptr<LiveRun>> fed(const std::string& name) const;
  /// Ends a run that is designing; false where it is not.
  bool stop_designing(RunId id, const std::string& state);
  /// What a run that is designing waits for; empty for all others.
  std::vector<DesignItem> designing(RunId id) const;
  Designer& designer() { return *designer_; }
  const Webhooks& webhooks() const { return webhooks_; }
  /// Ends the run if it is live and deletes it from the log and the hub. Throws LogError (missing), RunRefusal (busy).
  void remove(RunId id);
  /// The content of a trace in the log, shared while anyone uses it; null where there is none. Throws InputError where
  /// the text is no trace.
  std::shared_ptr<const Trace> trace(std::int64_t id);

  struct Counts {
    int running = 0;  ///< paused ones and the demo included
    int queued = 0;
    int designing = 0;
    int max = 0;
  };
  Counts counts() const;
  /// Ends every run: those that have begun become "stopped", those that wait or are designing "interrupted". Returns
  /// when all have ended.
  void stop();

 private:
  struct Waiting;  ///< a run whose gains are not all known; see waiting_run.hpp
  using WaitingPointer = std::shared_ptr<Waiting>;

  std::shared_ptr<void> count_in();
  void begin(RunId id, RunOrder order, Run run);
  CreatedRun create_designing(RunOrder order, std::vector<DesignTask> tasks);
  void look_at_designs();
  void go_on(RunId id, const WaitingPointer& waiting);
  Run make_waiting(Waiting& waiting);
  void end_waiting(RunId id, const Waiting& waiting, const std::string& state, const std::string& error);
  void announce(RunId id, const RunOrder& order, const std::string& state);
  void ended(RunId id);
  void keep_house();
  void fill();  ///< starts what there is room for; mutex_ is held

  LogWriter& log_;
  const LogReader& reader_;
  Hub& hub_;
  const ManagerOptions options_;

  Webhooks webhooks_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<RunId, std::shared_ptr<LiveRun>> runs_;
  std::map<RunId, WaitingPointer> waiting_;
  std::int64_t last_holder_ = 0;
  std::deque<RunId> queue_;
  std::deque<RunId> ended_;
  int beginning_ = 0;  ///< being created or ended, outside the lock
  bool stopping_ = false;
  bool closed_ = false;
  std::mutex trace_mutex_;
  std::map<std::int64_t, std::weak_ptr<const Trace>> traces_;
  std::thread keeper_;
  std::unique_ptr<Designer> designer_;  ///< calls look_at_designs() from its thread
};

}  // namespace vigil
