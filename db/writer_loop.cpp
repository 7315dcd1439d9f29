/// The writer's thread: gather, commit, look after the file.
#include "db/schema.hpp"
#include "db/writer_state.hpp"

namespace vigil {

using namespace std::chrono_literals;

namespace {

WallTime system_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Runs that a crash left open belong to nobody any more.
void interrupt_open_runs(Database& database, WallTime now) {
  const char* const open = "deleted=0 AND state IN('queued','designing','running','paused')";
  Transaction transaction(database);
  const char* const mark =
      "INSERT INTO mark(run,k,type,edge,ref,lane,node,link,code,detail) SELECT "
      "id,max(k,0),'state','','','','','','interrupted',"
      "'The server ended before the run did.' FROM run WHERE ";
  database.cached(joined({mark, open})).run();
  database.cached(joined({"UPDATE run SET state='interrupted',ended=? WHERE ", open})).bind(1, now).run();
  database.cached("UPDATE campaign SET state='interrupted' WHERE state IN('queued','running')").run();
  transaction.commit();
}

}  // namespace

LogWriter::State::State(std::string file, LogOptions given)
    : path(std::move(file)),
      options(std::move(given)),
      lock(path),
      keep_days(options.keep_days),
      keep_gib(options.keep_gib) {
  if (!options.clock) options.clock = system_now;
  database = open_for_writing(path);
  try {
    interrupt_open_runs(*database, now());
  } catch (const SqlError& error) {
    throw LogError(LogError::Kind::unusable, "The log " + path + " cannot be written: " + error.what() + ".");
  }
  upkeep_ = std::make_unique<Upkeep>(*database, options.checkpoint_bytes);
  thread_ = std::thread([this] { loop(); });
}

LogWriter::State::~State() {
  {
    const std::shared_lock lock_runs(runs_mutex);
    for (const auto& [id, run] : runs) run->intake.close();
  }
  {
    const std::scoped_lock guard(mutex);
    stop = true;
    wake.notify_all();
  }
  thread_.join();
  sqlite3_wal_checkpoint_v2(database->handle(), nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
}

void LogWriter::State::submit(LogJob job, bool hurry) {
  const std::scoped_lock guard(mutex);
  queue.push_back(std::move(job));
  if (!hurry) return;
  awake = true;
  wake.notify_one();
}

void LogWriter::State::submit_and_wait(LogJob job) {
  job.promise = std::make_shared<std::promise<void>>();
  job.deadline = Steady::now() + std::chrono::milliseconds(options.patience_milliseconds);
  auto done = job.promise->get_future();
  submit(std::move(job));
  done.get();
}

void LogWriter::State::commit_now(std::function<void(Database&)> apply) {
  LogJob job;
  job.apply = std::move(apply);
  submit_and_wait(std::move(job));
}

std::shared_ptr<LoggedRun> LogWriter::State::find(RunId run) const {
  const std::shared_lock guard(runs_mutex);
  const auto place = runs.find(run);
  return place == runs.end() ? nullptr : place->second;
}

std::shared_ptr<LoggedRun> LogWriter::State::remove(RunId run) {
  const std::unique_lock guard(runs_mutex);
  const auto place = runs.find(run);
  if (place == runs.end()) return nullptr;
  auto logged = std::move(place->second);
  runs.erase(place);
  dropped_before += logged->intake.dropped();
  return logged;
}

void LogWriter::State::loop() {
  bool hurry = false;
  for (bool stopping = false; !stopping;) {
    stopping = wait_for_work(hurry);
    Round round = gather(stopping || Steady::now() >= tail_due_, stopping);
    if (stopping) seal_everything(round);
    const bool jobs = !round.jobs.empty();
    if (!round.empty()) commit(round);
    settle(round);
    hurry = !stopping && (upkeep(jobs) || round.more);
  }
}

bool LogWriter::State::wait_for_work(bool hurry) {
  std::unique_lock guard(mutex);
  if (!hurry) wake.wait_until(guard, tail_due_, [&] { return stop || awake; });
  awake = false;
  return stop;
}

Round LogWriter::State::gather(bool with_tail, bool everything) {
  Round round;
  {
    const std::scoped_lock guard(mutex);
    round.jobs.swap(queue);
  }
  std::map<RunId, std::shared_ptr<LoggedRun>> open;
  {
    const std::shared_lock guard(runs_mutex);
    open = runs;
  }
  for (const auto& job : round.jobs) everything = everything || job.everything || job.seals != 0;
  with_tail = with_tail || everything;
  if (with_tail) tail_due_ = Steady::now() + std::chrono::milliseconds(options.tail_milliseconds);
  const std::size_t most = everything ? SIZE_MAX : options.queue_bytes / 2;
  for (const auto& [id, run] : open) gather_run(id, run, most, with_tail, round);
  for (const auto& job : round.jobs) {
    if (job.seals == 0) continue;
    if (const auto run = remove(job.seals)) run->sealer.seal(round.sealed);
  }
  for (const auto& block : round.sealed) round.newest[block.run] = std::max(round.newest[block.run], block.last_k);
  for (const auto& row : round.tail) round.newest[row.run] = std::max(round.newest[row.run], row.k);
  return round;
}

void LogWriter::State::gather_run(RunId id, const std::shared_ptr<LoggedRun>& run, std::size_t most, bool with_tail,
                                  Round& round) {
  auto taken = run->intake.take(most);
  for (const auto& rows : taken.rows) run->sealer.add(rows, round.sealed);
  if (with_tail) run->sealer.save_tail(round.tail);
  for (const auto& gap : taken.gaps) round.gaps.emplace_back(id, gap);
  round.more = round.more || taken.left;
  if (taken.bytes > 0) round.releases.push_back({run, taken.bytes, std::move(taken.rows)});
}

void LogWriter::State::seal_everything(Round& round) {
  for (const auto& [id, run] : runs) {
    run->sealer.seal(round.sealed);
    if (run->sealer.newest() >= 0) round.newest[id] = run->sealer.newest();
  }
}

void LogWriter::State::settle(Round& round) {
  for (auto& release : round.releases) release.run->intake.release(release.bytes, std::move(release.used));
}

void LogWriter::State::set_trouble(const std::string& sentence) {
  const std::scoped_lock guard(health_mutex);
  trouble = sentence;
}

bool LogWriter::State::upkeep(bool removed) {
  const auto now_steady = Steady::now();
  more_to_remove_ = more_to_remove_ || removed;
  const bool due = now_steady >= upkeep_due_ || retention_changed;
  try {
    upkeep_->checkpoint(now_steady - last_commit_ > 1s);
    if (due) {
      upkeep_due_ = now_steady + 1s;
      more_to_remove_ = true;
      if (retention_changed.exchange(false) || now_steady >= retain_due_ || upkeep_->above(limits())) {
        retain_due_ = now_steady + 30s;
        upkeep_->retain(limits(), now());
        upkeep_->forget_old_keys(now());
      }
    }
    return upkeep_step(due);
  } catch (const SqlError& error) {
    database->roll_back();
    set_trouble("The log " + path + " cannot be looked after: " + error.what() + ".");
    more_to_remove_ = false;
    return false;
  }
}

RetentionLimits LogWriter::State::limits() {
  const std::scoped_lock guard(health_mutex);
  return {keep_days, keep_gib};
}

bool LogWriter::State::upkeep_step(bool due) {
  const auto until = Steady::now() + 20ms;
  bool expiring = due;
  while ((expiring || more_to_remove_) && Steady::now() < until) {
    expiring = expiring && (upkeep_->expire_samples(now()) || upkeep_->trim(limits()));
    if (!more_to_remove_) continue;
    const bool removing = upkeep_->removing();
    more_to_remove_ = upkeep_->purge();
    if (removing && !upkeep_->removing()) retention_changed = true;
  }
  if (expiring) upkeep_due_ = Steady::now();
  return expiring || more_to_remove_;
}

}  // namespace vigil
