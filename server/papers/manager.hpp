/// Items of the papers in the server: run in the background, one job at a time; the newest result of each is kept in
/// the log.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "db/reader.hpp"
#include "db/writer.hpp"
#include "engine/papers/item.hpp"
#include "engine/run/design.hpp"

namespace vigil {

class RunManager;

struct PapersOrder {
  std::vector<const papers::Item*> items;
  std::int64_t runs = 200;  ///< of each campaign
  std::uint64_t first_seed = 1;
};

class PapersManager {
 public:
  /// All outlive the manager.
  PapersManager(LogWriter& log, const LogReader& reader, RunManager& runs);
  ~PapersManager();  ///< stops
  PapersManager(const PapersManager&) = delete;
  PapersManager& operator=(const PapersManager&) = delete;

  // Safe from any thread.

  /// Throws RunRefusal: one goes on (state), or the server is stopping (full).
  void start(PapersOrder order);
  /// Goes on with the job that the log says was not over when the server ended, killed or not: the items that it had
  /// done stay, the one under way begins anew. Nothing where there is none.
  void take_up();
  /// Returns once no job goes on. Items that were done before stay. Throws RunRefusal (busy) where runs that are under
  /// way do not end in time.
  void cancel();
  /// The job that goes on, or the last one; null where there was none.
  Json job() const;
  /// Every item without its figure: papers::described().
  Json items() const;
  /// An item with its "figure", null where it was never run.
  Json item(const papers::Item& item) const;
  /// The newest results as a page of their own; empty where there are none.
  std::string report() const;
  /// Ends the runs under way and takes no more. A job that goes on is taken up at the next start.
  void stop();

 private:
  bool count_restart();
  void begin(PapersOrder order);
  void work(const PapersOrder& order);
  void remember();
  std::string carry_out(const PapersOrder& order);
  void keep(const papers::Item& item, const PapersOrder& order, const papers::Findings& findings);
  void fail(const std::string& key, const std::string& error);
  Json gains(const DesignTask& task);
  Json kept(const papers::Item& item) const;
  void at(const std::string& key);
  void over();

  LogWriter& log_;
  const LogReader& reader_;
  RunManager& runs_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Json> newest_;  ///< by key, as described()
  Json job_;
  bool running_ = false, stopping_ = false, cancelled_ = false;
  std::atomic<bool> stop_{false};
  std::thread worker_;
};

}  // namespace vigil
