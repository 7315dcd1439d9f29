/// The log's one writer: a thread that owns the one connection that writes. Every public call is safe from any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "db/records.hpp"

namespace vigil {

struct LogOptions {
  std::function<WallTime()> clock;          ///< empty: the system's
  std::size_t queue_bytes = 16u << 20;      ///< samples waiting for the disk, for each run
  int tail_milliseconds = 250;              ///< unsealed samples are committed this often
  int patience_milliseconds = 5000;         ///< a blocking call gives up on a full or failing disk after this long
  std::size_t checkpoint_bytes = 8u << 20;  ///< of the write-ahead log
  std::optional<double> keep_days;          ///< finished runs older than this are removed
  std::optional<double> keep_gib;           ///< oldest finished runs are removed above this
  std::function<void()>
      before_commit;  ///< for tests: called on the writer's thread before each commit; may wait or throw
};

/// Which frames of a run are kept.
struct LogSelection {
  std::vector<int> signals;  ///< ids, rising; empty: all of the catalogue
  std::int64_t every = 1;    ///< ticks k with k % every == 0
};

struct LogHealth {
  enum class State { ok, degraded };
  State state = State::ok;
  std::string sentence;         ///< what is wrong, empty when ok
  std::size_t queue_bytes = 0;  ///< samples waiting
  std::int64_t dropped = 0;     ///< frames dropped since the start
  std::int64_t bytes = 0;       ///< of the file and its write-ahead log
};

inline const char* to_string(LogHealth::State state) { return state == LogHealth::State::ok ? "ok" : "degraded"; }

struct CreatedRun {
  RunId id = 0;
  bool fresh = true;  ///< false: the idempotency key was known and this is the run it made
};

struct CreatedCampaign {
  std::int64_t id = 0;
  bool fresh = true;  ///< false: the idempotency key was known and this is the campaign it made
};

class LogWriter {
 public:
  /// Opens or creates the file. Runs that were left queued, designing, running or paused become `interrupted` and their
  /// tails are sealed. Throws LogError (unusable): not a database, another program's, a newer schema, damaged, not
  /// writable, in use.
  explicit LogWriter(const std::string& path, LogOptions options = {});
  /// Commits everything, seals what is open, closes the file cleanly.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  // The calls of this block return once committed. They throw LogError: missing (no such run), disk (nothing was
  // changed, unless said otherwise).

  CreatedRun create_run(const RunRecord& record);
  /// Puts a command into the run; once committed it belongs to it for ever.
  void command(RunId run, const Command& command);
  void update(RunId run, const RunUpdate& update);
  /// Seals the tail and applies the update (state, ended, metrics, …); later frames of the run are ignored. After
  /// `disk` the data stay queued and are committed as soon as the disk allows.
  void finish(RunId run, const RunUpdate& update);
  /// Returns when everything handed over before is committed.
  void flush();
  /// The run is gone at once for every reader; its samples are removed in the background.
  void delete_run(RunId run);
  void put_scenario(const std::string& id, const Json& document);
  bool delete_scenario(const std::string& id);  ///< false: there was none
  /// Stores the CSV text compressed. The same text again gives the id it has.
  std::int64_t put_trace(const std::string& name, std::string_view csv, std::int64_t rows,
                         const std::vector<std::string>& columns);
  bool delete_trace(std::int64_t id);
  void set_setting(const std::string& key, const Json& value);
  /// Keeps the newest 500. `problem` is a text, stored compressed; a key that is known is replaced.
  void put_design(const std::string& key, const std::string& lane, const Json& record, std::string_view problem);
  CreatedCampaign create_campaign(const NewCampaign& campaign);
  void update_campaign(std::int64_t id, const std::string& state, const std::string& error = {});
  /// Changes "tags" or "note" of the request.
  void describe_campaign(std::int64_t id, const Json& changes);
  /// Gains that a cell's trials are made with.
  void set_cell_designs(std::int64_t campaign, std::int64_t cell, const Json& designs);
  bool delete_campaign(std::int64_t id);

  // The calls of this block return at once.

  /// Describes the frames to come; call it once a run, before the first frame.
  void set_signals(RunId run, const Catalogue& catalogue, const LogSelection& selection, LogPolicy policy, double dt);
  /// Ticks must rise. Policy live never waits: with the queue full the frame is dropped, and the gap is recorded with a
  /// mark of type note and code `log_gap`. Policy lossless waits for room. Frames of an unknown or finished run are
  /// ignored.
  void frame(RunId run, const Frame& frame);
  void set_policy(RunId run, LogPolicy policy);
  /// Never dropped.
  void mark(RunId run, const Mark& mark);
  /// Like update(), without waiting; never dropped.
  void post(RunId run, const RunUpdate& update);
  /// Trials and what is merged of them, in one transaction; ready once it is committed, with the failure otherwise.
  std::future<void> add_trials(std::int64_t campaign, CampaignBatch batch);
  /// Limits of retention from now on.
  void set_retention(std::optional<double> keep_days, std::optional<double> keep_gib);
  LogHealth health() const;

  const std::string& path() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vigil
