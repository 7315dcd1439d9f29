#include "db/writer.hpp"

#include <filesystem>
#include <numeric>

#include "db/chunk.hpp"
#include "db/schema.hpp"
#include "db/writer_state.hpp"

namespace vigil {

LogWriter::LogWriter(const std::string& path, LogOptions options)
    : state_(std::make_unique<State>(path, std::move(options))) {}

LogWriter::~LogWriter() = default;

const std::string& LogWriter::path() const { return state_->path; }

CreatedRun LogWriter::create_run(const RunRecord& record) {
  CreatedRun created;
  const WallTime now = state_->now();
  state_->commit_now([&](Database& database) {
    const auto known = known_key(database, record, now);
    created.fresh = !known;
    created.id = known ? *known : insert_run(database, record, now);
  });
  return created;
}

void LogWriter::command(RunId run, const Command& command) {
  state_->commit_now([&](Database& database) {
    apply_update(database, run, {});
    insert_command(database, run, command);
  });
}

void LogWriter::update(RunId run, const RunUpdate& update) {
  state_->commit_now([&](Database& database) { apply_update(database, run, update); });
}

void LogWriter::post(RunId run, const RunUpdate& update) {
  LogJob job;
  job.apply = [run, update](Database& database) { apply_update(database, run, update); };
  job.durable = true;
  state_->submit(std::move(job));
}

void LogWriter::finish(RunId run, const RunUpdate& update) {
  if (const auto logged = state_->find(run)) logged->intake.close();
  LogJob job;
  job.apply = [run, update](Database& database) { apply_update(database, run, update); };
  job.durable = true;
  job.seals = run;
  state_->submit_and_wait(std::move(job));
}

void LogWriter::flush() {
  LogJob job;
  job.everything = true;
  state_->submit_and_wait(std::move(job));
}

void LogWriter::delete_run(RunId run) {
  if (const auto logged = state_->remove(run)) logged->intake.close();
  state_->commit_now([run](Database& database) {
    apply_update(database, run, {});
    database.cached("UPDATE run SET deleted=1 WHERE id=?").bind(1, run).run();
  });
}

void LogWriter::set_signals(RunId run, const Catalogue& catalogue, const LogSelection& selection, LogPolicy policy,
                            double dt) {
  LogSelection chosen = selection;
  if (chosen.signals.empty()) {
    chosen.signals.resize(static_cast<std::size_t>(catalogue.size()));
    std::iota(chosen.signals.begin(), chosen.signals.end(), 0);
  }
  chosen.every = std::max<std::int64_t>(1, chosen.every);
  auto logged = std::make_shared<LoggedRun>(run, chosen, policy, state_->options.queue_bytes, dt);
  LogJob job;
  job.apply = [run, all = catalogue.all(), chosen, policy, dt](Database& database) {
    insert_signals(database, run, all, chosen.signals, chosen.every, policy, dt);
  };
  job.durable = true;
  state_->submit(std::move(job));
  const std::unique_lock lock(state_->runs_mutex);
  state_->runs[run] = std::move(logged);
}

void LogWriter::frame(RunId run, const Frame& frame) {
  const auto logged = state_->find(run);
  if (!logged || !logged->intake.push(frame)) return;
  const std::scoped_lock lock(state_->mutex);
  state_->awake = true;
  state_->wake.notify_one();
}

void LogWriter::set_policy(RunId run, LogPolicy policy) {
  if (const auto logged = state_->find(run)) logged->intake.set_policy(policy);
}

void LogWriter::mark(RunId run, const Mark& mark) {
  LogJob job;
  job.apply = [run, mark](Database& database) { insert_mark(database, run, mark); };
  job.durable = true;
  state_->submit(std::move(job), false);
}

void LogWriter::set_retention(std::optional<double> keep_days, std::optional<double> keep_gib) {
  {
    const std::scoped_lock lock(state_->health_mutex);
    state_->keep_days = keep_days;
    state_->keep_gib = keep_gib;
  }
  state_->retention_changed = true;
}

LogHealth LogWriter::health() const {
  LogHealth health;
  {
    const std::scoped_lock lock(state_->health_mutex);
    health.sentence = state_->trouble;
  }
  if (!health.sentence.empty()) health.state = LogHealth::State::degraded;
  health.dropped = state_->dropped_before;
  {
    const std::shared_lock lock(state_->runs_mutex);
    for (const auto& [id, run] : state_->runs) {
      health.queue_bytes += run->intake.queued_bytes();
      health.dropped += run->intake.dropped();
    }
  }
  for (const char* suffix : {"", "-wal"}) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(state_->path + suffix, missing);
    if (!missing) health.bytes += static_cast<std::int64_t>(size);
  }
  return health;
}

}  // namespace vigil
