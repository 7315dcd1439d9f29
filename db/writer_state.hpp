/// Inside of LogWriter: jobs, rounds, upkeep. The thread's members belong to it alone.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <future>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <thread>

#include "db/database.hpp"
#include "db/lock_file.hpp"
#include "db/sealer.hpp"
#include "db/store.hpp"
#include "db/upkeep.hpp"
#include "db/writer.hpp"

namespace vigil {

struct LoggedRun {
  LoggedRun(RunId id, const LogSelection& selection, LogPolicy policy, std::size_t budget, double dt)
      : intake(selection, policy, budget), sealer(id, selection.signals, selection.every, dt) {}
  Intake intake;
  Sealer sealer;  ///< the writer's thread only
};

/// One change that is not samples. Runs inside a savepoint, perhaps several times until a commit holds.
struct LogJob {
  std::function<void(Database&)> apply;            ///< may be empty
  std::shared_ptr<std::promise<void>> promise;     ///< null: nobody waits
  std::chrono::steady_clock::time_point deadline;  ///< of who waits
  bool durable = false;                            ///< stays when who waits has given up
  bool everything = false;                         ///< takes all samples handed over before along
  RunId seals = 0;                                 ///< this run ends
  std::exception_ptr error;                        ///< of the job itself, delivered after the commit
};

/// What one transaction writes.
struct Round {
  std::vector<SealedBlock> sealed;
  std::vector<TailRow> tail;
  std::map<RunId, std::int64_t> newest;  ///< tick
  std::vector<std::pair<RunId, GapRow>> gaps;
  std::vector<LogJob> jobs;
  struct Release {
    std::shared_ptr<LoggedRun> run;
    std::size_t bytes = 0;
    std::vector<RowBatch> used;
  };
  std::vector<Release> releases;
  bool more = false;  ///< samples were left for the next round
  bool empty() const { return sealed.empty() && tail.empty() && gaps.empty() && jobs.empty(); }
};

struct LogWriter::State {
  State(std::string file, LogOptions given);
  ~State();

  /// Hands over without waiting. Without hurry it may wait for the next commit of the tail.
  void submit(LogJob job, bool hurry = true);
  void submit_and_wait(LogJob job);  ///< throws what the job threw, or LogError (disk)
  void commit_now(std::function<void(Database&)> apply);
  std::shared_ptr<LoggedRun> find(RunId run) const;
  std::shared_ptr<LoggedRun> remove(RunId run);
  WallTime now() const { return options.clock(); }

  const std::string path;
  LogOptions options;
  LockFile lock;
  std::unique_ptr<Database> database;  ///< the thread's, once it runs

  mutable std::mutex mutex;  ///< guards the next four
  std::condition_variable wake;
  std::vector<LogJob> queue;
  bool stop = false;
  bool awake = false;  ///< a run has gathered enough

  mutable std::shared_mutex runs_mutex;
  std::map<RunId, std::shared_ptr<LoggedRun>> runs;
  mutable std::mutex health_mutex;
  std::string trouble;                          ///< guarded by health_mutex
  std::atomic<std::int64_t> dropped_before{0};  ///< by runs that ended
  std::atomic<bool> retention_changed{true};
  std::optional<double> keep_days, keep_gib;  ///< guarded by health_mutex

 private:
  using Steady = std::chrono::steady_clock;
  void loop();
  bool wait_for_work(bool hurry);  ///< true: time to stop
  Round gather(bool with_tail, bool everything);
  void gather_run(RunId id, const std::shared_ptr<LoggedRun>& run, std::size_t most, bool with_tail, Round& round);
  void seal_everything(Round& round);
  void commit(Round& round);
  void write(Round& round);
  void run_job(LogJob& job);
  void settle(Round& round);
  bool pause(Round& round, std::chrono::milliseconds length, const LogError& why);
  void set_trouble(const std::string& sentence);
  bool upkeep(bool removed);  ///< true: there is more to do soon
  bool upkeep_step(bool due);
  RetentionLimits limits();

  Steady::time_point tail_due_, upkeep_due_, retain_due_, last_commit_, stop_deadline_;
  bool more_to_remove_ = true;
  std::unique_ptr<Upkeep> upkeep_;
  std::thread thread_;
};

}  // namespace vigil
