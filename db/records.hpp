/// The rows of the log as plain values: what the writer takes and the reader gives back.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/run/frame.hpp"
#include "engine/run/run.hpp"

namespace vigil {

using RunId = std::int64_t;
/// Nanoseconds since 1970-01-01 UTC.
using WallTime = std::int64_t;
/// An idempotency key is remembered so long.
inline constexpr WallTime kKeyLife = 24LL * 3600 * 1'000'000'000;

/// The log cannot do what was asked; what() is one sentence for a person.
class LogError : public std::runtime_error {
 public:
  enum class Kind {
    unusable,  ///< not a database, another program's, a newer schema, not writable, in use by another server
    missing,   ///< no such run, trace, scenario, …
    conflict,  ///< an idempotency key used before with another body
    disk       ///< full or failing at this moment; a later attempt may succeed
  };
  LogError(Kind kind, const std::string& sentence) : std::runtime_error(sentence), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

enum class LogPolicy { lossless, live };

struct RunParent {
  RunId run = 0;
  std::int64_t k = 0;
};

/// What is known of a run when it is made. `pace` is "max" or ticks per second; `input` is "simulate", "ingest" or
/// {"trace":id}.
struct RunRecord {
  std::string scenario;
  std::string family;
  Json document;
  std::string document_hash;
  std::uint64_t seed = 1;
  std::string version;
  std::string cpu;  ///< features of the processor that made it
  Json pace = "max";
  Json input = "simulate";
  std::optional<std::int64_t> trace;
  std::vector<std::string> tags;
  std::string note;
  std::optional<RunParent> parent;
  double dt = 0;                      ///< s; 0: not known yet
  std::optional<std::int64_t> steps;  ///< last tick; empty: until stopped
  LogPolicy policy = LogPolicy::lossless;
  std::optional<double> keep;  ///< s of wall time its samples are kept; empty: as long as the run
  bool reproducible = true;
  std::string state = "queued";
  Json designs;                  ///< {"<lane>":record} that it is made with; null: none, or not yet
  std::string idempotency_key;   ///< empty: none
  std::string idempotency_hash;  ///< of the request's body
};

/// Fields to change; what is empty stays as it is.
struct RunUpdate {
  std::optional<std::string> state;
  std::optional<WallTime> started;
  std::optional<WallTime> ended;
  std::optional<std::string> error;
  std::optional<std::vector<MetricValue>> metrics;
  std::optional<std::vector<FaultCount>> faults;
  std::optional<Json> design;
  std::optional<Json> designs;
  std::optional<std::vector<std::string>> warnings;
  std::optional<std::vector<std::string>> tags;
  std::optional<std::string> note;
  std::optional<Json> pace;
  std::optional<Json> world;
  std::optional<Json> document;
  std::optional<double> dt;
  std::optional<std::int64_t> steps;
  std::optional<bool> reproducible;
};

/// A run as the log has it. The parts below `gaps` are heavy and filled by LogReader::run() only, except `metrics`, of
/// which LogReader::list() fills those of the whole network (node empty).
struct RunRow {
  RunId id = 0;
  std::string scenario;
  std::string family;
  Json title;  ///< {"en","zh"} of the document; null where it has none
  std::string state;
  std::uint64_t seed = 0;
  std::string version;
  std::string cpu;
  Json pace;
  Json input;
  std::optional<std::int64_t> trace;
  std::vector<std::string> tags;
  std::string note;
  WallTime created = 0;
  std::optional<WallTime> started;
  std::optional<WallTime> ended;
  std::optional<RunParent> parent;
  double dt = 0;
  std::optional<std::int64_t> steps;
  std::int64_t k = -1;  ///< newest committed tick, -1: none
  LogPolicy policy = LogPolicy::lossless;
  std::optional<double> keep;
  bool reproducible = true;
  std::string document_hash;
  std::string error;         ///< empty: none
  std::int64_t gaps = 0;     ///< places where a full queue dropped samples
  std::int64_t changes = 0;  ///< commands that the run took while it ran

  std::vector<MetricValue> metrics;
  Json document;
  Json design;   ///< null: none
  Json designs;  ///< {"<lane>":record} that it was made with; null: none
  Json world;    ///< null: none
  std::vector<std::string> warnings;
  std::vector<FaultCount> faults;
  std::vector<Command> commands;
};

/// Ticks lost to a full queue, both ends included.
struct GapRow {
  std::int64_t from = 0;
  std::int64_t to = 0;
};

struct ScenarioRow {
  std::string id;
  Json document;
  WallTime created = 0;
  WallTime updated = 0;
};

struct TraceRow {
  std::int64_t id = 0;
  std::string name;
  std::string hash;  ///< SHA-256 of the CSV text, hexadecimal
  std::int64_t rows = 0;
  std::vector<std::string> columns;
  std::int64_t bytes = 0;  ///< of the CSV text
  WallTime created = 0;
};

/// Gains that were found for a problem, or the proof that there are none.
struct DesignRow {
  std::string key;   ///< of the problem
  std::string lane;  ///< that asked first
  Json record;
  WallTime created = 0;
};

/// A campaign: what was asked, and how far it is. States: queued running paused interrupted finished cancelled failed.
struct CampaignRow {
  std::int64_t id = 0;
  std::string state;
  Json request;
  Json result;              ///< of files before schema 3; null since: results are the cells'
  std::int64_t trials = 0;  ///< asked for
  std::int64_t done = 0;    ///< trials that have a row: always the first so many
  std::int64_t failed = 0;  ///< of those, trials that have no result or lost a lane
  WallTime created = 0;
  std::optional<WallTime> ended;
  std::string error;
};

/// One trial. state: finished, stopped (a fault stopped a lane of it), failed (no result).
struct TrialRow {
  std::int64_t index = 0;  ///< cell * runs + its place in the cell
  std::uint64_t seed = 0;
  std::string state;
  std::string numbers;  ///< doubles, little endian, by the cell's columns
  std::int64_t ticks = 0;
  Json faults;               ///< null: none
  Json warnings;             ///< null: none
  std::string error;         ///< of a failed one
  std::optional<RunId> run;  ///< that keeps its samples
  Json metrics;              ///< of files before schema 3; null since
};

/// One point of a campaign's grid, as far as it is merged.
struct CampaignCellRow {
  std::int64_t cell = 0;
  Json sweep;                ///< {"path":value}
  Json designs;              ///< {"<lane>":record} that its trials are made with; null: not found yet, or none needed
  Json design;               ///< of its first trial; null: none yet
  Json columns;              ///< of its trials' numbers; null: none yet
  std::string accumulators;  ///< as of its newest trial; empty once there is a result
  Json result;               ///< null until all its trials are there
};

struct CampaignPart {
  CampaignCellRow cell;
  std::vector<TrialRow> trials;
};

/// What one transaction adds to a campaign.
struct CampaignBatch {
  std::vector<TrialRow> trials;
  std::vector<CampaignCellRow> cells;  ///< of these trials; sweep and designs do not change
};

struct NewCampaign {
  Json request;
  std::int64_t trials = 0;
  std::vector<CampaignCellRow> cells;  ///< cell, sweep and designs count
  std::string idempotency_key;         ///< empty: none
  std::string idempotency_hash;
};

/// Which trials of a campaign to read; those of one cell are neighbours.
struct TrialRange {
  std::int64_t from = 0;  ///< index
  std::int64_t to = INT64_MAX;
};

std::string_view to_string(LogPolicy policy);
/// RFC 3339 in UTC with milliseconds: 2026-03-01T12:00:00.250Z.
std::string to_rfc3339(WallTime time);
/// SHA-256, 64 hexadecimal digits.
std::string sha256_hex(std::string_view text);

}  // namespace vigil
