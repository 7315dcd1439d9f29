/// Who finds gains: known ones at once, others by solving, one after another, while whoever asked does something else.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "engine/run/design.hpp"
#include "server/synthesis/child_solver.hpp"
#include "server/synthesis/design_item.hpp"

namespace vigil {

class LogReader;
class LogWriter;

class Designer {
 public:
  /// `settled` is called on the designer's own thread, with nothing locked, after each problem that was settled. The
  /// log outlives the designer.
  Designer(LogWriter& log, const LogReader& reader, DesignerOptions options, std::function<void()> settled = {});
  ~Designer();  ///< stops
  Designer(const Designer&) = delete;
  Designer& operator=(const Designer&) = delete;

  // Safe from any thread.

  using Holder = std::int64_t;
  /// Tells what is known of these, and queues what is not. A solve that timed out or crashed is tried again. What a
  /// holder asks for is solved as long as one holds it; what nobody holds is solved for its own sake. Throws
  /// RunRefusal: too many wait, or the server is stopping; nothing was asked for then.
  std::vector<DesignItem> ask(const std::vector<DesignTask>& tasks, std::optional<Holder> holder = {});
  /// What nobody wants any more is given up: out of the queue, its solver killed.
  void release(Holder holder);

  /// Nothing where it was never asked for, or given up.
  std::optional<DesignItem> find(const std::string& key) const;
  /// A record of memory or the log that a run of this task may have, checked anew; null where there is none.
  Json known(const DesignTask& task) const;
  /// The problem in SDPA's sparse format; nothing where it is not known.
  std::optional<std::string> sdpa(const std::string& key) const;
  double limit() const { return options_.limit; }

  /// Gives everything up. Nobody is called any more when this returns.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;
  struct Entry {
    DesignTask task;
    DesignItem item;
    Clock::time_point begin{};
    std::shared_ptr<ChildSolver> solver;  ///< while it solves
    std::set<Holder> holders;
    bool kept = false;
    bool wanted() const { return kept || !holders.empty(); }
  };
  using Shared = std::shared_ptr<Entry>;

  void work();
  void solve(const Shared& entry, std::unique_lock<std::mutex>& lock);
  void store(const DesignTask& task, const DesignItem& item) noexcept;
  void forget_old();
  Shared entry_of(const DesignTask& task);
  std::optional<DesignItem> answer(const DesignTask& task) const;
  static DesignItem now(const Entry& entry);

  LogWriter& log_;
  const LogReader& reader_;
  const DesignerOptions options_;
  const std::function<void()> settled_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Shared> entries_;  ///< by key
  std::deque<Shared> queue_;
  std::deque<Shared> old_;  ///< settled, oldest first
  bool stopping_ = false;
  std::thread worker_;
};

}  // namespace vigil
