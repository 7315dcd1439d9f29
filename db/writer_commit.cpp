/// One round becomes one transaction, tried again until the disk takes it.
#include <utility>

#include "db/writer_state.hpp"

namespace vigil {

using namespace std::chrono_literals;

namespace {

void deliver(LogJob& job, const std::exception_ptr& error) {
  if (!job.promise) return;
  if (error) {
    job.promise->set_exception(error);
  } else {
    job.promise->set_value();
  }
  job.promise.reset();
}

}  // namespace

void LogWriter::State::run_job(LogJob& job) {
  job.error = nullptr;
  if (!job.apply) return;
  database->cached("SAVEPOINT job").run();
  const auto undo = [&] {
    job.error = std::current_exception();
    database->cached("ROLLBACK TO job").run();
    database->cached("RELEASE job").run();
  };
  try {
    job.apply(*database);
    database->cached("RELEASE job").run();
  } catch (const SqlError& error) {
    if (error.disk()) throw;
    undo();
  } catch (const std::exception&) {
    undo();
  }
}

void LogWriter::State::write(Round& round) {
  Transaction transaction(*database);
  const WallTime written = now();
  // The tail first: a block that is sealed in the same round removes its rows again.
  for (const auto& row : round.tail) insert_tail(*database, row);
  for (const auto& block : round.sealed) insert_block(*database, block, written);
  for (const auto& [run, k] : round.newest) set_newest(*database, run, k);
  for (const auto& [run, gap] : round.gaps) insert_gap(*database, run, gap);
  for (auto& job : round.jobs) run_job(job);
  if (options.before_commit) options.before_commit();
  transaction.commit();
  last_commit_ = Steady::now();
}

void LogWriter::State::commit(Round& round) {
  bool stripped = false;
  for (auto length = 100ms;; length = std::min(2 * length, std::chrono::milliseconds(1000))) {
    std::string why;
    bool disk = true;
    try {
      write(round);
      break;
    } catch (const SqlError& error) {
      why = error.what();
      disk = error.disk();
    }
    const LogError failure(LogError::Kind::disk, "The log " + path + " cannot be written: " + why + ".");
    set_trouble(failure.what());
    if (disk) {
      if (pause(round, length, failure)) return;
    } else if (std::exchange(stripped, true)) {
      for (auto& job : round.jobs) deliver(job, std::make_exception_ptr(failure));
      return;
    } else {
      // Not the disk's fault: the samples of this round can never be stored, the jobs perhaps can.
      round.sealed.clear();
      round.tail.clear();
      round.newest.clear();
      round.gaps.clear();
    }
  }
  if (!stripped) set_trouble({});
  for (auto& job : round.jobs) deliver(job, job.error);
}

/// Waits before the next attempt, takes new jobs in, and fails those whose callers have waited long enough. True: the
/// log is being closed and the disk has had its chance.
bool LogWriter::State::pause(Round& round, std::chrono::milliseconds length, const LogError& why) {
  const auto patience = std::chrono::milliseconds(options.patience_milliseconds);
  std::unique_lock guard(mutex);
  wake.wait_for(guard, std::min(length, patience / 2 + 1ms), [&] { return stop; });
  if (stop && stop_deadline_ == Steady::time_point()) stop_deadline_ = Steady::now() + patience;
  const bool over = stop && Steady::now() >= stop_deadline_;
  const auto failure = std::make_exception_ptr(why);
  std::vector<LogJob> arrived;
  for (auto& job : queue) {
    // A job that takes samples along has to wait for the next round, which gathers them.
    (job.everything || job.seals != 0 ? arrived : round.jobs).push_back(std::move(job));
  }
  queue = std::move(arrived);
  const auto expire = [&](std::vector<LogJob>& jobs) {
    std::erase_if(jobs, [&](LogJob& job) {
      if (!over && (!job.promise || Steady::now() < job.deadline)) return false;
      deliver(job, failure);
      return !job.durable;
    });
  };
  expire(round.jobs);
  expire(queue);
  return over;
}

}  // namespace vigil
