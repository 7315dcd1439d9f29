/// Campaigns of the server: one at a time on its own threads, the others in a queue. What a restart interrupts goes on
/// by itself.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "db/reader.hpp"
#include "db/writer.hpp"
#include "server/campaigns/request.hpp"
#include "server/crew/broker.hpp"
#include "server/hub/hub.hpp"

namespace vigil {

class RunManager;

/// Where campaigns find workers.
struct WorkerSource {
  Broker* broker = nullptr;  ///< null: there are none
  std::string owner;         ///< tells this log's campaigns from others at the same broker
};

/// How fast the campaign goes that runs now.
struct CampaignSpeed {
  double trials_per_second = 0;
  std::optional<double> seconds_left;  ///< empty before the first trials
};

/// How a campaign ended, or why it stands.
struct CampaignEnd {
  std::string state, error;
};

class CampaignManager {
 public:
  /// All outlive the manager.
  CampaignManager(LogWriter& log, const LogReader& reader, Hub& hub, RunManager& runs, WorkerSource workers = {});
  ~CampaignManager();  ///< stops
  CampaignManager(const CampaignManager&) = delete;
  CampaignManager& operator=(const CampaignManager&) = delete;

  // Safe from any thread.

  /// Queues what the last server left interrupted, oldest first.
  void take_up();
  /// Commits the campaign and queues it. Throws InputError where its first trial cannot be made, LogError (also
  /// conflict, of the key), RunRefusal (full, or the server is stopping).
  CreatedCampaign create(const CampaignRequest& request, const std::string& key, const std::string& hash);
  /// state: "paused", "running", "cancelled". Returns once it is so and committed. Throws LogError (missing),
  /// RunRefusal (state: it is over; busy: its trials did not end in time).
  void set_state(std::int64_t id, const std::string& state);
  /// Ends it and removes it with its trials. Throws as set_state().
  void remove(std::int64_t id);
  /// Empty where it does not run now.
  std::optional<CampaignSpeed> speed(std::int64_t id) const;
  /// Of its crew, as far as this server has seen them; empty for threads.
  std::vector<CrewMember> workers(std::int64_t id) const;
  /// Its state where the log could not be told of it yet: the disk is full. It is told as soon as it can be.
  std::optional<CampaignEnd> unlogged(std::int64_t id) const;
  /// The campaign that runs becomes "interrupted", those that wait, too.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;
  /// What runs now; its members are guarded by mutex_, but for `stop`.
  struct Current {
    std::int64_t id = 0;
    std::atomic<bool> stop{false};
    std::string wanted;  ///< state it is to end in; empty: by itself
    bool ended = false;  ///< only the log is yet to be told
    std::int64_t first = 0, done = 0, trials = 0, failed = 0;
    Clock::time_point begin{}, told{};
  };

  void work();
  void carry_out(std::int64_t id);
  void tell_log();  ///< what is unlogged; what cannot be told yet stays so
  std::string run(std::int64_t id);
  std::unique_ptr<Crew> hire(std::int64_t id, const CampaignRequest& request) const;
  CampaignPlan prepare(std::int64_t id, const CampaignRequest& request);
  Json designs_of(const Scenario& scenario, Json known);
  void progress(std::int64_t done, bool failed);
  void announce(std::int64_t id, const std::string& state);
  CampaignSpeed speed_of(const Current& current) const;  ///< mutex_ is held
  std::string state_of(std::int64_t id) const;           ///< of the log; throws LogError (missing)
  bool end_current(std::int64_t id, const std::string& state, std::unique_lock<std::mutex>& lock);

  LogWriter& log_;
  const LogReader& reader_;
  Hub& hub_;
  RunManager& runs_;
  const WorkerSource source_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::int64_t> queue_;
  Current current_;                                          ///< id 0: none
  const Crew* crew_ = nullptr;                               ///< of the current one, while it makes trials
  std::map<std::int64_t, std::vector<CrewMember>> workers_;  ///< of those before it
  std::map<std::int64_t, CampaignEnd> unlogged_;
  bool stopping_ = false;
  std::mutex telling_;  ///< taken before mutex_, around changes of state in the log that must not cross
  std::thread worker_;
};

}  // namespace vigil
